// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/lola_voronoi.hpp>
#include <drawpoint/doe/propose.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <set>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

Evaluations some_runs(int n = 20) {
  const Problem problem = support::unit_problem(2);
  const auto f = [](const Eigen::VectorXd& x) { return std::sin(8 * x[0]) + x[1]; };
  return evaluate(f, problem, latin_hypercube(problem, n, {.seed = 2}));
}

int cell(const Evaluations& runs, const Eigen::VectorXd& x) {
  Eigen::MatrixXd U(static_cast<Eigen::Index>(runs.rows.size()), x.size());
  for (std::size_t i = 0; i < runs.rows.size(); ++i) U.row(static_cast<Eigen::Index>(i)) = runs.rows[i].x;
  return detail::nearest_sites(x.transpose(), U).site[0];
}

/// A criterion that peaks at (0.3, 0.7).
Criterion peaked(const Evaluations&) {
  return [](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    return (-(X.rowwise() - Eigen::RowVector2d(0.3, 0.7)).rowwise().squaredNorm()).array().exp();
  };
}

TEST(NearestSites, AreThoseOfAFullSearch) {
  RandomStream random(4);
  const Eigen::MatrixXd P = Eigen::MatrixXd::NullaryExpr(1100, 3, [&] { return random.uniform(); });
  const Eigen::MatrixXd S = Eigen::MatrixXd::NullaryExpr(37, 3, [&] { return random.uniform(); });
  const detail::Nearest nearest = detail::nearest_sites(P, S);
  for (Eigen::Index i = 0; i < P.rows(); ++i) {
    Eigen::Index best;
    const double d2 = (S.rowwise() - P.row(i)).rowwise().squaredNorm().minCoeff(&best);
    ASSERT_EQ(nearest.site[static_cast<std::size_t>(i)], best);
    ASSERT_NEAR(nearest.squared_distance[i], d2, 1e-15);
  }
}

TEST(Propose, TakesTheBestCandidate) {
  const Evaluations runs = some_runs();
  const Eigen::MatrixXd X = propose(runs, peaked, {.candidates = 5000});
  ASSERT_EQ(X.rows(), 1);
  // The nearest of 5000 uniform points is farther than r with probability (1 − πr²)^5000: 1e-6 for r = 0.03.
  EXPECT_LT((X.row(0) - Eigen::RowVector2d(0.3, 0.7)).norm(), 0.03);
}

TEST(Propose, KeepsAwayFromPendingPoints) {
  const Evaluations runs = some_runs();
  const Eigen::MatrixXd first = propose(runs, peaked, {.candidates = 5000});
  for (const BatchRule rule : {BatchRule::cells, BatchRule::penalty}) {
    ProposeOptions options{.candidates = 5000, .rule = rule};
    options.pending = first;
    const Eigen::MatrixXd next = propose(runs, peaked, options);
    ASSERT_EQ(next.rows(), 1);
    EXPECT_GT((next.row(0) - first.row(0)).norm(), 0.01);
    EXPECT_EQ(next, propose(runs, peaked, {.batch = 2, .candidates = 5000, .rule = rule}).bottomRows(1))
        << "as the second of a batch";
    options.pending = Eigen::RowVector2d(0.5, 1.5);
    EXPECT_EQ(
        support::thrown_text<std::invalid_argument>([&] { propose(runs, peaked, options); }).substr(0, 27),
        "doe::propose: pending: row ");
  }
}

TEST(Propose, ChoosesAmongPointsBesideToo) {
  ProposeOptions options{.candidates = 10, .climb = false};
  options.beside = Eigen::RowVector2d(0.3, 0.7);
  EXPECT_EQ(propose(some_runs(), peaked, options).row(0), options.beside.row(0));
  options.allowed = [](const Eigen::VectorXd& x) { return x[0] > 0.5; };
  EXPECT_GT(propose(some_runs(), peaked, options)(0, 0), 0.5);
}

TEST(Propose, EqualRunsOptionsAndSeedGiveEqualBits) {
  const Evaluations runs = some_runs();
  const ProposeOptions options{.batch = 8};
  EXPECT_EQ(propose(runs, LolaVoronoi(), options), propose(runs, LolaVoronoi(), options));
  EXPECT_NE(propose(runs, LolaVoronoi(), options), propose(runs, LolaVoronoi(), {.seed = 2, .batch = 8}));
}

TEST(Propose, ACellGivesOnePointUntilAllHaveGivenOne) {
  const Evaluations runs = some_runs(20);
  LolaVoronoi lola;
  const Eigen::MatrixXd X = propose(runs, lola, {.batch = 25});
  ASSERT_EQ(X.rows(), 25);
  std::set<int> first;
  for (int k = 0; k < 20; ++k) first.insert(cell(runs, X.row(k).transpose()));
  EXPECT_EQ(first.size(), 20U);
  // The cells come in the order of their score, and again from the best.
  const Eigen::VectorXd score = lola(runs)(X);
  for (int k = 1; k < 20; ++k) EXPECT_LE(score[k], score[k - 1]);
  EXPECT_EQ(score[20], score[0]);
}

// Inside a cell the farthest candidate wins: no other candidate of the same draw, there or with more points
// asked for, can be farther from the runs. Of candidates alone: only the distance would climb.
TEST(Propose, PlacesThePointFarthestFromAllRuns) {
  const Evaluations runs = some_runs();
  const auto flat = [](const Evaluations&) -> Criterion {
    return [](const Eigen::MatrixXd& X) -> Eigen::VectorXd { return Eigen::VectorXd::Ones(X.rows()); };
  };
  const Eigen::MatrixXd by_tie = propose(runs, flat),
                        by_score = propose(runs, distance_to_runs, {.climb = false});
  EXPECT_EQ(by_tie, by_score);
}

// Each choice has the highest (score − lowest) Π min(1, |x − c|²/r_c²) of all candidates, worked out anew;
// none climbs.
TEST(Propose, PenaltyIsItsFormula) {
  const Evaluations runs = some_runs(3);
  const ProposeOptions options{.batch = 6, .candidates = 2000, .rule = BatchRule::penalty, .climb = false};
  const Eigen::MatrixXd X = propose(runs, peaked, options);
  ASSERT_EQ(X.rows(), 6);
  std::uint64_t counter = 0;
  const Eigen::MatrixXd drawn =
      detail::allowed_points(runs.problem, {}, run_seed(options.seed, 3, 1), 2000, counter);
  Eigen::VectorXd score = peaked(runs)(drawn), gap = distance_to_runs(runs)(drawn);
  score.array() -= score.minCoeff();
  std::set<int> cells;
  for (int k = 0; k < 6; ++k) {
    Eigen::Index best;
    score.maxCoeff(&best);
    EXPECT_EQ(X.row(k), drawn.row(best));
    cells.insert(cell(runs, X.row(k).transpose()));
    const Eigen::VectorXd away = (drawn.rowwise() - X.row(k)).rowwise().norm();
    score.array() *= (away.array() / gap[best]).square().min(1.0);
    gap = gap.cwiseMin(away);
  }
  EXPECT_LT(cells.size(), 6U);  // no cell is closed: there are three
}

TEST(Propose, TheBelieverIsAskedAfterEachChoice) {
  const Evaluations runs = some_runs();
  std::vector<std::size_t> rows;
  const auto counting = [&rows](const Evaluations& so_far) -> Criterion {
    rows.push_back(so_far.rows.size());
    return distance_to_runs(so_far);
  };
  std::vector<double> believed;
  ProposeOptions options{.batch = 3, .rule = BatchRule::believer};
  options.believe = [&believed](const Eigen::VectorXd& x) -> Outcome {
    believed.push_back(x[0]);
    return x.sum();
  };
  const Eigen::MatrixXd X = propose(runs, counting, options);
  EXPECT_EQ(rows, (std::vector<std::size_t>{20, 21, 22}));
  EXPECT_EQ(believed, std::vector<double>(X.col(0).begin(), X.col(0).end()));
}

// The joint criterion scores the distance to the points chosen alone, which it is told one by one: the second
// point of the unit square is in the corner farthest from the first, and so on.
TEST(Propose, AJointSamplerIsToldThePointsChosenSoFar) {
  const Evaluations runs = some_runs();
  int fits = 0;
  std::vector<Eigen::Index> told;
  const auto apart = [&](const Evaluations&) -> JointCriterion {
    ++fits;
    return [&](const Eigen::MatrixXd& chosen) -> Criterion {
      told.push_back(chosen.rows());
      return [chosen](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
        if (chosen.rows() == 0) return -X.rowwise().squaredNorm();
        return detail::nearest_sites(X, chosen).squared_distance;
      };
    };
  };
  const Eigen::MatrixXd X = propose(runs, apart, {.batch = 4, .rule = BatchRule::joint});
  EXPECT_EQ(fits, 1);
  EXPECT_EQ(told, (std::vector<Eigen::Index>{0, 1, 2, 3}));
  const Eigen::MatrixXd corners = (Eigen::MatrixXd(4, 2) << 0, 0, 1, 1, 0, 1, 1, 0).finished();
  // A climb ends where differences over 1e-6 of the box show no rise, at a bound it stands on it.
  EXPECT_LT((X.topRows(2) - corners.topRows(2)).cwiseAbs().maxCoeff(), 1e-6);
  for (int corner = 2; corner < 4; ++corner)
    EXPECT_LT((X.bottomRows(2).rowwise() - corners.row(corner)).rowwise().norm().minCoeff(), 1e-6);
}

TEST(Propose, TheRuleJointAndAJointSamplerBelongTogether) {
  const Evaluations runs = some_runs();
  const auto joint = [](const Evaluations& so_far) -> JointCriterion {
    return [so_far](const Eigen::MatrixXd&) { return peaked(so_far); };
  };
  const auto text = [](const auto& call) { return support::thrown_text<std::invalid_argument>(call); };
  const std::string no_rule =
      "doe::propose: the sampler is a joint one, but the rule is not joint; allowed is BatchRule::joint; set "
      "it, or give a doe::Sampler";
  EXPECT_EQ(text([&] { propose(runs, joint); }), no_rule);
  EXPECT_EQ(text([&] { propose(runs, peaked, {.rule = BatchRule::joint}); }),
            "doe::propose: the rule is joint, but the sampler does not ask for the points chosen so far; "
            "allowed is a doe::JointSampler; give one, or another rule");
  int calls = 0;
  const auto f = [&calls](const Eigen::VectorXd& x) { return ++calls + x[0]; };
  EXPECT_EQ(text([&] { refine(f, runs.problem, runs.X(), joint); }), no_rule);
  EXPECT_EQ(calls, 0) << "known before the first run";
}

TEST(Propose, NeverRepeatsARunAndLeavesOutNaN) {
  Evaluations runs = some_runs(4);
  const auto mostly_nan = [](const Evaluations&) -> Criterion {
    return [](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
      return (X.col(0).array() < 0.9).select(std::nan(""), X.col(0).array());
    };
  };
  const Eigen::MatrixXd X = propose(runs, mostly_nan, {.batch = 5, .candidates = 100});
  EXPECT_GE(X.col(0).minCoeff(), 0.9);
  // The draw depends on seed and number of rows: with four runs moved onto its first points it has 3 left.
  runs = some_runs(4);
  std::uint64_t counter = 0;
  const Eigen::MatrixXd drawn =
      detail::allowed_points(runs.problem, {}, run_seed(1, runs.rows.size(), 1), 7, counter);
  for (std::size_t i = 0; i < 4; ++i) runs.rows[i].x = drawn.row(static_cast<Eigen::Index>(i));
  const Eigen::MatrixXd rest = propose(runs, distance_to_runs, {.batch = 7, .candidates = 7});
  EXPECT_EQ(rest.rows(), 3);
}

TEST(Propose, StaysWhereRunsAreAllowed) {
  const Evaluations runs = some_runs();
  const auto disc = [](const Eigen::VectorXd& x) { return (x.array() - 0.5).matrix().norm() < 0.2; };
  const Eigen::MatrixXd X = propose(runs, LolaVoronoi({.allowed = disc}), {.batch = 10, .allowed = disc});
  ASSERT_EQ(X.rows(), 10);
  for (const auto& x : X.rowwise()) EXPECT_TRUE(disc(x.transpose()));
  const auto never = [](const Eigen::VectorXd&) { return false; };
  EXPECT_EQ(propose(runs, peaked, {.candidates = 5, .allowed = never}).rows(), 0);
}

TEST(Mix, GivesEachItsShareToWithinOne) {
  const Mix mix({{0.7, peaked}, {0.3, distance_to_runs}});
  for (const int first : {0, 3, 17})
    for (int count = 1; count <= 40; ++count) {
      const std::vector<int> turns = mix.turns(first, count);
      EXPECT_EQ(turns[0] + turns[1], count);
      EXPECT_LE(std::abs(turns[0] - 0.7 * count), 1.0 + 1e-9);
    }
  EXPECT_EQ(mix.turns(0, 10), (std::vector<int>{7, 3}));
  // One at a time gives what one call gives.
  std::vector<int> sum(2, 0);
  for (int t = 0; t < 23; ++t)
    for (std::size_t k = 0; k < 2; ++k) sum[k] += mix.turns(t, 1)[k];
  EXPECT_EQ(sum, mix.turns(0, 23));
}

TEST(Mix, EachSamplerChoosesItsPoints) {
  const Evaluations runs = some_runs();
  int asked = 0;
  const auto counting = [&asked](const Evaluations& so_far) -> Criterion {
    ++asked;
    return peaked(so_far);
  };
  const Mix mix({{0.7, LolaVoronoi()}, {0.3, counting}});
  EXPECT_EQ(propose(runs, mix, {.batch = 10}).rows(), 10);
  EXPECT_EQ(asked, 1);
}

TEST(WeightedSum, AddsScoresOfRangeOne) {
  const Evaluations runs = some_runs();
  const auto far = [](const Evaluations& so_far) -> Criterion {
    return [near = distance_to_runs(so_far)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
      return 1000.0 * near(X);
    };
  };
  const Eigen::MatrixXd X = latin_hypercube(runs.problem, 50);
  const Eigen::VectorXd one = distance_to_runs(runs)(X), scaled = weighted_sum({{2.0, far}})(runs)(X);
  EXPECT_NEAR(scaled.minCoeff(), 0.0, 1e-15);
  EXPECT_NEAR(scaled.maxCoeff(), 2.0, 1e-15);
  EXPECT_TRUE(scaled.isApprox(
      Eigen::VectorXd(2 * (one.array() - one.minCoeff()) / (one.maxCoeff() - one.minCoeff())), 1e-12));
}

TEST(Disagreement, IsTheLargestDifferenceOfTheModels) {
  const auto model = [](double slope) -> Criterion {
    return [slope](const Eigen::MatrixXd& X) -> Eigen::VectorXd { return slope * X.col(0); };
  };
  const Criterion c = disagreement({model(1), model(4), model(2)});
  const Eigen::MatrixXd X = Eigen::Vector3d(0.5, -1, 0);
  EXPECT_EQ(c(X), Eigen::Vector3d(1.5, 3, 0));
}

TEST(Propose, BadInputIsNamed) {
  const Evaluations runs = some_runs();
  const auto text = [&](const ProposeOptions& options) {
    return support::thrown_text<std::invalid_argument>([&] { propose(runs, peaked, options); });
  };
  EXPECT_EQ(text({.batch = 0}), "doe::propose: batch is 0; allowed is 1 or more; ask for at least one point");
  EXPECT_EQ(text({.candidates = 0}),
            "doe::propose: candidates is 0; allowed is 1 or more; leave it out for 100 per run");
  EXPECT_EQ(text({.rule = BatchRule::believer}),
            "doe::propose: rule is believer, but believe is empty; give what a run at x would give");
  const auto short_of = [](const Evaluations&) -> Criterion {
    return [](const Eigen::MatrixXd&) -> Eigen::VectorXd { return Eigen::VectorXd::Ones(3); };
  };
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([&] { propose(runs, short_of, {.candidates = 9}); }),
            "doe::propose: the criterion gave 3 scores for 9 points; give one score a row of X");
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([] { Mix(std::vector<Share>{}); }),
            "doe::Mix: 0 parts; allowed is 1 or more; name at least one sampler");
  EXPECT_EQ(
      support::thrown_text<std::invalid_argument>([] {
        weighted_sum({{-1.0, peaked}});
      }),
      "doe::weighted_sum: part 0 has weight -1; allowed is a finite number above 0; leave out what gets "
      "no share");
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([] {
              Mix({Share{1.0, {}}});
            }),
            "doe::Mix: part 0 has no sampler; give a doe::Sampler or leave the part out");
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([] { disagreement({}); }),
            "doe::disagreement: 0 models; allowed is 2 or more; add a model of another kind");
}

}  // namespace
