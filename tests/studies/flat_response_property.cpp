// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A study of two objectives that compete and a third that is noise: the third is left out of the trade-off,
/// and text, JSON and page say so.

#include <drawpoint/studies/model/fronts/decision_points.h>
#include <drawpoint/studies/model/fronts/front.h>
#include <drawpoint/studies/model/fronts/front_uncertainty.h>
#include <drawpoint/studies/say/front_report.h>
#include <drawpoint/studies/say/model_report.h>
#include <drawpoint/studies/say/page/data.h>
#include <drawpoint/studies/say/study_summary.h>
#include <gtest/gtest.h>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/seed.hpp>

#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

doe::Problem problem(std::vector<doe::Goal> goals) {
  doe::Problem p{.variables = {{"alpha", "1", 0.0, 1.0}, {"beta", "1", 0.0, 1.0}}, .responses = {}};
  const char* names[] = {"reach", "cost", "rock_spill"};
  for (std::size_t j = 0; j < 3; ++j) p.responses.push_back({names[j], "t", goals[j]});
  return p;
}

doe::Evaluations runs(const doe::Problem& problem, int n, doe::Seed seed) {
  doe::Evaluations table{problem, {}};
  const Eigen::MatrixXd X = doe::latin_hypercube(problem, n, {.seed = seed});
  doe::RandomStream random(seed);
  for (int i = 0; i < n; ++i) {
    const double a = X(i, 0), b = X(i, 1);
    table.rows.push_back(
        {i + 1, 0, 1, X.row(i), doe::Outcome{a + 0.1 * b, a * a + b * b, 9 + random.normal()}, 0.0});
  }
  return table;
}

constexpr auto smallest = doe::Goal::minimize, largest = doe::Goal::maximize, recorded = doe::Goal::record;

/// As add_models makes it.
ReportInput input(const std::vector<doe::Goal>& goals) {
  ReportInput in;
  in.study = "formula";
  in.problem = problem(goals);
  in.training = runs(in.problem, 40, 1);
  in.validation = runs(in.problem, 12, 2);
  const Tables tables{in.training, in.validation};
  Models fitted = fit_models(tables);
  PredictedFront predicted = predicted_front(fitted.models, tables, 1);
  in.models = fitted.models;
  in.validations = fitted.validations;
  in.mean_errors = fitted.mean_errors;
  in.problem = predicted.problem;
  in.flat = predicted.flat;
  in.front = predicted.found.front;
  in.no_front = predicted.missing;
  in.uncertainty = uncertainty_of(in.front, in.models, in.problem, 1);
  return in;
}

const ReportInput& trade_off() {
  static const ReportInput in = input({largest, smallest, smallest});
  return in;
}

bool mentions(const nlohmann::json& texts, const std::string& part) {
  return texts.dump().find(part) != std::string::npos;
}

}  // namespace

TEST(FlatResponse, IsNoObjective) {
  const ReportInput& in = trade_off();
  ASSERT_EQ(in.flat.size(), 1u);
  EXPECT_EQ(in.flat[0].response, 2u);
  EXPECT_EQ(in.flat[0].asked, smallest);
  EXPECT_EQ(in.problem.responses[2].goal, recorded);
  EXPECT_EQ(in.front.Y.cols(), 2);
  EXPECT_EQ(in.front.responses.cols(), 3);
  EXPECT_GT(in.front.X.rows(), 20);
  EXPECT_EQ(as_asked(in.problem, in.flat).responses[2].goal, smallest);
  EXPECT_EQ(decision_points(in.front, in.problem).best.size(), 2u);
  EXPECT_FALSE(points_to_confirm(in.front, in.problem, Eigen::MatrixXd(0, 2), 6).empty());
}

TEST(FlatResponse, IsSaidInTextAndJson) {
  const std::string text = front_points_text(trade_off(), 6, false);
  EXPECT_NE(
      text.find(
          "rock_spill: its model does not differ between strategies by clearly more than its own error"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("it is left out of the trade-off"), std::string::npos);
  EXPECT_EQ(text.find("lowest rock_spill"), std::string::npos);
  const auto json = front_points_json(trade_off(), 6);
  EXPECT_EQ(json["flat"][0]["response"], "rock_spill");
  Summary summary{.study = "s", .flat = texts_of(trade_off().flat, trade_off().problem)};
  EXPECT_NE(drawpoint::studies::text(summary).find("  rock_spill: its model does not differ"),
            std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(json_line(summary))["flat"][0]["response"], "rock_spill");
}

TEST(FlatResponse, HasNeitherBarsNorOptimumNorSurfaceOnThePage) {
  const nlohmann::json page = detail::report_data(trade_off());
  EXPECT_EQ(page["front"]["objectives"], nlohmann::json({0, 1}));
  EXPECT_EQ(page["problem"]["responses"][2]["goal"], "minimize") << "what the study asks";
  EXPECT_TRUE(page["influence"][2].is_null());
  EXPECT_FALSE(page["influence"][1].is_null());
  EXPECT_TRUE(page["flat"][1].is_null());
  EXPECT_TRUE(mentions(page["flat"][2], "left out of the trade-off"));
  EXPECT_FALSE(mentions(page["summary"]["cards"], "rock spill"));
  EXPECT_TRUE(mentions(page["summary"]["sentences"], "Rock spill: its model does not differ"));
  EXPECT_EQ(page["summary"]["trust"][2]["grade"], "flat");
  EXPECT_TRUE(mentions(page["summary"]["next"], "Strategies do not differ clearly in rock spill"));
}

TEST(FlatResponse, ThatIsNoObjectiveIsSaidInAWord) {
  const nlohmann::json page = detail::report_data(input({largest, smallest, recorded}));
  EXPECT_TRUE(mentions(page["summary"]["sentences"],
                       "Of rock spill nothing is said: its model does not differ between strategies"));
}

TEST(FlatResponse, LeavesTheOptimumOfTheOtherObjective) {
  const ReportInput in = input({recorded, smallest, smallest});
  ASSERT_EQ(in.front.X.rows(), 1);
  EXPECT_EQ(in.front.Y.cols(), 1);
  EXPECT_LT(in.front.X.row(0).norm(), 0.1) << "cost is least at the origin";
  EXPECT_NO_THROW(detail::report_data(in));
  EXPECT_NO_THROW(front_points_text(in, 6, true));
}

TEST(FlatResponse, AloneHasNoFront) {
  const ReportInput in = input({recorded, recorded, smallest});
  EXPECT_EQ(in.front.X.rows(), 0);
  EXPECT_EQ(
      in.no_front,
      "no model of an objective (rock spill) differs between strategies by clearly more than its own error");
  const nlohmann::json page = detail::report_data(in);
  EXPECT_EQ(page["no_front"], in.no_front);
  EXPECT_TRUE(mentions(page["summary"]["next"], "Strategies do not differ clearly in rock spill"));
}

TEST(FlatResponse, RecordedOnlyIsSaidWithoutATradeOff) {
  const ReportInput in = input({largest, smallest, recorded});
  ASSERT_EQ(in.flat.size(), 1u);
  EXPECT_EQ(flat_objectives(in.flat, in.problem), "");
  EXPECT_EQ(flat_text(in.flat[0], in.problem).find("left out"), std::string::npos);
}

// No run reports its noise, and the model takes all for noise: that would leave no error at all.
TEST(FlatResponse, ItsOwnNoiseIsNotTakenOutOfItsError) {
  const ReportInput& in = trade_off();
  EXPECT_DOUBLE_EQ(in.mean_errors[2].rmse, in.validations[2].rmse);
  EXPECT_EQ(in.mean_errors[2].noise, 0);
}
