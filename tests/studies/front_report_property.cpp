// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What the command front says: the points that matter, what each is, what simulation said, and the cautions.

#include <gtest/gtest.h>

#include <drawpoint/studies/model/fronts/decision_points.h>
#include <drawpoint/studies/say/front_report.h>
#include <drawpoint/studies/say/text_table.h>
#include <drawpoint/tests/studies/report_cases.hpp>

#include <algorithm>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

class FrontReport : public testing::Test {
 protected:
  /// Two objectives, y0 maximized and y1 minimized; five points along the diagonal of the box, on which both
  /// rise: every one is on the front.
  FrontReport() {
    input_.front = {};
    input_.front.X.resize(5, 2);
    input_.front.Y.resize(5, 2);
    for (int i = 0; i < 5; ++i) {
      const Eigen::Vector2d x = Eigen::Vector2d::Constant(0.5 * i);
      input_.front.X.row(i) = x.transpose();
      input_.front.Y.row(i) = report_cases::formula(x, 2).transpose();
    }
    input_.front.responses = input_.front.Y;
  }

  void simulate(const Eigen::Vector2d& x, const doe::Outcome& outcome) {
    CheckedRun run{.run = 41, .round = 1, .x = x, .outcome = outcome};
    run.predicted = run.lower = run.upper = Eigen::Vector2d::Zero();
    run.within = {true, false};
    run.values = 2;
    run.held = 1;
    input_.confirmations.add(run);
  }

  bool says(const std::string& part, int most = 6, bool every = false) const {
    return front_points_text(input_, most, every).find(part) != std::string::npos;
  }

  std::string line_of(const std::string& start, bool every = true) const {
    const std::string text = front_points_text(input_, 5, every);
    const std::size_t at = text.find("\n" + start + " ") + 1;
    return text.substr(at, text.find('\n', at) - at);
  }

  ReportInput input_ = report_cases::input(2, 2, 12, 10);
};

TEST_F(FrontReport, ShowsWhatADecisionRestsOn) {
  EXPECT_TRUE(says("Pareto front of 5 points, predicted by the models; 2 shown", 2));
  EXPECT_TRUE(says("5 shown.", 2, true));
  EXPECT_NE(line_of("5").find("highest y0"), std::string::npos) << line_of("5");
  EXPECT_NE(line_of("1").find("lowest y1"), std::string::npos) << line_of("1");
  const int balanced = decision_points(input_.front, input_.problem).balanced;
  EXPECT_NE(line_of(std::to_string(balanced + 1)).find("balanced choice"), std::string::npos);
  EXPECT_TRUE(says("x0 [m]"));
  EXPECT_TRUE(says("y1 [s]"));
}

// The models are exact to a thousandth here, so mean and ends of the interval read alike.
TEST_F(FrontReport, SaysTheIntervalOfARun) {
  const auto points = front_points_json(input_, 3)["points"];
  ASSERT_EQ(points.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    const auto& predicted = points[static_cast<std::size_t>(i)]["predicted"]["y0"];
    EXPECT_NEAR(predicted["mean"], input_.front.Y(i, 0), 0.05);
    EXPECT_LE(predicted["lower"], predicted["mean"]);
    EXPECT_GE(predicted["upper"], predicted["mean"]);
    EXPECT_EQ(points[static_cast<std::size_t>(i)]["x"]["x1"], 0.5 * i);
  }
  EXPECT_EQ(points[4]["best"], nlohmann::json({"y0"}));
  EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const auto& p) { return p["chosen"] == true; }),
            3);
  EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const auto& p) { return p["balanced"] == true; }),
            1);
}

TEST_F(FrontReport, SaysWhatSimulationSaid) {
  EXPECT_TRUE(says("Confirmed by simulation: nothing yet; the command confirm"));
  simulate({0.01, 0.0}, Eigen::VectorXd(Eigen::Vector2d(0.125, 7.5)));
  EXPECT_TRUE(says("run 41"));
  EXPECT_TRUE(says("7.50 outside"));
  EXPECT_FALSE(says("0.125 outside"));
  EXPECT_TRUE(says("1 point, 1 of 2 values within the stated 95 % interval; the last round does not agree"));
  EXPECT_EQ(front_points_json(input_, 6)["points"][0]["simulated"], nlohmann::json({41}));
  EXPECT_EQ(front_points_json(input_, 6)["confirmed"]["within"], 1);
}

TEST_F(FrontReport, SaysWhenNoPointShownWasSimulated) {
  simulate({2.0, 0.0}, doe::Failure{"stuck"});
  EXPECT_FALSE(says("run 41"));
  EXPECT_TRUE(says("No point shown has been simulated"));
  simulate({2.0, 2.0}, doe::Failure{"stuck"});
  EXPECT_TRUE(says("failed: stuck"));
}

TEST_F(FrontReport, SaysHowLikelyAPointIsOnTheFront) {
  EXPECT_FALSE(says("non-dominated"));
  EXPECT_TRUE(front_points_json(input_, 6)["points"][1]["non_dominated"].is_null());
  input_.uncertainty.non_dominated = Eigen::VectorXd::LinSpaced(5, 0.2, 1.0);
  EXPECT_TRUE(says("non-dominated  what it is"));
  EXPECT_NE(line_of("2").find("40 %"), std::string::npos) << line_of("2");
  EXPECT_TRUE(says("Non-dominated: how likely the mean"));
  EXPECT_EQ(front_points_json(input_, 6)["points"][4]["non_dominated"], 1.0);
}

TEST_F(FrontReport, RepeatsTheReportsCautions) {
  input_.warnings = {"mind this"};
  EXPECT_TRUE(says("Caution: mind this\n"));
  EXPECT_EQ(front_points_json(input_, 6)["cautions"][0], "mind this");
}

// Rows 0 and 1 are one strategy: what the second is goes to the first, which stands for both.
TEST_F(FrontReport, AMarkGoesToThePointInItsPlace) {
  input_.front.X.row(1) = Eigen::RowVector2d(0.01, 0.0);
  input_.front.Y.row(1) = Eigen::RowVector2d(0.0, -1.0);  // now the lowest y1
  input_.front.Y.row(0) = Eigen::RowVector2d(9.0, 0.0);   // and the highest y0
  EXPECT_NE(line_of("1", false).find("highest y0, lowest y1"), std::string::npos) << line_of("1", false);
  EXPECT_EQ(line_of("1").find("lowest y1"), std::string::npos) << "every point speaks for itself";
}

TEST(TextTable, AlignsCharactersAndEndsLinesWithoutBlanks) {
  EXPECT_EQ(text_table({{"a", "bb", "c"}, {"µµµ", "1"}, {"x", "y", "z"}}),
            "a    bb  c\nµµµ  1\nx    y   z\n");
}

}  // namespace
