// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

/// A journal's place, empty before and after each test.
class RunJournalTest : public ::testing::Test {
 protected:
  RunJournalTest() { std::filesystem::remove(path_); }
  ~RunJournalTest() override { std::filesystem::remove(path_); }

  std::string text() const {
    std::ifstream file(path_, std::ios::binary);
    std::ostringstream all;
    all << file.rdbuf();
    return all.str();
  }
  void write(const std::string& text) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << text;
  }
  std::string error(const Eigen::MatrixXd& X) const {
    return support::thrown_text<std::runtime_error>(
        [&] { evaluate(noisy, problem_, X, {.replicates = 2, .journal = path_}); });
  }

  static Outcome noisy(const Eigen::VectorXd& x, Seed seed) {
    if (x[0] < 0.2) return Failure{"stuck,\n\"twice\"\\ at the toe\r"};
    return x[0] / 3 + RandomStream(seed).uniform();
  }

  const Problem problem_ = support::unit_problem(2);
  const std::filesystem::path path_ =
      std::filesystem::temp_directory_path() /
      ("run_journal_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
       std::to_string(::getpid()) + ".txt");
};

void expect_equal(const Evaluations& a, const Evaluations& b) {
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    EXPECT_EQ(a.rows[i].run, b.rows[i].run);
    EXPECT_EQ(a.rows[i].replicate, b.rows[i].replicate);
    EXPECT_EQ(a.rows[i].seed, b.rows[i].seed);
    EXPECT_EQ(a.rows[i].x, b.rows[i].x);
    EXPECT_EQ(a.rows[i].outcome.reason(), b.rows[i].outcome.reason());
    EXPECT_EQ(a.rows[i].outcome.values(), b.rows[i].outcome.values());
  }
}

TEST_F(RunJournalTest, RunsOnDiskAreNotMadeAgain) {
  const Eigen::MatrixXd X = uniform_random(problem_, 30);
  std::atomic<int> calls{0};
  const auto counted = [&calls](const Eigen::VectorXd& x, Seed seed) {
    ++calls;
    return noisy(x, seed);
  };
  const EvaluateOptions options{.threads = 3, .replicates = 2, .journal = path_};
  evaluate(counted, problem_, X.topRows(10), options);
  EXPECT_EQ(calls, 20);
  int reported = 0;
  EvaluateOptions reporting = options;
  reporting.on_result = [&reported](const Evaluation&) { ++reported; };
  const Evaluations all = evaluate(counted, problem_, X, reporting);
  EXPECT_EQ(calls, 60);
  EXPECT_EQ(reported, 40);
  expect_equal(all, evaluate(noisy, problem_, X, {.replicates = 2}));
  expect_equal(evaluate(counted, problem_, X, options), all);
  EXPECT_EQ(calls, 60);
}

// Whatever the process is killed in the middle of, the next call goes on: cut the file at every length.
TEST_F(RunJournalTest, ATornLastLineIsRunAgain) {
  const Eigen::MatrixXd X = uniform_random(problem_, 4);
  const EvaluateOptions options{.replicates = 2, .journal = path_};
  const Evaluations whole = evaluate(noisy, problem_, X, options);
  const std::string full = text();
  for (std::size_t length = 0; length < full.size(); length += 7) {
    write(full.substr(0, length));
    expect_equal(evaluate(noisy, problem_, X, options), whole);
    const std::string now = text();
    ASSERT_EQ(std::count(now.begin(), now.end(), '\n'), 9) << "cut at " << length;
  }
  write(full.substr(0, full.size() - 3) + "x\n");  // written whole, with a wrong last line
  expect_equal(evaluate(noisy, problem_, X, options), whole);
}

TEST_F(RunJournalTest, DamageBeforeTheLastLineIsNamed) {
  const Eigen::MatrixXd X = uniform_random(problem_, 4);
  evaluate(noisy, problem_, X, {.replicates = 2, .journal = path_});
  std::string damaged = text();
  const std::size_t third = damaged.find('\n', damaged.find('\n') + 1) + 1;
  damaged[third] ^= 1;
  write(damaged);
  EXPECT_EQ(error(X),
            "doe::RunJournal: \"" + path_.string() +
                "\" line 3 is damaged: its checksum does not fit; delete that line to run it again");
  EXPECT_EQ(text(), damaged);
}

TEST_F(RunJournalTest, AnotherDesignOrProblemIsRefused) {
  evaluate(noisy, problem_, uniform_random(problem_, 4), {.replicates = 2, .journal = path_});
  EXPECT_EQ(error(uniform_random(problem_, 4, {.seed = 2})),
            "doe::RunJournal: \"" + path_.string() +
                "\" has run 0, replicate 0 at another point or with another seed; it is of another design: "
                "repeat the call that began it, or choose another file");
  const Problem other = support::unit_problem(3);
  const std::string text = support::thrown_text<std::runtime_error>(
      [&] { evaluate(noisy, other, uniform_random(other, 4), {.journal = path_}); });
  EXPECT_NE(text.find("belongs to another problem"), std::string::npos) << text;
}

TEST_F(RunJournalTest, ASecondWriterIsRefused) {
  const RunJournal first(problem_, path_);
  EXPECT_EQ(support::thrown_text<std::runtime_error>([&] { RunJournal(problem_, path_); }),
            "doe::RunJournal: \"" + path_.string() +
                "\" is in use by another process; wait for it to end or choose another file");
  EXPECT_NE(support::thrown_text<std::runtime_error>([&] {
              RunJournal(problem_, std::filesystem::temp_directory_path() / "no such folder" / "journal.txt");
            }).find("cannot open"),
            std::string::npos);
}

TEST_F(RunJournalTest, ACancelledStudyGoesOnToTheSameTable) {
  const Eigen::MatrixXd X = uniform_random(problem_, 40);
  std::stop_source cancel;
  EvaluateOptions options{.threads = 2, .replicates = 2, .stop = cancel.get_token(), .journal = path_};
  int ended = 0;
  options.on_result = [&](const Evaluation&) {
    if (++ended == 13) cancel.request_stop();
  };
  const Evaluations part = evaluate(noisy, problem_, X, options);
  EXPECT_GE(part.rows.size(), 13U);
  EXPECT_LE(part.rows.size(), 14U);  // the other thread may have had one in flight
  const Evaluations all = evaluate(noisy, problem_, X, {.replicates = 2, .journal = path_});
  expect_equal(all, evaluate(noisy, problem_, X, {.replicates = 2}));
}

TEST_F(RunJournalTest, ChecksumsAreFnv1a) {  // published test vectors of the 64-bit FNV-1a hash
  EXPECT_EQ(detail::checksum(""), "cbf29ce484222325");
  EXPECT_EQ(detail::checksum("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(detail::checksum("foobar"), "85944171f73967e8");
}

// Reading one to its end takes all memory.
TEST_F(RunJournalTest, RefusesADevice) {
  EXPECT_EQ(support::thrown_text<std::runtime_error>([&] { RunJournal(problem_, "/dev/zero"); }),
            "doe::RunJournal: \"/dev/zero\" is a device or a pipe; choose a file");
}

// A wrong count among good runs fails the run here, and is made again by the next call, which may return what it
// should.
TEST_F(RunJournalTest, KeepsNoWrongCount) {
  const auto f = [](bool right) {
    return [right](const Eigen::VectorXd& x) {
      return right || x[0] < 0.5 ? Outcome(x[0]) : Outcome{1.0, 2.0};
    };
  };
  const Eigen::MatrixXd X{{0.2, 0.0}, {0.8, 0.0}, {0.4, 0.0}};
  EXPECT_EQ(evaluate(f(false), problem_, X, {.journal = path_}).failed(), 1);
  EXPECT_EQ(RunJournal(problem_, path_).size(), 2);
  EXPECT_EQ(evaluate(f(true), problem_, X, {.journal = path_}).failed(), 0);
}

// With runs of before in the journal, the first of this call is not the first of the study.
TEST_F(RunJournalTest, RunsOfBeforeShowThatTheProgramIsRight) {
  const Eigen::MatrixXd X{{0.2, 0.0}, {0.8, 0.0}};
  evaluate([](const Eigen::VectorXd& x) { return x[0]; }, problem_, X.topRows(1), {.journal = path_});
  const auto two = [](const Eigen::VectorXd&) { return Outcome{1.0, 2.0}; };
  EXPECT_EQ(evaluate(two, problem_, X, {.journal = path_}).failed(), 1);
  EXPECT_THROW(evaluate(two, problem_, X.bottomRows(1), {.first_run = 1}), std::invalid_argument);
}

}  // namespace
