// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// However the process of a run ends, its outcome is known.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/runs/execution.h>

#include <drawpoint/tests/support/shell_processes.hpp>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

using test::TestFolder;

TEST(Reply, ACrashIsAFailureThatNamesTheOutput) {
  const TestFolder folder;
  const auto ends =
      support::run_all({support::shell(folder.path(), 1, "echo before the end; echo more >&2; kill -SEGV $$"),
                        support::shell(folder.path(), 2, "kill -SEGV $$")},
                       1);
  EXPECT_EQ(test::contents(folder / "out_1"), "before the end\nmore\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "out_2"));
  EXPECT_EQ(outcome_of(ends.at(1), folder / "out_1").reason(),
            "the run's process ended by signal SIGSEGV (Segmentation fault); it printed logs/out_1");
  EXPECT_EQ(outcome_of(ends.at(2), folder / "out_2").reason(),
            "the run's process ended by signal SIGSEGV (Segmentation fault)");
}

TEST(Reply, OutcomesSurviveTheChannelBitForBit) {
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
