// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What contact_problem compares by: converged solutions belong to their problem and to their number of substeps, and
// the picture shows every method under its name.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <drawpoint/benchmarks/micro/comparison.hpp>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <drawpoint/tests/support/contact_problems.hpp>
#include <filesystem>
#include <regex>

using namespace drawpoint;
using namespace drawpoint::benchmarks;

namespace {

namespace fs = std::filesystem;

class ContactComparison : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name) const { return folder_ / name; }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("drawpoint_comparison_" + std::to_string(::getpid()));
};

double between(const Converged& a, const Converged& b) {
  return distance(a.solved.problem, a.solved.report.machine, b.solved.problem, b.solved.report.machine)
      .velocities;
}

Measured row(const std::string& method, int substeps, int iterations, double ms, double distance) {
  Measured m{method, substeps, iterations, {}};
  m.evaluation.milliseconds = ms;
  m.evaluation.distance.velocities = distance;
  m.evaluation.residual.complementarity = distance / 10;
  return m;
}

std::vector<double> numbers_after(const std::string& text, const std::string& pattern) {
  std::vector<double> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
    found.push_back(std::stod((*match)[1]));
  return found;
}

}  // namespace

// Velocities are stored in double precision, impulses in single: half a unit in the last place, 2^-24 of each.
TEST_F(ContactComparison, SolutionsComeBackFromTheirFile) {
  const support::PushedStack scene;
  const Converged one = converge(scene.problem, 1, 2000), four = converge(scene.problem, 4, 2000);
  EXPECT_EQ(four.iterations, 500);
  write_converged(file("s.h5"), scene.problem, {one, four});
  const auto read = read_converged(file("s.h5"), scene.problem);
  ASSERT_EQ(read.size(), 2u);
  for (const auto& [stored, made] : {std::pair(&read[0], &one), std::pair(&read[1], &four)}) {
    EXPECT_EQ(stored->substeps, made->substeps);
    EXPECT_EQ(stored->residual.contacts(), made->residual.contacts());
    EXPECT_EQ(stored->uncertainty, made->uncertainty);
    EXPECT_EQ(between(*stored, *made), 0);
    for (std::size_t k = 0; k < scene.problem.points.size(); ++k) {
      const Eigen::Vector3d was = made->solved.problem.points[k].impulse;
      EXPECT_LE((stored->solved.problem.points[k].impulse - was).lpNorm<Eigen::Infinity>(),
                std::ldexp(was.lpNorm<Eigen::Infinity>(), -24));
    }
    EXPECT_EQ(stored->solved.report.machine.row_impulses.size(), scene.sled.rows.size());
  }
}

TEST_F(ContactComparison, SolutionsOfAnotherProblemAreRefused) {
  support::PushedStack scene;
  write_converged(file("s.h5"), scene.problem, {converge(scene.problem, 1, 10)});
  scene.problem.points[0].gap += 1e-9;
  ConvergedSolutions other(scene.problem, file("s.h5"));
  EXPECT_NE(other.fault().find("it is of another problem; make it anew: contact_problem converge"),
            std::string::npos)
      << other.fault();
  EXPECT_TRUE(other.known().empty());
  ConvergedSolutions computed(scene.problem, file("absent.h5"));
  EXPECT_TRUE(computed.known().empty() && computed.fault().empty());
  EXPECT_EQ(computed.of(2).substeps, 2);
}

// As after a change of the law: the stored solution leaves another residual than it says.
TEST_F(ContactComparison, SolutionsOfAnotherLawAreRefused) {
  const support::PushedStack scene;
  Converged solution = converge(scene.problem, 1, 2000);
  write_converged(file("s.h5"), scene.problem, {solution});
  EXPECT_EQ(ConvergedSolutions(scene.problem, file("s.h5")).fault(), "");
  solution.solved.problem.bodies[1].velocity.z() += 0.1;
  write_converged(file("s.h5"), scene.problem, {solution});
  const std::string fault = ConvergedSolutions(scene.problem, file("s.h5")).fault();
  EXPECT_NE(fault.find("the law of contacts has changed"), std::string::npos) << fault;
}

// The stack is in motion: its two limits differ by what substeps resolve, and many iterations of either come much
// nearer to their own than that: twenty contacts converge by a constant factor per iteration, and a hundredth is far
// above where 2000 of them end and far below the 1 that a distance to the other limit would be.
TEST_F(ContactComparison, DistancesAreToTheLimitOfAsManySubsteps) {
  const support::PushedStack scene;
  ConvergedSolutions converged(scene.problem, file("absent.h5"));
  const double apart = between(converged.of(1), converged.of(8));
  ASSERT_GT(apart, 1e-4);
  for (const int substeps : {1, 8}) {
    const Evaluation e = evaluate(scene.problem, contact_method("sequential"),
                                  fixed_work(substeps, 2000 / substeps), 1, converged.of(substeps));
    EXPECT_LT(e.distance.velocities, 0.01 * apart) << substeps;
  }
}

TEST_F(ContactComparison, TheBestWithinATimeIsTheNearest) {
  const std::vector<Measured> rows{row("a", 1, 1, 2, 0.5), row("a", 1, 9, 8, 0.2), row("a", 1, 99, 9, 0.3),
                                   row("b", 16, 1, 5, 0.1)};
  const auto best = best_within(rows, {1, 4, 10});
  ASSERT_EQ(best.size(), 2u);
  EXPECT_EQ(best[0].series, "a, S = 1");
  EXPECT_EQ(best[0].within, (std::vector<const Measured*>{nullptr, &rows[0], &rows[1]}));
  EXPECT_EQ(best[1].within, (std::vector<const Measured*>{nullptr, nullptr, &rows[3]}));
}

// Two panels; in each a curve and a name for each series, names a line of text apart, even if all curves end at one
// point; special characters are escaped, and a value of zero, which has no logarithm, leaves no NaN.
TEST_F(ContactComparison, ThePictureNamesEveryCurve) {
  std::vector<Measured> rows;
  for (int k = 0; k < 9; ++k)
    for (const double ms : {1.0, 10.0}) rows.push_back(row("m" + std::to_string(k), 1, 1, ms, 0.1 / ms));
  rows.push_back(row("zero", 1, 1, 3, 0));
  const std::string svg = comparison_svg(rows, "a < b & c");
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ(numbers_after(svg, "<polyline class=\"curve\" stroke=\"#[0-9a-f]+\" points=\"([0-9.]+)").size(),
            18u);
  for (int k = 0; k < 9; ++k)
    EXPECT_EQ(numbers_after(svg, ">m(" + std::to_string(k) + "), S = 1</text>").size(), 2u);
  std::vector<double> heights = numbers_after(svg, "class=\"name\"[^>]* y=\"([0-9.]+)\"");
  ASSERT_EQ(heights.size(), 18u);
  for (std::size_t k = 0; k < 18; ++k) EXPECT_TRUE(k % 9 == 0 || heights[k] - heights[k - 1] >= 12) << k;
  EXPECT_LT(*std::max_element(heights.begin(), heights.end()), 480);  // in the picture
}
