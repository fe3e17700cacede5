// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What is recommended, what it gains, and how that is said, where the truth is known: production 10 x0 - 5 x1, to
/// be large, and damage 10 x0² + 5 x1, to be small. On the front x1 is 0 and x0 = t goes from 0 to 1; it is scaled to
/// 10 in both, so that the point nearest to the best of both at once has the least (1 - t)² + t⁴: 2 t³ + t = 1,
/// t = 0.58975.

#include <drawpoint/studies/model/hauls.h>
#include <drawpoint/studies/model/recommendation.h>
#include <drawpoint/studies/say/front_report.h>
#include <drawpoint/studies/say/page/answer.h>
#include <drawpoint/studies/say/page/data.h>
#include <gtest/gtest.h>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/fit.hpp>

#include <cmath>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

constexpr double best_t = 0.58975, step = 0.01;  // the front below has a point at each hundredth

doe::Problem of_two() {
  return {.variables = {{"x0", "1", 0.0, 1.0}, {"x1", "1", 0.0, 1.0}},
          .responses = {{"production", "kg/s", doe::Goal::maximize}, {"damage", "s", doe::Goal::minimize}}};
}

Eigen::Vector2d truth_at(const Eigen::VectorXd& x) {
  return {10 * x[0] - 5 * x[1], 10 * x[0] * x[0] + 5 * x[1]};
}

/// Runs with normal noise of this deviation, their models, and the true front.
ReportInput known_study(double noise, doe::Seed seed = 1, int n = 24) {
  ReportInput in;
  in.study = "known";
  in.problem = of_two();
  in.training.problem = in.validation.problem = in.problem;
  doe::RandomStream random(seed);
  const Eigen::MatrixXd X = doe::latin_hypercube(in.problem, n, {.seed = seed});
  for (int i = 0; i < n; ++i) {
    Eigen::VectorXd y = truth_at(X.row(i).transpose());
    for (double& value : y) value += noise * random.normal();
    in.training.rows.push_back({i + 1, 0, 1, X.row(i), doe::Outcome(y), 1.0});
  }
  for (const auto& response : in.problem.responses)
    in.models.push_back(kriging::fit(X, in.training.y(response.name)));
  in.front.X = Eigen::MatrixXd::Zero(101, 2);
  in.front.X.col(0) = Eigen::VectorXd::LinSpaced(101, 0, 1);
  in.front.Y = in.front.responses = predicted_means(in, in.front.X);
  return in;
}

/// analyse() does this once, for all who say something of the recommendation.
ReportInput with_recommendation(ReportInput in) {
  in.recommended = recommend(in);
  return in;
}

std::string all_of(const ReportInput& in) {
  std::string text;
  for (const std::string& sentence : answer_sentences(with_recommendation(in))) text += sentence + "\n";
  return text;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Recommendation, IsTheKnownPointAndItsGainIsTheKnownDifference) {
  const ReportInput in = known_study(0);
  const auto found = recommend(in);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x[0], best_t, step);
  EXPECT_EQ(found->x[1], 0.0);
  EXPECT_EQ(found->reference.name, "the middle of the box");
  ASSERT_EQ(found->gains.size(), 2u);
  const Eigen::Vector2d gain = truth_at(found->x) - truth_at(Eigen::Vector2d(0.5, 0.5));
  for (std::size_t k = 0; k < 2; ++k) {
    const Gain& g = found->gains[k];
    EXPECT_NEAR(g.difference(), gain[static_cast<Eigen::Index>(k)], 0.05);
    EXPECT_LE(g.lower, g.difference());
    EXPECT_GE(g.upper, g.difference());
    EXPECT_TRUE(g.is_sure());
  }
  const std::string text = all_of(in);
  EXPECT_TRUE(has(text, "Take x0 = 0.590, x1 = 0: ")) << text;
  EXPECT_TRUE(has(text, "predicted and not simulated yet; confirm --points 0 --rounds 1 --x=")) << text;
  EXPECT_TRUE(has(text, "the mean of many runs is with 95 % better in production and damage")) << text;
}

// No point of the front is better than one of it, but that one itself.
TEST(Recommendation, IsNoWorseThanTheUsersOwnInAnyObjective) {
  ReportInput in = known_study(0);
  in.marks = {{"reference", in.front.X.row(30).transpose()}};
  EXPECT_NEAR(recommend(in)->x[0], 0.3, 1e-12);
  EXPECT_TRUE(has(all_of(in), "That is reference itself."));
  in.marks = {{"reference", Eigen::Vector2d(0.7, 0.3)}};  // production 5.5, damage 6.4: t from 0.55 to 0.8
  EXPECT_NEAR(recommend(in)->x[0], best_t, step);
  in.marks = {{"reference", Eigen::Vector2d(0.8, 0.1)}};  // 7.5 and 6.9: t from 0.75 to 0.83
  EXPECT_NEAR(recommend(in)->x[0], 0.75, 1.5 * step);
  in.marks = {{"someone's", Eigen::Vector2d(0.8, 0.1)}};
  EXPECT_NEAR(recommend(in)->x[0], best_t, step) << "the middle counts: no mark is called reference";
}

// Noise of ten times the range of the truth hides every difference; a best place there is all the same.
TEST(Recommendation, IsNoneWhereNothingIsToldApart) {
  for (const doe::Seed seed : {1, 2, 3}) {
    ReportInput in = known_study(100, seed, 8);
    const std::string text = all_of(in);
    EXPECT_TRUE(has(text, "it is not told to be better than the middle of the box.")) << text;
    EXPECT_FALSE(has(text, "Take ")) << text;
    in.marks = {{"reference", recommend(in)->x}};
    EXPECT_TRUE(has(all_of(in), "Take ")) << "what is done already";
  }
}

// Whoever may not stay where he is wants a place that is allowed, better or not.
TEST(Recommendation, SaysWhereTheReferenceBreaksALimit) {
  ReportInput in = known_study(100, 1, 8);
  in.problem.responses.push_back(
      {.name = "strength", .unit = "MPa", .goal = doe::Goal::at_least, .limit = 0.55});
  in.training.problem = in.validation.problem = in.problem;
  for (doe::Evaluation& row : in.training.rows) {
    Eigen::Vector3d y;
    y << row.outcome.values(), row.x[0];
    row.outcome = doe::Outcome(y);
  }
  in.models.push_back(kriging::fit(in.training.X(), in.training.y("strength")));
  in.front.responses = predicted_means(in, in.front.X);
  const std::string text = all_of(in);
  EXPECT_TRUE(has(text, "Take x0 = ")) << text;
  EXPECT_TRUE(has(text, "; the middle of the box itself breaks a limit: strength 0.500 MPa.")) << text;
}

TEST(Recommendation, OfOneObjectiveIsTheBestPointFound) {
  ReportInput in = known_study(0);
  in.problem.responses[1].goal = doe::Goal::record;
  in.front.X = Eigen::MatrixXd(1, 2);
  in.front.X << 1, 0;
  in.front.Y = predicted_means(in, in.front.X).leftCols(1);
  ASSERT_TRUE(recommend(in));
  EXPECT_EQ(recommend(in)->row, 0);
  ASSERT_EQ(recommend(in)->gains.size(), 1u);
  EXPECT_NEAR(recommend(in)->gains[0].difference(), 7.5, 0.05);
}

TEST(Recommendation, KeepsAwayFromWhereRunsFail) {
  ReportInput in = known_study(0);
  in.success = (in.front.X.col(0).array() < 0.4).select(Eigen::VectorXd::Ones(101), 0.5);
  EXPECT_NEAR(recommend(in)->x[0], 0.39, 1e-12);
}

CheckedRun simulated(const ReportInput& in, double t, std::int64_t run) {
  CheckedRun checked{.run = run, .round = 1, .x = Eigen::Vector2d(t, 0), .outcome = doe::Outcome(0.0)};
  const Eigen::VectorXd y = truth_at(checked.x);
  checked.outcome = doe::Outcome(y);
  checked.predicted = checked.lower = checked.upper = y;
  checked.within.assign(in.problem.responses.size(), true);
  return checked;
}

TEST(Recommendation, ASimulatedPlaceTakesItsSteadWhereItDoesAsWell) {
  ReportInput in = known_study(0);
  in.confirmations.add(simulated(in, 0.8, 50));
  EXPECT_GE(recommend(in)->row, 0) << "0.8 is a fifth of both ranges away";
  in = known_study(0);
  const double before = recommend(in)->x[0];
  in.confirmations.add(simulated(in, before + 0.03, 50));  // 3 % of one range, 3.6 % of the other
  in.training.rows.push_back({50, 0, 1, in.confirmations.runs[0].x, in.confirmations.runs[0].outcome, 1.0});
  const auto found = recommend(in);
  EXPECT_EQ(found->row, -1);
  EXPECT_NEAR(found->x[0], before + 0.03, 1e-12);
  ASSERT_EQ(found->simulated.size(), 1u);
  EXPECT_EQ(found->simulated[0].run, 50);
  EXPECT_TRUE(has(all_of(in), "simulated: run 50 gave production")) << all_of(in);
  EXPECT_TRUE(
      has(front_points_text(with_recommendation(in), 3, false), "Recommended is a simulated place: x0 = 0.6"))
      << before;
  in.confirmations.runs[0].breaks_limit = true;
  EXPECT_GE(recommend(in)->row, 0) << "what broke a limit is not recommended";
}

// Of 60 noisy studies the interval of the gain in production at a fixed pair of places holds the true one in about 57.
// With 95 % each the chance that fewer than 50 do is 2e-4; intervals of half the width hold in 40.
TEST(Recommendation, TheIntervalOfTheGainHoldsTheTruth) {
  int held = 0;
  for (doe::Seed seed = 1; seed <= 60; ++seed) {
    const ReportInput in = known_study(1.5, seed, 30);
    const auto found = recommend(in);
    const double truth = truth_at(found->x)[0] - truth_at(found->reference.x)[0];
    held += found->gains[0].lower <= truth && truth <= found->gains[0].upper;
  }
  EXPECT_GE(held, 50);
}

TEST(Answer, SaysWhyNothingIsRecommended) {
  ReportInput in = known_study(0);
  in.models.clear();
  in.front = {};
  EXPECT_TRUE(has(all_of(in),
                  "24 runs that succeeded are too few for a model. Of production the best of 24 single "
                  "runs, run "))
      << all_of(in);
  for (doe::Evaluation& e : in.training.rows) e.outcome = doe::Failure{"the pile is empty"};
  EXPECT_TRUE(has(all_of(in), "all 24 runs failed, for example because the pile is empty.")) << all_of(in);
  in.training.rows.clear();
  EXPECT_TRUE(has(all_of(in), "no run that counts has ended yet")) << all_of(in);
  for (doe::Response& r : in.problem.responses) r.goal = doe::Goal::record;
  EXPECT_TRUE(has(all_of(in), "names no response to minimize or maximize")) << all_of(in);
  ReportInput flat = known_study(0);
  flat.front = {};
  for (std::size_t j = 0; j < 2; ++j) {
    flat.flat.push_back({j, flat.problem.responses[j].goal});
    flat.problem.responses[j].goal = doe::Goal::record;
  }
  EXPECT_TRUE(has(all_of(flat), "no objective (production, damage) differs")) << all_of(flat);
}

// The best of runs that scatter by 2 with a told standard error: its interval is 1.96 times that to both sides.
TEST(Answer, CallsLuckLuck) {
  ReportInput in = known_study(0);
  in.problem.responses[0].standard_error = "production_error";
  in.problem.responses.push_back({"production_error", "kg/s", doe::Goal::record});
  in.training.problem = in.problem;
  double most = -100;
  for (doe::Evaluation& e : in.training.rows) {
    const Eigen::VectorXd y = e.outcome.values();
    most = std::max(most, y[0]);
    e.outcome = doe::Outcome{y[0], y[1], 2.0};
  }
  char wanted[80];
  std::snprintf(wanted, sizeof wanted, "gave %.2f kg/s (%.2f to %.1f kg/s with 95 %%)", most, most - 3.92,
                most + 3.92);
  const std::string text = detail::luckiest_run(in, 0);
  EXPECT_TRUE(has(text, "the luckiest of 24 single runs, run ")) << text;
  EXPECT_TRUE(has(text, wanted)) << text << "\n" << wanted;
  EXPECT_TRUE(has(text, "where the model expects")) << text;
}

TEST(Marks, AreRefusedOutsideOfTheBox) {
  const auto refused = [](const std::vector<Mark>& marks) -> std::string {
    try {
      check_marks(of_two(), marks);
      return "";
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
  };
  EXPECT_EQ(refused({{"today", Eigen::Vector2d(0.5, 1.0)}}), "");
  EXPECT_EQ(refused({{"today", Eigen::Vector2d(0.5, 1.5)}}),
            "studies::Mark \"today\": x1 = 1.5 is outside its range 0 to 1; give a value within it");
  EXPECT_TRUE(
      has(refused({{"today", Eigen::VectorXd::Zero(3)}}), "it has 3 values; give 2, one per variable"));
  EXPECT_TRUE(has(refused({{"a", Eigen::Vector2d(0, 0)}, {"a", Eigen::Vector2d(1, 0)}}), "given twice"));
}

TEST(Marks, OfACategoryAreWhole) {
  doe::Problem problem = of_two();
  problem.variables[0] = doe::categorical_variable("rock", {"ore", "waste"});
  const auto check = [&](double level) { check_marks(problem, {{"today", Eigen::Vector2d(level, 0.5)}}); };
  EXPECT_NO_THROW(check(1));
  EXPECT_THROW(check(0.5), std::invalid_argument);
}

// What was found once is what everybody says of it: the sentences, the page, the front's table and the hauls.
TEST(Recommendation, IsFoundOnceForAllWhoSayIt) {
  ReportInput in = with_recommendation(known_study(0));
  in.recommended->x = in.front.X.row(7);
  in.recommended->row = 7;
  EXPECT_TRUE(has(answer_sentences(in)[0], "Take x0 = 0.0700, x1 = 0: "));
  EXPECT_EQ(detail::answer_json(in)["row"], 7);
  EXPECT_EQ(front_points_json(in, 1)["points"][7]["chosen"], true);
  std::vector<WorkOfRun> work;
  for (const doe::Evaluation& e : in.training.rows) work.push_back({e.run, e.x, {1000}, {10 + 20 * e.x[0]}});
  EXPECT_EQ(choice_of_haul(in, "production", 0, work)->strategies[0].x, in.recommended->x);
  in.recommended.reset();
  EXPECT_TRUE(detail::answer_json(in)["x"].is_null());
  EXPECT_NE(choice_of_haul(in, "production", 0, work)->strategies[0].name, "recommended");
}

// A round of confirmation asks for the row alone, with what it has: no tables and no report.
TEST(Recommendation, NeedsModelsFrontAndMarksAlone) {
  ReportInput in = known_study(0);
  for (const int row : {-1, 30}) {
    if (row >= 0) in.marks = {{"reference", in.front.X.row(row).transpose()}};
    EXPECT_EQ(recommended_row({in.problem, in.models, in.front, in.marks, in.confirmations, in.success}),
              recommend(in)->row);
  }
  EXPECT_EQ(recommended_row({in.problem, {}, in.front, in.marks, in.confirmations, in.success}), -1);
}

// A turn that surely lies beyond the haul that the runs count is told; one before it is past.
TEST(Recommendation, SaysFromWhichHaulOnAnotherGivesMore) {
  ReportInput in = with_recommendation(known_study(0));
  const auto said = [&](double haul, double upper) {
    HaulChoice choice{.haul = 40, .longest = 600};
    choice.strategies = {{.name = "recommended", .x = in.recommended->x},
                         {.name = "full", .x = in.recommended->x}};
    choice.turns = {{.haul = haul, .better = 1, .worse = 0, .lower = 80, .upper = upper}};
    in.hauls = choice;
    EXPECT_EQ(answer_sentences(in).size(), 3u);
    return answer_sentences(in)[1];
  };
  EXPECT_TRUE(has(said(100, 150),
                  "; from a haul of 100 s on (80.0 to 150), where 40.0 s are counted, \u201cfull\u201d "
                  "gives more production; in brackets with 95 %."));
  EXPECT_FALSE(has(said(100, 700), "haul")) << "perhaps beyond what is asked about";
  for (const double haul : {20.0, 40.0}) EXPECT_FALSE(has(said(haul, 150), "haul")) << haul;
}

TEST(Hauls, TurnWhereTheRatesAreEqual) {
  EXPECT_NEAR(turning_haul(1000, 10, 2000, 30, 600), 10, 1e-12);  // 1000 / (10 + h) = 2000 / (30 + h)
  EXPECT_TRUE(std::isnan(turning_haul(1000, 10, 2000, 30, 9)));
  EXPECT_TRUE(std::isnan(turning_haul(1000, 30, 2000, 10, 600))) << "the fuller is the quicker, too";
  EXPECT_TRUE(std::isnan(turning_haul(1000, 10, 1000, 20, 600)));
}

// Loads and times are known functions: load 1000 (1 + x0), seconds 10 + 20 x0, three cycles alike. Where x0 is 0 and
// where it is 1: 1000 in 10 s and 2000 in 30 s, which are equal at a haul of 10 s.
TEST(Hauls, AreWhatTheCyclesGiveAnew) {
  ReportInput in = known_study(0);
  std::vector<WorkOfRun> work;
  for (const doe::Evaluation& e : in.training.rows)
    work.push_back(
        {e.run, e.x, std::vector<double>(3, 1000 * (1 + e.x[0])), std::vector<double>(3, 10 + 20 * e.x[0])});
  in.marks = {{"quick", Eigen::Vector2d(0, 0.5)},
              {"full", Eigen::Vector2d(1, 0.5)},
              {"run 1", in.training.rows[0].x}};
  const auto choice = choice_of_haul(with_recommendation(in), "production", 0, work);
  ASSERT_TRUE(choice);
  EXPECT_NEAR(choice->deviation, 0, 1e-12) << "equal cycles have one rate";
  const auto of = [&](const std::string& name) -> const HauledStrategy& {
    for (const HauledStrategy& s : choice->strategies)
      if (s.name == name) return s;
    throw std::runtime_error("no strategy " + name);
  };
  EXPECT_NEAR(of("quick").load, 1000, 5);
  EXPECT_NEAR(of("full").seconds, 30, 0.2);
  ASSERT_EQ(of("run 1").runs.size(), 1u);
  for (const double haul : {0.0, 45.0, 600.0})
    EXPECT_NEAR(of("run 1").rate(haul) / of("run 1").runs[0].rate(haul), 1, 0.005) << haul;
  bool found = false;
  for (const HaulTurn& turn : choice->turns) {
    if (&choice->strategies[turn.better] != &of("full") || &choice->strategies[turn.worse] != &of("quick"))
      continue;
    found = true;
    EXPECT_NEAR(turn.haul, 10, 0.3);
    EXPECT_LE(turn.lower, turn.haul);
    EXPECT_GE(turn.upper, turn.haul);
  }
  EXPECT_TRUE(found);
  EXPECT_EQ(choice->strategies[0].name, "recommended");
}

// A mean of ratios is no ratio of means: of cycles of 1000 in 10 s and 3000 in 50 s it is 80 and not 66.7.
TEST(Hauls, SayWhatTheRatioOfMeansAddsToIt) {
  const WorkOfRun run{1, {}, {1000, 3000}, {10, 50}};
  EXPECT_DOUBLE_EQ(run.rate(0), 80);
  EXPECT_DOUBLE_EQ(run.mean_load() / run.mean_seconds(), 2000.0 / 30);
  ReportInput in = known_study(0);
  std::vector<WorkOfRun> work;
  for (const doe::Evaluation& e : in.training.rows) work.push_back({e.run, e.x, {1000, 3000}, {10, 50}});
  const auto choice = choice_of_haul(with_recommendation(in), "production", 0, work);
  ASSERT_TRUE(choice);
  EXPECT_NEAR(choice->deviation, 1 - 2000.0 / 30 / 80, 1e-12);
}

}  // namespace
