// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// However the process of a run ends, its outcome is known.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/execution.h>

#include <chrono>
#include <map>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

using std::chrono::milliseconds;
using test::TestFolder;

class ReplyTest : public testing::Test {
 protected:
  doe::Process shell(std::int64_t id, const std::string& script, double time_limit = 0.0) {
    return {.id = id,
            .executable = "/bin/sh",
            .arguments = {"-c", script},
            .output = folder_ / ("out_" + std::to_string(id)),
            .time_limit = time_limit};
  }

  std::map<std::int64_t, doe::ProcessEnd> run_all(const std::vector<doe::Process>& jobs, int at_once) {
    doe::ProcessPool pool(at_once);
    std::map<std::int64_t, doe::ProcessEnd> ends;
    std::size_t next = 0;
    while (next < jobs.size() || pool.running() > 0) {
      while (next < jobs.size() && !pool.full()) pool.start(jobs[next++]);
      EXPECT_LE(pool.running(), at_once);
      for (const auto& end : pool.wait(milliseconds(100))) ends[end.id] = end;
    }
    return ends;
  }

  TestFolder folder_;
};

TEST_F(ReplyTest, ACrashIsAFailureThatNamesTheOutput) {
  const auto ends =
      run_all({shell(1, "echo before the end; echo more >&2; kill -SEGV $$"), shell(2, "kill -SEGV $$")}, 1);
  EXPECT_EQ(test::contents(folder_ / "out_1"), "before the end\nmore\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out_2"));
  EXPECT_EQ(outcome_of(ends.at(1), folder_ / "out_1").reason(),
            "the run's process ended by signal SIGSEGV (Segmentation fault); it printed logs/out_1");
  EXPECT_EQ(outcome_of(ends.at(2), folder_ / "out_2").reason(),
            "the run's process ended by signal SIGSEGV (Segmentation fault)");
}

TEST_F(ReplyTest, OutcomesSurviveTheChannelBitForBit) {
  const Eigen::Vector3d y(0.1 + 0.2, -5e-324, 1.7976931348623157e308);
  doe::ProcessEnd end;
  end.reply = reply_text(doe::Outcome(y));
  EXPECT_EQ(outcome_of(end, "").values(), y);
  end.reply = reply_text(doe::Failure{"bucket \"stuck\"\nat 3 m, byte \xff"});
  EXPECT_EQ(outcome_of(end, "").reason(), "bucket \"stuck\"\nat 3 m, byte \xef\xbf\xbd");
  end.reply = R"({"values":[1.0, 2)";  // cut short by a crash
  EXPECT_EQ(outcome_of(end, "").reason(), "the run's process ended with exit code 0");
}

}  // namespace
