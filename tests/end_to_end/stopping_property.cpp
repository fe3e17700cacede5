// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A study stops by what matters, an error or a time, says what that leaves out, and goes on.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <algorithm>
#include <chrono>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string demo = FORMULA_DEMO;

class Stopping : public StudyTest {
 protected:
  nlohmann::json sampling() const {
    return nlohmann::json::parse(query("SELECT value FROM study WHERE key = 'sampling'"));
  }
};

TEST_F(Stopping, AnErrorThatIsReachedEndsTheSamplingAndIsKept) {
  const std::string rule = "nrmse(production) < 0.5 and mean_error(rock_spill) < 0.9";
  const Ended reached = run(demo + " --runs 16 --validation 10 --until '" + rule + "'" + out());
  ASSERT_EQ(reached.code, 0) << reached.err;
  EXPECT_TRUE(contains(reached.out, "no further adaptive runs, the target is met: 16 runs"));
  EXPECT_TRUE(contains(reached.out, "\nreached: nrmse(production) 0."));
  EXPECT_TRUE(reached.out.ends_with(", wanted < 0.9\n")) << "the last words";
  EXPECT_EQ(count("kind = 'adaptive'"), 0);
  EXPECT_EQ(sampling()["until"], rule);
  EXPECT_EQ(sampling()["points"], 64) << "four per training point at most";
  EXPECT_TRUE(contains(contents(dir() / "report.html"), "0.5 and mean_error(rock_spill)"));
}

TEST_F(Stopping, AnErrorThatIsNotReachedIsSaidWithTheNoiseBelowWhichItCannotFall) {
  const std::string rule = " --until 'nrmse(production) < 0.0001'";
  const Ended first =
      run(demo + " --runs 12 --validation 10 --adaptive 2 --batch 2" + rule + out() + " --json");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.json()["until_met"], false);
  EXPECT_EQ(count("kind = 'adaptive'"), 2);
  EXPECT_TRUE(contains(first.err, "not reached: nrmse(production) 0.0"));
  EXPECT_TRUE(contains(first.err, "(the noise of a run alone is 0.0"));
  // The folder knows it; a rule that holds takes its place, and '' takes it away.
  const Ended status = run(demo + " status" + out());
  EXPECT_TRUE(contains(status.out, "until: nrmse(production) < 0.0001\n"));
  const Ended again = run(demo + " --adaptive 4 --until 'nrmse(production) < 0.9'" + out());
  EXPECT_TRUE(contains(again.out, "reached: ")) << again.err;
  EXPECT_EQ(count("kind = 'adaptive'"), 2);
  ASSERT_EQ(run(demo + " ask --until ''" + out()).code, 0);
  EXPECT_FALSE(sampling().contains("until"));
}

TEST_F(Stopping, WhatIsNoConditionIsRefusedBeforeAnythingIsDone) {
  const auto refused = [&](const std::string& options, const std::string& words) {
    expect_refused(demo + " --runs 6 --validation 4" + options + out(), 2, words);
    EXPECT_FALSE(std::filesystem::exists(dir()));
  };
  refused(" --until 'nrmse(speed) < 0.1'",
          "there is no response \"speed\"; there are production, joint_damage, rock_spill");
  refused(" --until 'rmse(production) < 0.1'", "there is no measure \"rmse\"; there are nrmse");
  refused(" --until 'nrmse(production) < 8'", "an error of 8 is no share of the range");
  refused(" --until 'nrmse(production) = 0.1'", "\"nrmse(production) = 0.1\" is no condition");
  refused(" --until 'nrmse(production) < 0.1' --adaptive 0", "with --adaptive 0 there are no runs to stop");
  expect_refused(demo + " --validation 0 --until 'nrmse(production) < 0.1'" + out(), 2,
                 "--until: without a validation run there is no error to reach");
  refused(" --budget 2", "\"2\" has no unit; there are s, min, h and d: give 90s, 30min, 2h or 1d");
  refused(" --budget 2w", "has the unknown unit \"w\"");
  refused(" --budget -2h", "is no time above 0");
}

TEST_F(Stopping, ABudgetSaysWhatItLeavesOutAndTheSameCommandGoesOn) {
  const std::string line =
      "env TROUBLE=slow " TROUBLED_STUDY " --runs 60 --validation 4 --adaptive 8 --jobs 2";
  const auto start = std::chrono::steady_clock::now();
  const Ended stopped = run(line + " --budget 2s" + out() + " --json");
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_LE(stopped.code, 1) << stopped.err;
  const int done = count("status = 'done'"), left = count("status = 'planned'");
  EXPECT_GE(done, 2);
  EXPECT_GE(left, 10);
  EXPECT_EQ(done + left, 64) << "none is left running";
  EXPECT_LT(seconds, 20.0);
  const int validated = count("kind = 'validation' AND status = 'done'");
  const std::string words = "the budget of 2s is spent: left out are " +
                            std::to_string(count("kind = 'training' AND status = 'planned'")) +
                            " of 60 training and " + std::to_string(4 - validated) +
                            " of 4 validation runs, and 8 adaptive points";
  EXPECT_TRUE(contains(stopped.err, "stopped: " + words + "; to go on: give the same command again\n"));
  EXPECT_EQ(stopped.json()["stopped"], words);
  EXPECT_EQ(sampling()["stopped"], words);
  EXPECT_TRUE(contains(run(TROUBLED_STUDY " status" + out()).out, "stopped: " + words));
  const Ended rest = run(TROUBLED_STUDY " --adaptive 8 --jobs 4" + out() + " --json");
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(count("status = 'done'"), 72);
  EXPECT_FALSE(rest.json().contains("stopped"));
  EXPECT_FALSE(sampling().contains("stopped"));
}

TEST_F(Stopping, ABudgetBuysValidationRunsWithTheTrainingRuns) {
  const std::string line = "env TROUBLE=slow " TROUBLED_STUDY " --jobs 2 --budget 3s" + out();
  ASSERT_LE(run(line + " --runs 90 --validation 30").code, 1);
  const auto done = [&](const std::string& kind) {
    return count("status = 'done' AND kind = '" + kind + "'");
  };
  ASSERT_GE(done("training"), 4);
  ASSERT_GE(count("status = 'planned'"), 10) << "the budget ended it";
  EXPECT_NEAR(done("validation"), done("training") / 3.0, 1.0);
  // Where validation was forgotten before, it comes first now.
  const int before = done("training");
  ASSERT_LE(run(line + " --validation 90").code, 1);
  EXPECT_NEAR(done("validation"), done("training"), 1.0 + std::max(0, before - done("validation")));
  EXPECT_GT(done("validation"), before / 3 + 2);
}

TEST_F(Stopping, ABudgetInWhichNoRunFitsSaysHowLongOneTakesAndWhatWouldDo) {
  const std::string line = "env TROUBLE=slow " TROUBLED_STUDY + out();
  ASSERT_EQ(run(line + " --runs 6 --validation 2").code, 0);
  const Ended none = run(line + " --runs 9 --budget 0.1s");
  EXPECT_EQ(none.code, 0) << none.err;
  EXPECT_TRUE(contains(none.out,
                       "no run fits into the budget of 0.1s: one takes 0.2 s, the mean of 8 runs; left out "
                       "are 3 of 9 training runs"));
  EXPECT_TRUE(contains(none.out, "to go on: give --budget 2s or more, or leave it out\n"));
  EXPECT_FALSE(contains(none.out, "making run")) << "no time for that either";
  EXPECT_EQ(count("status = 'planned'"), 3);
  const Ended enough = run(line + " --budget 2s");
  EXPECT_EQ(enough.code, 0) << enough.err;
  EXPECT_EQ(count("status = 'planned'"), 0) << "what is advised does";
}

TEST_F(Stopping, StatusSaysWhatEndedTheSamplingAndWhatGoesOn) {
  const auto status = [&] { return run(demo + " status" + out()).out; };
  const std::string begin = demo + " --runs 16 --validation 10" + out();
  ASSERT_EQ(run(begin + " --until 'nrmse(production) < 0.5'").code, 0);
  EXPECT_TRUE(contains(status(), "adaptive points: 0 of at most 64 wanted\n"));
  EXPECT_TRUE(contains(status(), "stopped: --until is reached: nrmse(production) 0."));
  EXPECT_TRUE(contains(status(), "to go on: give smaller errors in --until, or --until ''\n"));
  const Ended json = run(demo + " status --json" + out());
  EXPECT_EQ(json.json()["go_on"], "give smaller errors in --until, or --until ''");
  // With what it says it goes on; the next one is a target.
  ASSERT_EQ(run(begin + " --until '' --target 0.9 --adaptive 8 --batch 4").code, 0);
  EXPECT_TRUE(contains(status(), "stopped: --target 0.9 is reached: the largest error of a mean is 0."));
  EXPECT_TRUE(contains(status(), "to go on: give a smaller --target, or --target 0\n"));
  ASSERT_EQ(run(begin + " --target 0 --hours 0").code, 0);
  const int left = 8 - count("kind = 'adaptive'");
  EXPECT_TRUE(contains(status(), "stopped: --hours is over: left out are " + std::to_string(left) +
                                     " of 8 adaptive points\n"));
  EXPECT_TRUE(contains(status(), "to go on: give the same command again\n"));
  const Ended all = run(begin + " --target 0");
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(count("kind = 'adaptive'"), 8);
  EXPECT_FALSE(contains(status(), "stopped: "));
  EXPECT_TRUE(contains(status(), "adaptive points: 8 of 8 wanted\n"));
}

}  // namespace
