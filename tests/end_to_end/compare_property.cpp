// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Two folders of one study side by side. With TROUBLE=logged runs beyond x = 0.9 fail, and the option price
/// is a factor of the cost and of nothing else: what it changes is known.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <algorithm>
#include <map>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string study = "env TROUBLE=logged " TROUBLED_STUDY;

class Compare : public StudyTest {
 protected:
  Compare() { made_ = run(study + " --runs 12 --validation 4" + out()); }

  std::filesystem::path other() const { return place_ / "other"; }
  Ended make_other(const std::string& options, const std::string& program = study) const {
    return run(program + options + " --out " + other().string());
  }
  std::string command() const { return study + " compare --with " + other().string() + out(); }

  /// All files below a folder, with what they hold.
  static std::map<std::string, std::string> files_of(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      files[entry.path().string()] = entry.is_regular_file() ? contents(entry.path()) : "";
    return files;
  }
  Ended made_;
};

// Equal seeds: equal designs. The cost is three times as high, so the mean difference is twice A's mean, to
// rounding of sums of at most 16 values; the wear is the same.
TEST_F(Compare, PairsWhatHasTheSamePoints) {
  ASSERT_EQ(made_.code, 0) << made_.err;
  ASSERT_EQ(make_other(" --runs 12 --validation 4 --price 3").code, 0);
  const auto before = files_of(place_ / "study"), before_other = files_of(other());
  const Ended end = run(command() + " --json");
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(files_of(dir()) == before && files_of(other()) == before_other) << "both stay as they are";
  const auto line = end.json();
  const int good = count("status = 'done'");
  EXPECT_EQ(line["pairs"], good);
  EXPECT_EQ(line["differing"], nlohmann::json({{"option price", {"1", "3"}}}));
  EXPECT_EQ(line["a"]["failed"], 16 - good);
  const auto cost = line["responses"]["cost"], wear = line["responses"]["wear"];
  EXPECT_NEAR(cost["difference"].get<double>() / cost["a"].get<double>(), 2.0, 1e-14);
  EXPECT_LT(cost["lower"], cost["difference"]);
  EXPECT_GT(cost["upper"], cost["difference"]);
  EXPECT_EQ(wear["difference"], 0.0);
  EXPECT_EQ(wear["upper"], 0.0);
  EXPECT_EQ(wear["equal"], good);
  EXPECT_EQ(line["left_out"].size(), static_cast<std::size_t>(16 - good));
  for (const auto& point : line["left_out"]) EXPECT_EQ(point["failed"], "both");
  // The least cost is that of x = 0, y = -5: below 0, and lower still at three times the price, so that B's
  // front dominates more. The models meet these responses to some 1e-6.
  const auto fronts = line["fronts"];
  EXPECT_NEAR(fronts["best"]["cost"][0].get<double>(), -5.0, 1e-3);
  EXPECT_NEAR(fronts["best"]["cost"][1].get<double>(), -15.0, 3e-3);
  EXPECT_LT(fronts["share"][0], fronts["share"][1]);

  const std::string text = run(command()).out;
  for (const std::string part :
       {"They differ in: option price (A 1, B 3)", "failed in both: ", "pairs of runs at equal points",
        " equal\n", "(hypervolume)", "Predicted by models, without an interval"})
    EXPECT_TRUE(contains(text, part));
  EXPECT_EQ(text.find("not all seeds"), std::string::npos);
}

// B fails beyond x = 0.5: where A has a value and B has none the point is named, and not in the means.
TEST_F(Compare, PointsWhereOneSideFailedAreNamed) {
  ASSERT_EQ(make_other(" --runs 12 --validation 4", "env TROUBLE=throw " TROUBLED_STUDY).code, 0);
  const Ended end = run(command() + " --json");
  ASSERT_EQ(end.code, 0) << end.err;
  const auto line = end.json();
  EXPECT_EQ(line["pairs"], count("x <= 0.5"));
  EXPECT_EQ(line["b"]["failed"], count("x > 0.5"));
  int only_b = 0;
  for (const auto& point : line["left_out"]) only_b += point["failed"] == "b";
  EXPECT_EQ(only_b, count("x > 0.5 AND x <= 0.9"));
  EXPECT_GT(only_b, 0);
  EXPECT_TRUE(line["differing"].empty()) << "B knows no price, which counts as the default, 1";
  const std::string one = query("SELECT id FROM runs WHERE x > 0.5 AND x <= 0.9");
  EXPECT_TRUE(contains(run(command()).out, "failed in B alone: " + one + "/" + one));
}

// With 9 runs the corners of the box are no part of the design, so that other seeds have no point in common.
TEST_F(Compare, OtherDesignsAreComparedWithoutPairsAndThatIsSaid) {
  std::filesystem::remove_all(dir());
  ASSERT_EQ(run(study + " --runs 9 --validation 4" + out()).code, 0);
  ASSERT_EQ(make_other(" --runs 9 --validation 4 --seed 2").code, 0);
  const auto line = run(command() + " --json").json();
  EXPECT_EQ(line["paired"], false);
  EXPECT_TRUE(line["responses"]["wear"]["larger"].is_null());
  const std::string text = run(command()).out;
  EXPECT_TRUE(contains(text, "seed (A 1, B 2)"));
  EXPECT_TRUE(contains(text, "Too few pairs of runs at equal points: 0"));
  EXPECT_TRUE(contains(text, "The designs differ, so a difference mixes design and choice."));
  EXPECT_TRUE(contains(text, "(Welch)"));
}

// The corners are a part of both designs: those at x = 0 succeed.
TEST_F(Compare, DesignsThatShareTheCornersAloneArePairedThere) {
  ASSERT_EQ(make_other(" --runs 12 --validation 4 --seed 2").code, 0);
  const std::string text = run(command()).out;
  EXPECT_TRUE(contains(text, "2 pairs of runs at equal points"));
  EXPECT_TRUE(
      contains(text, "At 2 of them not all seeds are the same, so that noise does not cancel fully."));
  EXPECT_TRUE(contains(
      text, "Most points have no pair; studies with the same --seed and --runs have the same points."));
}

TEST_F(Compare, AnotherProblemIsRefused) {
  ASSERT_EQ(make_other(" --runs 6 --validation 0", "env TROUBLE=changed " TROUBLED_STUDY).code, 0);
  expect_refused(command(), 2,
                 "holds another study: variable \"y\": upper bound 30.0 there, 25.0 here; name a folder with "
                 "the same variables and responses with --with");
  std::filesystem::remove_all(other());
  ASSERT_EQ(make_other(" --runs 20 --validation 0", FORMULA_DEMO).code, 0);
  expect_refused(command(), 2, "name \"formula_demo\" there, \"troubled\" here");
  expect_refused(study + " compare --with " + place_.string() + out(), 1, "compare: there is no study in");
  expect_refused(study + " compare --with " + dir().string() + "/" + out(), 2,
                 "--out and --with are both " + dir().string());
}

TEST_F(Compare, ASideWithoutModelsHasNoFront) {
  ASSERT_NE(make_other(" --runs 12 --validation 4 --keep-going", "env TROUBLE=all " TROUBLED_STUDY).code, 0);
  const Ended end = run(command());
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(contains(end.out, "No predicted front of B: no training run has given values"));
  EXPECT_TRUE(contains(end.out, "Too few other points to compare means: A has "));
}

// Equal training runs, so the models are the same, and judged by the other folder's runs they are worth what
// they are worth there.
TEST_F(Compare, ValidatesByTheRunsOfTheOtherFolder) {
  ASSERT_EQ(make_other(" --runs 12 --validation 8").code, 0);
  const std::string validate = study + " validate --json";
  const auto there = run(validate + " --out " + other().string()).json();
  const Ended end = run(validate + " --with " + other().string() + out());
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.json(), there);
  EXPECT_NE(run(validate + out()).json(), there);
  std::filesystem::remove_all(other());
  ASSERT_EQ(make_other(" --runs 12 --validation 4 --price 3").code, 0);
  expect_refused(study + " validate --with " + other().string() + out(), 2,
                 "are not those of " + dir().string() + ": option price: 3 there, 1 here; name a folder");
  expect_refused(study + " validate --with " + dir().string() + "/" + out(), 2, "validate: --out and --with");
}

}  // namespace
