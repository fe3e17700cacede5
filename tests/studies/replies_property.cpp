// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// However the process of a run ends, its outcome is known.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/run/first_failures.h>
#include <drawpoint/studies/run/run_ends.h>

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
            "the run's process ended by signal SIGSEGV (Segmentation fault); it printed last \"more\" "
            "(logs/out_1)");
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

TEST(Reply, WhateverItIsItFailsTheRunAndNothingElse) {
  for (const std::string& text :
       {std::string(R"({"failure": 3})"), std::string(R"({"failure": null})"),
        std::string(R"({"values": "x"})"), std::string(R"({"values": [null]})"),
        std::string(R"({"values": [[1]]})"), std::string(R"({"values": {}})"), std::string("[]"),
        std::string("3"), std::string("\0\xff", 2), std::string(1000000, '['),
        std::string(R"({"failure": "a", "crashed": "yes"})")}) {
    doe::ProcessEnd end;
    end.reply = text;
    EXPECT_TRUE(outcome_of(end, "").failed()) << text.substr(0, 40);
  }
}

TEST(Reply, WhatCannotBeStartedIsToldApart) {
  doe::ProcessEnd end;
  end.reply = reply_text(doe::Failure{"no run bit"}, ProgramTrouble::Kind::not_started);
  EXPECT_TRUE(run_end(end, "").not_started);
  EXPECT_EQ(run_end(end, "").outcome.reason(), "no run bit");
  end = {};
  end.not_started = "Permission denied";
  EXPECT_TRUE(run_end(end, "").not_started);
  end = {};
  end.wait_status = 127 << 8;
  EXPECT_FALSE(run_end(end, "").not_started);
}

TEST(FirstRuns, AreAlikeWhereTheyDifferInNumbersAlone) {
  FirstFailures alike(false), differ(false), good(false), off(true);
  for (int k = 1; k <= FirstFailures::few; ++k) {
    alike.failed("line " + std::to_string(k) + ": 0." + std::to_string(k) + " (logs/run_000" +
                 std::to_string(k));
    differ.failed(k == 3 ? "other" : "same");
    k == 2 ? good.done() : good.failed("same");
    off.failed("same");
  }
  EXPECT_TRUE(alike.all_alike());
  EXPECT_EQ(alike.reason(), "line 1: 0.1 (logs/run_0001");
  EXPECT_FALSE(differ.all_alike() || good.all_alike() || off.all_alike());
}

}  // namespace
