// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// contact_problem as its user runs it: on a small problem and on the recorded sets that come with the sources.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <drawpoint/benchmarks/micro/converged_solution.hpp>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <drawpoint/tests/support/contact_problems.hpp>
#include <drawpoint/tests/support/files.hpp>
#include <filesystem>

using namespace drawpoint;
using support::contents;

namespace {

namespace fs = std::filesystem;

struct Ended {
  int code = -1;
  std::string out, err;
};

class ContactProblemCommands : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    engine::record::write_contact_problem(file("stack.h5"), scene_.problem, "a stack");
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  Ended run(const std::string& arguments) const {
    const std::string line =
        std::string(CONTACT_PROBLEM) + " " + arguments + " >" + file("out") + " 2>" + file("err");
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(file("out")), contents(file("err"))};
  }

  support::PushedStack scene_;

 private:
  fs::path folder_ = fs::temp_directory_path() / ("drawpoint_commands_" + std::to_string(::getpid()));
};

std::vector<fs::path> recorded_sets() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(RECORDED_SETS))
    if (entry.path().extension() == ".h5" && entry.path().stem().extension() != ".solution")
      found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

TEST_F(ContactProblemCommands, ExportAndImportGiveTheFileBack) {
  ASSERT_EQ(run("export " + file("stack.h5") + " " + file("plain.h5")).code, 0);
  ASSERT_EQ(run("import " + file("plain.h5") + " " + file("back.h5")).code, 0);
  EXPECT_TRUE(contents(file("back.h5")) == contents(file("stack.h5")));
  const Ended wrong = run("import " + file("out") + " " + file("no.h5"));
  EXPECT_EQ(wrong.code, 1);
  EXPECT_NE(wrong.err.find("cannot be opened by HDF5"), std::string::npos) << wrong.err;
}

TEST_F(ContactProblemCommands, SolveUsesTheSolutionBesideItsFile) {
  ASSERT_EQ(run("converge " + file("stack.h5") + " --iterations 64 --substeps 1 4").code, 0);
  const auto stored = benchmarks::read_converged(file("stack.solution.h5"), scene_.problem);
  ASSERT_EQ(stored.size(), 2u);
  EXPECT_EQ(stored[1].iterations, 16);
  // 64 iterations are the stored solution itself, which no limit of many more would be.
  const std::string solve = "solve " + file("stack.h5") + " --iterations 16 --substeps 4 --repeats 1 --json";
  const Ended with = run(solve);
  EXPECT_NE(with.out.find("\"distance_to_converged\":0.0,"), std::string::npos) << with.out;
  fs::remove(file("stack.solution.h5"));
  const Ended without = run(solve);
  EXPECT_EQ(without.out.find("\"distance_to_converged\":0.0,"), std::string::npos) << without.out;
  EXPECT_EQ(without.err, "");
}

TEST_F(ContactProblemCommands, ASolutionThatDoesNotFitIsNamedAndNotUsed) {
  ASSERT_EQ(run("converge " + file("stack.h5") + " --iterations 64").code, 0);
  scene_.problem.points[0].friction += 0.01;
  for (engine::ContactPoint& point : scene_.problem.points)
    point.friction = scene_.problem.points[0].friction;
  engine::record::write_contact_problem(file("stack.h5"), scene_.problem);
  const Ended ended = run("solve " + file("stack.h5") + " --repeats 1 --json");
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.err.find("it is of another problem"), std::string::npos) << ended.err;
}

// What is committed can be read by today's program and is in today's format, so that other programs see its meaning.
TEST_F(ContactProblemCommands, RecordedSetsAreOfTodaysFormat) {
  const auto sets = recorded_sets();
  ASSERT_GE(sets.size(), 5u);
  for (const fs::path& set : sets) {
    const engine::record::RecordedProblem recorded = engine::record::read_contact_problem(set);
    engine::record::write_contact_problem(file("again.h5"), recorded.problem, recorded.note);
    EXPECT_TRUE(contents(file("again.h5")) == contents(set)) << set << ": export and import it";
  }
}
