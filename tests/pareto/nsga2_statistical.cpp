// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>
#include <numbers>

/// Hypervolume of the front after 250 generations of 100 points, reference point 1.1 in each objective,
/// median of five seeds.
///
/// The seeds are fixed, so a test fails only after a change; the false-alarm rate is the probability that a
/// change which merely draws other random numbers fails it. On seeds 1 to 200 no run fell below its bound, so
/// one run does with probability below 3/200 (95 % confidence, rule of three), and three of five with
/// probability below 10·0.015³ = 3.4e-5 a test.

namespace drawpoint::pareto {
namespace {

template <class F>
double median_hypervolume(const F& f, int d, int m, double elitism_ratio, double true_volume) {
  std::array<double, 5> volumes{};
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    const Nsga2Options options{.population = 100,
                               .generations = 250,
                               .elitism_ratio = elitism_ratio,
                               .seed = static_cast<doe::Seed>(k + 1)};
    const Front front = nsga2(f, support::unit_problem(d, m), options);
    volumes[k] = hypervolume(front.Y, Eigen::VectorXd::Constant(m, 1.1));
    EXPECT_LT(volumes[k], true_volume) << "a front of 100 points cannot dominate more than the true one";
  }
  std::sort(volumes.begin(), volumes.end());
  return volumes[2];
}

// The area under 1 - sqrt(f) is 1/3; the volume under the octant of the unit sphere is π/6.
const double zdt1_volume = 1.1 * 1.1 - 1.0 / 3.0;
const double dtlz2_volume = 1.1 * 1.1 * 1.1 - std::numbers::pi / 6.0;

// pagmo 2.18 with the same operators and settings: median of 11 seeds 0.869448 in [0.868924, 0.870033] and
// 0.702418 in [0.691, 0.717]. The bound is its median less its own range. Here, 200 seeds: 0.8695 to 0.8708
// and 0.688 to 0.719.
TEST(Nsga2, PlainElitismOnZdt1IsAsGoodAsPagmo) {
  EXPECT_GE(median_hypervolume(support::zdt1, 30, 2, 0.0, zdt1_volume), 0.869448 - (0.870033 - 0.868924));
}

TEST(Nsga2, PlainElitismOnDtlz2IsAsGoodAsPagmo) {
  EXPECT_GE(median_hypervolume(support::dtlz2, 12, 3, 0.0, dtlz2_volume), 0.702418 - (0.717 - 0.691));
}

// Controlled elitism spends evaluations on dominated points, which these problems without local fronts do not
// reward: 0.8656 to 0.8690 and 0.648 to 0.691 over 200 seeds. The bound is the mean less five standard
// deviations of one run.
TEST(Nsga2, ControlledElitismConvergesOnZdt1) {
  EXPECT_GE(median_hypervolume(support::zdt1, 30, 2, 0.65, zdt1_volume), 0.867527 - 5 * 0.000692);
}

TEST(Nsga2, ControlledElitismConvergesOnDtlz2) {
  EXPECT_GE(median_hypervolume(support::dtlz2, 12, 3, 0.65, dtlz2_volume), 0.672207 - 5 * 0.009867);
}

}  // namespace
}  // namespace drawpoint::pareto
