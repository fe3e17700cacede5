// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Adaptive batches: what is stored decides, each criterion chooses as its name says.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/model/fits/failures.h>
#include <drawpoint/studies/model/sampling/adaptive.h>
#include <drawpoint/studies/model/sampling/criteria.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/settings.h>

#include <algorithm>
#include <cmath>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

/// Flat but for a steep step near alpha = 1.5.
Eigen::VectorXd step(const Eigen::VectorXd& x) {
  return Eigen::Vector2d(std::tanh(20.0 * (x[0] - 1.5)), 0.1 + 0.01 * x[1]);
}

/// A study of `n` training runs that are done, but for the third, which failed.
std::vector<studies::Run> done_runs(const Identity& identity, int n) {
  auto runs = runs_to_add(identity, {}, n, 0);
  for (auto& run : runs) {
    run.status = Status::done;
    run.y = step(run.x);
  }
  runs[2].status = Status::failed;
  runs[2].reason = "stuck";
  return runs;
}

class Adaptive : public testing::Test {
 protected:
  std::vector<studies::Run> batch(const Sampling& sampling) const {
    return next_batch(identity_, sampling, runs_).runs;
  }

  const Identity identity_ = test::identity();
  const std::vector<studies::Run> runs_ = done_runs(identity_, 25);
};

TEST_F(Adaptive, ABatchIsDecidedByWhatIsStored) {
  const auto first = batch({.points = 20, .batch = 6}), again = batch({.points = 20, .batch = 6});
  ASSERT_EQ(first.size(), 6u);
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(first[k].x, again[k].x);
    EXPECT_EQ(first[k].predicted, again[k].predicted);
    EXPECT_EQ(first[k].id, 26 + static_cast<std::int64_t>(k));
    EXPECT_EQ(first[k].point, 1 + static_cast<std::int64_t>(k));
    EXPECT_EQ(first[k].kind, Kind::adaptive);
    EXPECT_TRUE(first[k].predicted.allFinite() && (first[k].lower.array() <= first[k].upper.array()).all());
    for (const auto& run : runs_) EXPECT_NE(run.seed, first[k].seed);
  }
}

TEST_F(Adaptive, TheLastBatchIsWhatIsLeft) {
  EXPECT_EQ(batch({.points = 2, .batch = 6}).size(), 2u);
  EXPECT_TRUE(batch({.points = 0}).empty());
}

/// Of 8 adaptive points after each of six first designs: how many lie within `width` of the step.
int near_the_step(const Identity& base, const char* criteria, double width) {
  int near = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Identity identity = base;
    identity.seed = seed;
    const auto batch =
        next_batch(identity, {.points = 8, .batch = 8, .criteria = criteria}, done_runs(identity, 25));
    for (const auto& run : batch.runs) near += std::abs(run.x[0] - 1.5) < width;
  }
  return near;
}

// 25 runs stand 1.8/5 = 0.36 apart in alpha. LOLA sees the step from each cell with a neighbour beyond it, so
// its points lie within a cell's half and a neighbour's distance, 0.54, where 0.58 of the range is: 48 of 48
// by chance has the probability 1e-11, and 38, for a mix of which it chooses 0.7, 1.6e-3.
TEST_F(Adaptive, LolaVoronoiGoesToTheStep) {
  EXPECT_EQ(near_the_step(identity_, "lola_voronoi", 0.54), 48);
  EXPECT_GE(near_the_step(identity_, "lola_voronoi=0.7,error=0.3", 0.54), 38);
}

// Models disagree on where the step is: within half a distance of two runs, 0.2, lie 2/9 of the range. Points
// that ignore it are there 11 times in 48, with a deviation of 2.9: 20 are three of these more.
TEST_F(Adaptive, ErrorGoesToTheStep) { EXPECT_GE(near_the_step(identity_, "error", 0.2), 20); }

/// The least distance from a run of a batch to the runs before it, in the unit box.
double least_gap(const std::vector<studies::Run>& batch, const std::vector<studies::Run>& runs) {
  double least = 10.0;
  for (const auto& a : batch)
    for (const auto& b : runs)
      least = std::min(least, (a.x - b.x).cwiseQuotient(Eigen::Vector2d(1.8, 4.0)).norm());
  return least;
}

// 25 points of a good design of the square are some 1/5 apart, so the middle of its holes is 1/(5 √2) = 0.14
// from the nearest; who looks for holes alone comes near to that, and further than half of it for certain.
TEST_F(Adaptive, VoronoiAndDistanceFillHoles) {
  for (const char* criteria : {"voronoi", "distance"})
    EXPECT_GT(least_gap(batch({.points = 3, .criteria = criteria}), runs_), 0.07) << criteria;
}

// production is maximised and highest beyond the step: nothing below it improves the front.
TEST_F(Adaptive, ImprovementIsSoughtBeyondTheStep) {
  const auto points = batch({.points = 3, .criteria = "improvement"});
  ASSERT_EQ(points.size(), 3u);
  EXPECT_GT(points[0].x[0], 1.4);
}

TEST_F(Adaptive, VarianceChooses) { EXPECT_EQ(batch({.points = 3, .criteria = "variance"}).size(), 3u); }

// Candidates are chosen by cells: the first is in that of the run with the largest leave-one-out error.
TEST_F(Adaptive, CrossValidationGoesBesideTheWorstPredictedRun) {
  const Tables tables = tables_of(runs_, identity_.problem);
  const Models fitted = fit_models(tables);
  Eigen::VectorXd error = Eigen::VectorXd::Zero(tables.training.X().rows());
  for (const auto& model : fitted.models) {
    const kriging::Validation left_out = leave_one_out(model);
    error = error.cwiseMax((left_out.predicted - left_out.observed).cwiseAbs() /
                           (left_out.observed.maxCoeff() - left_out.observed.minCoeff()));
  }
  Eigen::Index worst = 0;
  error.maxCoeff(&worst);
  const auto points = batch({.points = 1, .criteria = "cross_validation"});
  ASSERT_EQ(points.size(), 1u);
  const auto distance = [&](const Eigen::VectorXd& x) {
    return (x - points[0].x).cwiseQuotient(Eigen::Vector2d(1.8, 4.0)).norm();
  };
  const Eigen::VectorXd nearest = tables.training.X().row(worst);
  for (Eigen::Index i = 0; i < tables.training.X().rows(); ++i)
    EXPECT_GE(distance(tables.training.X().row(i)) + 1e-12, distance(nearest)) << i;
}

/// One response, minimised at `best`: (x − best)² in the unit box.
class OneObjective : public testing::Test {
 protected:
  OneObjective() {
    identity_.problem.responses = {{"wear", "mm", doe::Goal::minimize}};
    runs_ = runs_to_add(identity_, {}, 20, 0);
    for (auto& run : runs_) {
      run.status = Status::done;
      run.y = Eigen::VectorXd::Constant(1, off(run.x).squaredNorm());
    }
  }

  Eigen::Vector2d off(const Eigen::VectorXd& x) const {
    const auto& v = identity_.problem.variables;
    return {(x[0] - v[0].lower) / (v[0].upper - v[0].lower) - 0.3,
            (x[1] - v[1].lower) / (v[1].upper - v[1].lower) - 0.6};
  }

  std::vector<studies::Run> batch(int points, const char* criteria) const {
    return next_batch(identity_, {.points = points, .batch = points, .criteria = criteria}, runs_).runs;
  }

  Identity identity_ = test::identity();
  std::vector<studies::Run> runs_;
};

// A smooth bowl is known to better than 1e-3 of its range from 20 runs, so its predicted minimum lies within the
// square root of that, 0.03; where improvement is sought is within 0.2 (by chance: an eighth).
TEST_F(OneObjective, IsSoughtWhereTheModelExpectsTheBest) {
  for (const auto& [criterion, reach] : {std::pair{"predicted", 0.03}, {"joint_improvement", 0.2}}) {
    const auto points = batch(1, criterion);
    ASSERT_EQ(points.size(), 1u) << criterion;
    EXPECT_LT(off(points[0].x).norm(), reach) << criterion;
  }
}

// Noise of a tenth of the bowl's range hides its minimum; which of the places within 0.35 of it is best a run there
// says best. Three in eight are there by chance, all four of four in 0.02.
TEST_F(OneObjective, KnowledgeOfTheBestIsSoughtAmongTheGood) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    doe::RandomStream random(seed);
    for (auto& run : runs_)
      run.y = Eigen::VectorXd::Constant(1, off(run.x).squaredNorm() + 0.08 * random.normal());
    const auto points = batch(1, "knowledge_gradient");
    ASSERT_EQ(points.size(), 1u);
    EXPECT_LT(off(points[0].x).norm(), 0.35) << seed;
  }
}

// Half of the batch fills holes, wherever the best is; the other half is sought together beside those.
TEST_F(OneObjective, PointsTogetherTakeTheirShareOfABatch) {
  const auto points = batch(8, "distance,joint_improvement");
  ASSERT_EQ(points.size(), 8u);
  const auto holes = batch(4, "distance");
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(points[k].x, holes[k].x) << k;
  EXPECT_LT(off(points[4].x).norm(), 0.2);
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t l = 0; l < k; ++l) EXPECT_NE(points[k].x, points[l].x);
}

// Nothing is gained anywhere: the point farthest from all runs, which another criterion took, is not taken twice.
TEST_F(OneObjective, PointsTogetherAreNotThoseOfOthers) {
  for (auto& run : runs_) run.y = Eigen::VectorXd::Constant(1, 7.0);
  const auto points = batch(4, "distance,joint_improvement");
  ASSERT_EQ(points.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < k; ++l) EXPECT_GT((points[k].x - points[l].x).norm(), 0.0) << k << " " << l;
}

// The limit is kept in a quarter of the box, where the second variable is small; none of four points is there by
// chance in 0.3 of all cases, all four in 0.004.
TEST_F(OneObjective, FeasibilityKeepsTheLimits) {
  identity_.problem.responses.push_back({"force", "kN", doe::Goal::at_most, 0.25});
  for (auto& run : runs_) run.y = Eigen::Vector2d(run.y[0], off(run.x)[1] + 0.6);
  const auto points = batch(4, "feasibility");
  ASSERT_EQ(points.size(), 4u);
  for (const auto& run : points) EXPECT_LT(off(run.x)[1] + 0.6, 0.25);
  EXPECT_LT(off(batch(1, "predicted")[0].x)[1] + 0.6, 0.26);
}

// Smooth and without noise: a run again teaches nothing, and the turns go to new points.
TEST_F(Adaptive, RunsWithoutNoiseAreNotRepeated) {
  auto runs = runs_;
  for (auto& run : runs) run.y = Eigen::Vector2d(std::sin(2 * run.x[0]) + run.x[1], run.x[0] * run.x[1]);
  const Batch batch = next_batch(identity_, {.points = 8, .criteria = "variance,repeat"}, runs);
  EXPECT_EQ(batch.repeats, 0);
  EXPECT_EQ(batch.runs.size(), 8u);
  EXPECT_GT(least_gap(batch.runs, runs), 0.0);
  const Batch none = next_batch(identity_, {.points = 8, .criteria = "repeat"}, runs);
  EXPECT_EQ(none.status, BatchStatus::exhausted);
  EXPECT_NE(none.message.find("another criterion"), std::string::npos) << none.message;
}

// Noise of some half of a plane's range: what 25 runs do not say of a plane a run again says nearly as well as
// a new one, so repeats get their half of the batch.
TEST_F(Adaptive, NoisyRunsAreRepeatedForTheirShare) {
  auto runs = runs_;
  doe::RandomStream random(7);
  for (auto& run : runs)
    for (Eigen::Index j = 0; j < 2; ++j) run.y[j] = run.x.sum() + 2.5 * random.normal();
  const Batch batch = next_batch(identity_, {.points = 8, .criteria = "variance,repeat"}, runs);
  ASSERT_EQ(batch.runs.size(), 8u);
  ASSERT_EQ(batch.repeats, 4);
  for (std::size_t k = 0; k < 8; ++k) {
    const auto made =
        std::find_if(runs.begin(), runs.end(), [&](const auto& run) { return run.x == batch.runs[k].x; });
    EXPECT_EQ(made != runs.end(), k >= 4) << k;
    if (made == runs.end()) continue;
    EXPECT_EQ(made->status, Status::done) << "a run that failed is not repeated";
    EXPECT_NE(made->seed, batch.runs[k].seed);
  }
}

// Where lip > 1 every run fails: models are least certain there, and no run teaches them more.
TEST_F(Adaptive, NoRunIsSpentBesideFailures) {
  auto runs = runs_;
  for (auto& run : runs) {
    run.status = run.x[1] > 1.0 ? Status::failed : Status::done;
    run.reason = "stuck";
  }
  const Tables tables = tables_of(runs, identity_.problem);
  const auto chosen = next_batch(identity_, {.points = 8, .criteria = "variance,error"}, runs).runs;
  ASSERT_EQ(chosen.size(), 8u);
  for (const auto& run : chosen) EXPECT_FALSE(Failures(tables).avoided(run.x.transpose()).front());
}

// Two whole numbers of two values are four places.
TEST(AdaptiveEnd, WholeVariablesRunOutOfPlaces) {
  Identity identity = test::identity();
  identity.problem.variables = {doe::integer_variable("teeth", "1", 1, 2),
                                doe::integer_variable("bolts", "1", 1, 2)};
  std::vector<studies::Run> runs;
  for (const double teeth : {1.0, 2.0}) {
    for (const double bolts : {1.0, 2.0}) {
      studies::Run run =
          runs_at(identity, runs, Kind::training, {.X = Eigen::RowVector2d(teeth, bolts)}).front();
      run.status = Status::done;
      run.y = Eigen::Vector2d(teeth + 0.1 * bolts * teeth, bolts * bolts);
      runs.push_back(run);
    }
  }
  const Batch end = next_batch(identity, {.points = 8}, runs);
  EXPECT_EQ(end.status, BatchStatus::exhausted);
  EXPECT_TRUE(end.runs.empty());
  EXPECT_NE(end.message.find("no place is left"), std::string::npos);
}

// Nine places, each with a noisy run: what is left are repeats, also in a turn of a new point.
TEST(AdaptiveEnd, RepeatsGoOnWhereNoPlaceIsNew) {
  Identity identity = test::identity();
  identity.problem.variables = {doe::integer_variable("teeth", "1", 1, 3),
                                doe::integer_variable("bolts", "1", 1, 3)};
  std::vector<studies::Run> runs;
  doe::RandomStream random(4);
  for (int k = 0; k < 9; ++k) {
    const Eigen::RowVector2d x(1 + k % 3, 1 + k / 3);
    studies::Run run = runs_at(identity, runs, Kind::training, {.X = x}).front();
    run.status = Status::done;
    run.y = Eigen::Vector2d(x.sum() + random.normal(), x[0] + random.normal());
    runs.push_back(run);
  }
  for (const int batch : {1, 8}) {
    const Batch more =
        next_batch(identity, {.points = 8, .batch = batch, .criteria = "error=0.7,repeat=0.3"}, runs);
    EXPECT_EQ(more.status, BatchStatus::planned);
    EXPECT_EQ(more.repeats, batch);
  }
  EXPECT_EQ(next_batch(identity, {.points = 8, .criteria = "error"}, runs).status, BatchStatus::exhausted);
}

TEST(Criteria, ImprovementNeedsAnObjective) {
  doe::Problem problem = test::two_by_two();
  check_criteria("improvement", problem);
  problem.responses[0].goal = doe::Goal::record;
  check_criteria("lola_voronoi,error", problem);
  EXPECT_THROW(check_criteria("error,improvement", problem), UsageError);
}

TEST(Criteria, SomeNeedALimitOrOneObjective) {
  doe::Problem problem = test::two_by_two();
  problem.responses[0].goal = doe::Goal::maximize;
  problem.responses[1].goal = doe::Goal::minimize;
  for (const char* criterion : {"feasibility", "joint_improvement", "knowledge_gradient", "predicted"})
    EXPECT_THROW(check_criteria(criterion, problem), UsageError) << criterion;
  EXPECT_NE(test::complaint([&] { check_criteria("predicted", problem); }).find("there are 2"),
            std::string::npos);
  problem.responses[1].goal = doe::Goal::at_most;
  problem.responses[1].limit = 1.0;
  check_criteria("feasibility,predicted", problem);
  for (const char* criterion : {"joint_improvement", "knowledge_gradient"})
    EXPECT_NE(test::complaint([&] { check_criteria(criterion, problem); }).find("knows no limits"),
              std::string::npos);
  problem.responses[1].goal = doe::Goal::record;
  check_criteria("joint_improvement,knowledge_gradient,predicted", problem);
}

// Of nine points, repeats with a third of the weight get three, whatever the batches.
TEST(Criteria, TakeTurns) {
  const auto shares = criteria_from("lola_voronoi=0.7,error=0.3,repeat=0.5");
  int repeats = 0;
  for (int made = 0; made < 9; made += 3) repeats += turns_of(shares, made, 3).repeats;
  EXPECT_EQ(repeats, 3);
  EXPECT_EQ(turns_of(shares, 0, 9).repeats, 3);
  EXPECT_EQ(turns_of(shares, 0, 9).new_ones.size(), 2u);
  EXPECT_EQ(turns_of(criteria_from("error"), 5, 9).repeats, 0);
  const CriteriaTurns three = turns_of(criteria_from("error,joint_improvement,repeat"), 3, 6);
  EXPECT_EQ(three.repeats, 2);
  EXPECT_EQ(three.together, 2);
  EXPECT_EQ(turns_of(criteria_from("repeat"), 5, 9).repeats, 9);
}

TEST(Criteria, AreNamesWithWeights) {
  const auto shares = criteria_from("lola_voronoi=0.7,error");
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_EQ(shares[0].name, "lola_voronoi");
  EXPECT_EQ(shares[0].weight, 0.7);
  EXPECT_EQ(shares[1].weight, 1.0);
  for (const char* wrong : {"", "lola", "error=", "error=x", "error=0", "error=-1", "error=inf", "error=1,",
                            ",error", "error=1e", "error=nan"}) {
    EXPECT_THROW(criteria_from(wrong), UsageError) << wrong;
    EXPECT_NE(test::complaint([&] { criteria_from(wrong); }).find("lola_voronoi, voronoi, distance"),
              std::string::npos);
  }
}

// A model of standard errors need not be good: what runs tell is noise itself.
TEST(Target, IsMetByEveryResponseOrNot) {
  const doe::Problem problem{{{"x", "m", 0, 1}},
                             {{"a", "t", doe::Goal::maximize},
                              {.name = "b", .unit = "t", .goal = doe::Goal::minimize, .standard_error = "c"},
                              {.name = "c", .unit = "t", .lower = 0}}};
  // Single runs miss by far more: their noise is no fault of the model.
  std::vector<kriging::MeanError> errors = {
      {.rmse = 1, .noise = 9, .range = 10}, {.rmse = 0.4, .noise = 9, .range = 2}, {.rmse = 9, .range = 10}};
  EXPECT_TRUE(target_met({.target = 0.2}, problem, errors));
  EXPECT_FALSE(target_met({.target = 0.19}, problem, errors));
  EXPECT_FALSE(target_met({}, problem, errors));
  EXPECT_FALSE(target_met({.target = 0.2}, problem, {}));
  errors[1].rmse = std::nan("");
  EXPECT_FALSE(target_met({.target = 0.2}, problem, errors));
}

}  // namespace
