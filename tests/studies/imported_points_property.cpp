// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Tables of points made elsewhere: what is taken of them, and that a wrong one is refused with its place.

#include <drawpoint/studies/model/fits/tables.h>
#include <drawpoint/studies/run/points/imported_points.h>
#include <drawpoint/studies/run/settings.h>
#include <gtest/gtest.h>
#include <drawpoint/tests/studies/support.hpp>

#include <algorithm>
#include <fstream>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

const doe::Problem problem{
    .variables = {{"speed", "m/s", 1.0, 6.0}, doe::categorical_variable("lining", {"steel", "rubber"})},
    .responses = {{.name = "wear", .unit = "1", .goal = doe::Goal::minimize, .lower = 0}}};

class ImportedPoints : public testing::Test {
 protected:
  std::vector<studies::Run> imported(const std::string& text,
                                     const std::vector<studies::Run>& existing = {}) const {
    std::ofstream(file()) << text;
    return imported_runs(file(), problem, existing);
  }
  std::string refused(const std::string& text) const {
    try {
      imported(text);
    } catch (const UsageError& e) {
      return e.what();
    }
    return "";
  }
  std::filesystem::path file() const { return place_.path() / "points.csv"; }

  test::TestFolder place_;
};

}  // namespace

TEST_F(ImportedPoints, AreTakenByNameWhateverElseTheTableHolds) {
  const auto runs = imported(
      "who,wear [1],lining,speed [m/s],status\nann,0.25,rubber,2.5,done\nbob,,steel,3,failed\ncy,0,0,6,done");
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].x, Eigen::Vector2d(2.5, 1.0));
  EXPECT_EQ(runs[0].y, Eigen::VectorXd::Constant(1, 0.25));
  EXPECT_EQ(runs[1].x, Eigen::Vector2d(6.0, 0.0));
  EXPECT_EQ(runs[1].id, 2);
  EXPECT_EQ(runs[1].point, 2);
  EXPECT_TRUE(runs[1].kind == Kind::imported && runs[1].status == Status::done);
}

TEST_F(ImportedPoints, MayHaveNamesOfRowsBeforeThem) {
  EXPECT_EQ(imported(",speed,lining,wear\n0,2,0,1\n1,3,0,1\n").size(), 2u);
  EXPECT_EQ(imported("\"\",\"speed\",\"lining\",\"wear\"\n\"1\",2,0,1\n").size(), 1u);
}

TEST_F(ImportedPoints, RoundOffBelowABoundIsTheBound) {
  EXPECT_EQ(imported("speed,lining,wear\n2,0,-1.1e-16\n").at(0).y[0], 0.0);
}

TEST_F(ImportedPoints, AreTakenOnce) {
  const std::string table = "\xEF\xBB\xBFspeed,lining,wear\r\n2,0,1\r\n3,0,1\r\n";
  const auto first = imported(table);
  ASSERT_EQ(first.size(), 2u);
  EXPECT_TRUE(imported(table, first).empty());
  const auto more = imported(table + "3,0,1.5\n", first);
  ASSERT_EQ(more.size(), 1u) << "another answer at the same place is another run";
  EXPECT_EQ(more[0].id, 3);
}

// The table still says what stood there before a run was put right, or says what is right by now.
TEST_F(ImportedPoints, DoNotUndoACorrection) {
  auto runs = imported("speed,lining,wear\n2,0,1\n3,0,1\n");
  runs[1].y[0] = 1.75;
  const std::vector<Correction> ledger = {
      {.run = 2, .what = "replace", .why = "", .before = R"({"status":"done","values":[1.0]})", .made = ""},
      {.run = 1, .what = "exclude", .why = "", .before = R"({"status":"done","values":[1.0]})", .made = ""}};
  for (const char* value : {"1", "1.75"}) {
    std::ofstream(file()) << "speed,lining,wear\n2,0,1\n3,0," << value << "\n";
    EXPECT_TRUE(imported_runs(file(), problem, runs, ledger).empty()) << value;
  }
  std::ofstream(file()) << "speed,lining,wear\n3,0,5\n";
  EXPECT_EQ(imported_runs(file(), problem, runs, ledger).size(), 1u);
}

TEST_F(ImportedPoints, AreRefusedWithTheirPlace) {
  const auto has = [&](const std::string& table, const std::string& part) {
    const std::string text = refused(table);
    EXPECT_NE(text.find(part), std::string::npos) << table << "\n" << text;
  };
  has("speed,wear\n2,1\n", "line 1: there is no column \"lining\"");
  has("speed [km/h],lining,wear\n2,0,1\n", "\"speed [km/h]\" is not in m/s");
  has("speed,lining,wear\n2,0,1\n2,0,\n", "line 3: \"\" is no number for \"wear\"");
  has("speed,lining,wear\n2,0,nan\n", "is no number");
  has("speed,lining,wear\n7,0,1\n", "\"speed\" is 7 m/s; allowed are 1 to 6 m/s");
  has("speed,lining,wear\n2,wood,1\n", "\"wood\" is no number for \"lining\"");
  has("speed,lining,wear\n2,0.5,1\n", "whole numbers from 0 to 1");
  has("speed,lining,wear\n2,0,-1\n", "\"wear\" is -1, which lies outside of its range");
  has("speed,lining,wear\n2,0\n", "line 2: it has 2 fields, and the first line has 3");
  has("speed,lining,wear\n2,0,1\n2,5,0,1\n", "line 3: it has 4 fields, and the first line has 3");
  has("speed,lining,wear\n2,0,1,\n", "numbers take a decimal point");
  has("speed,lining,wear,wear\n2,0,1,1\n", "the column \"wear\" stands there twice");
  has("speed,lining,wear,note,note\n2,0,1,,\n", "the column \"note\" stands there twice");
  has("speed,lining,wear,speed [m/s]\n2,0,1,3\n", "are of one quantity; remove one");
  has("speed,lining,wear\n2,0,-1e-12\n", "lies outside of its range");
  has("speed,lining,wear,,\n2,0,1,5,75\n", "line 2: \"5\" stands under no name");
  has("speed,lining,wear, \n2,0,1,75\n", "line 2: \"75\" stands under no name");
  has("speed,lining,wear\n2,0,\"1\"5\n", "behind the closing quote");
  has("speed,lining,wear,status\n2,0,1,done\n3,0,1,Done\n",
      "line 3: \"status\" is \"Done\"; allowed are done");
  has("speed,lining,wear\n", "no row with a point");
  has("", "no first line");
  std::filesystem::remove(file());
  EXPECT_THROW(imported_runs(file(), problem, {}), UsageError);
}

// 5000 imported runs and 3 of the study's own: a thousand stay, its own and the extremes among them.
TEST(ManyRuns, AreThinnedForModels) {
  std::vector<studies::Run> runs(5003);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].id = static_cast<std::int64_t>(i) + 1;
    runs[i].kind = i < 3 ? Kind::training : Kind::imported;
    runs[i].status = Status::done;
    runs[i].x = Eigen::Vector2d(1.0 + 0.001 * static_cast<double>(i), 0.0);
    runs[i].y = Eigen::VectorXd::Constant(1, i == 2001 ? 9.0 : i == 3001 ? 0.0 : 1.0);
  }
  const Tables tables = tables_of(runs, problem);
  const auto kept = runs_with_values(tables.training);
  EXPECT_EQ(kept.size(), 1000u);
  for (const std::int64_t id : {1, 2, 3, 2002, 3002})
    EXPECT_TRUE(std::find(kept.begin(), kept.end(), id) != kept.end()) << id;
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  ASSERT_EQ(tables.thinned.size(), 1u);
  EXPECT_EQ(tables.thinned[0].find("Of 5003 training runs 1000 are used for models and figures"), 0u);
  runs.resize(2000);
  EXPECT_EQ(tables_of(runs, problem).training.rows.size(), 2000u);
}
