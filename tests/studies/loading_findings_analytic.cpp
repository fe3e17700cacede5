// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The findings on made-up runs in which they hold, fail, and cannot be decided. Responses are formulas of
/// the variables, without noise, on a uniform sample of fixed seed: effects are many standard errors away
/// from 0.

#include <drawpoint/studies/loading_findings.h>
#include <gtest/gtest.h>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/tests/studies/support.hpp>
#include <drawpoint/tests/support/told.hpp>

#include <cmath>
#include <functional>
#include <map>
#include <random>

using namespace drawpoint;
using namespace drawpoint::studies;
using Eigen::Vector3d;
using Eigen::Vector4d;

namespace {

const doe::Problem problem{.variables = {{"alpha", "1", 0.2, 2.0},
                                         {"beta", "1", 0.0, 1.0},
                                         {"gamma", "1", 0.0, 1.0},
                                         {"kappa", "1", 0.0, 1.0}},
                           .responses = {{"production", "kg/s", doe::Goal::maximize},
                                         {"joint_damage", "s", doe::Goal::minimize},
                                         {"rock_spill", "1", doe::Goal::minimize}}};

Eigen::MatrixXd uniform_points(int n, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> u(0, 1);
  Eigen::MatrixXd X(n, 4);
  for (int i = 0; i < n; ++i)
    for (int v = 0; v < 4; ++v) X(i, v) = v == 0 ? 0.2 + 1.8 * u(bits) : u(bits);
  return X;
}

Eigen::MatrixXd with_corners(Eigen::MatrixXd X) {
  for (int c = 0; c < 16; ++c)
    X.row(c) << (c & 1 ? 2.0 : 0.2), (c & 2 ? 1.0 : 0.0), (c & 4 ? 1.0 : 0.0), (c & 8 ? 1.0 : 0.0);
  return X;
}

using Formula = std::function<Vector3d(const Vector4d&)>;

StudyResults results_of(int n, const Formula& f) {
  StudyResults results{.problem = problem,
                       .X = with_corners(uniform_points(n, 1)),
                       .Y = Eigen::MatrixXd(n, 3),
                       .X_new = uniform_points(100, 2),
                       .Y_new = Eigen::MatrixXd::Zero(100, 3),
                       .logs = {},
                       .nrmse = {0.06, 0.16, 0.17}};
  for (int i = 0; i < n; ++i) results.Y.row(i) = f(results.X.row(i).transpose()).transpose();
  return results;
}

std::map<std::string, Finding> found(const StudyResults& results) {
  std::map<std::string, Finding> named;
  for (const Finding& finding : loading_findings(results)) named[finding.id] = finding;
  return named;
}

double hill(double x, double top, double width) { return std::exp(-std::pow((x - top) / width, 2)); }

/// As the source has it, but for the smoothness of the fronts: production leads by alpha with a top at 1.1,
/// damage and spill as its findings say.
Vector3d as_the_source(const Vector4d& x) {
  return {-50 + 600 * hill(x[0], 1.1, 0.6) + 120 * x[1] - 60 * x[3] + 5 * x[2],
          20 * hill(x[0], 1.0, 0.5) + 25 * x[1] + 8 * hill(x[3], 0.4, 0.3),
          0.1 + 0.1 * x[0] + 0.06 * x[1] - 0.04 * x[3]};
}

/// The opposite: production falls with alpha and leads by gamma, damage and spill fall where they should
/// rise.
Vector3d otherwise(const Vector4d& x) {
  return {500 - 100 * hill(x[0], 1.1, 0.6) - 120 * x[1] + 60 * x[3] + 400 * x[2],
          20 - 10 * hill(x[0], 1.0, 0.5) - x[1] - 5 * hill(x[3], 0.4, 0.3) + 30 * x[2],
          1 - 0.1 * x[0] - 0.06 * x[1] + 0.2 * x[3]};
}

TEST(LoadingFindings, AreSixteenInOrder) {
  const auto all = loading_findings(results_of(40, as_the_source));
  ASSERT_EQ(all.size(), 16u);
  for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(all[k].id, "F" + std::to_string(k + 1));
}

TEST(LoadingFindings, HoldWhereTheRunsAreAsTheSourceHasThem) {
  const auto of = found(results_of(1000, as_the_source));
  for (const char* id : {"F1", "F2", "F5", "F6", "F7", "F8", "F11", "F15", "F16"})
    EXPECT_EQ(of.at(id).verdict, Verdict::reproduced) << id << " " << of.at(id).grounds;
  for (const auto& [id, finding] : of) {
    if (id == "F13") continue;
    EXPECT_NE(finding.verdict, Verdict::not_reproduced) << id << " " << finding.grounds;
  }
}

TEST(LoadingFindings, FailWhereTheRunsSayOtherwise) {
  StudyResults results = results_of(1000, otherwise);
  results.nrmse = {0.3, 0.1, 0.5};
  results.X = uniform_points(1000, 1);
  results.X.col(2) = results.X.col(2).cwiseAbs2();
  for (int i = 0; i < 1000; ++i) results.Y.row(i) = otherwise(results.X.row(i).transpose()).transpose();
  const auto of = found(results);
  for (const char* id : {"F1", "F2", "F4", "F5", "F6", "F7", "F8", "F9", "F11", "F15", "F16"})
    EXPECT_EQ(of.at(id).verdict, Verdict::not_reproduced) << id << " " << of.at(id).grounds;
}

// Standard errors that runs tell beside the three change nothing.
TEST(LoadingFindings, StandAsTheyAreBesideStandardErrors) {
  const StudyResults plain = results_of(200, as_the_source);
  StudyResults told = plain;
  for (const char* name : {"production_error", "joint_damage_error", "rock_spill_error"})
    told.problem.responses.push_back({.name = name, .unit = "1", .goal = doe::Goal::record, .lower = 0});
  told.Y.conservativeResize(Eigen::NoChange, 6);
  told.Y.rightCols(3) = 1000 * uniform_points(200, 3).leftCols(3);
  told.Y_new.conservativeResize(Eigen::NoChange, 6);
  told.Y_new.rightCols(3).setZero();
  told.nrmse.resize(6, 0.9);
  const auto of_plain = found(plain), of_told = found(told);
  for (const auto& [id, finding] : of_plain) {
    EXPECT_EQ(of_told.at(id).verdict, finding.verdict) << id;
    EXPECT_EQ(of_told.at(id).grounds, finding.grounds) << id;
  }
}

/// Production rises with x₀, and one of the others does too; the third swings about it.
Vector3d uneven(const Vector4d& x, bool damage_is) {
  const double even = x[0], swinging = x[0] + 0.3 * std::sin(40 * x[0]);
  return damage_is ? Vector3d(x[0], swinging, even) : Vector3d(x[0], even, swinging);
}

// Higher production costs more of the even response, so that all runs are on the front.
TEST(LoadingFindings, FrontsAreComparedBySmoothness) {
  const auto smoothness = [](bool damage_is) {
    return found(results_of(100, [&](const Vector4d& x) { return uneven(x, damage_is); })).at("F13").verdict;
  };
  EXPECT_EQ(smoothness(true), Verdict::reproduced);
  EXPECT_EQ(smoothness(false), Verdict::not_reproduced);
}

// On a front where all three rise together, and on one where damage falls as production rises.
TEST(LoadingFindings, CompetitionIsByRankOnTheFront) {
  const auto of = found(results_of(100, [](const Vector4d& x) { return Vector3d(x[0], x[0], x[0]); }));
  EXPECT_EQ(of.at("F10").verdict, Verdict::reproduced) << of.at("F10").grounds;
  const auto apart =
      found(results_of(100, [](const Vector4d& x) { return Vector3d(x[0], -x[0], 3 * x[0]); }));
  EXPECT_EQ(apart.at("F10").verdict, Verdict::not_reproduced) << apart.at("F10").grounds;
}

TEST(LoadingFindings, AreUnclearWithFewRunsAndSayWhy) {
  StudyResults results = results_of(16, as_the_source);
  results.X = uniform_points(6, 1);
  results.Y.conservativeResize(6, 3);
  results.X_new.conservativeResize(2, 4);
  for (const Finding& finding : loading_findings(results)) {
    EXPECT_EQ(finding.verdict, Verdict::unclear) << finding.id << " " << finding.grounds;
    EXPECT_FALSE(finding.grounds.empty());
  }
  EXPECT_NE(found(results).at("F1").grounds.find("too few runs"), std::string::npos);
}

TEST(LoadingFindings, WithoutARunNothingIsDecided) {
  StudyResults results{.problem = problem,
                       .X = Eigen::MatrixXd(0, 4),
                       .Y = Eigen::MatrixXd(0, 3),
                       .X_new = Eigen::MatrixXd(0, 4),
                       .Y_new = Eigen::MatrixXd(0, 3),
                       .logs = {},
                       .nrmse = {}};
  for (const Finding& finding : loading_findings(results)) EXPECT_EQ(finding.verdict, Verdict::unclear);
}

// The error of tracking grows with depth and falls with height; or the other way round.
TEST(LoadingFindings, TrackingIsHeldAgainstDepthAndHeight) {
  const Eigen::VectorXd depth = Eigen::VectorXd::LinSpaced(30, 0, 3),
                        beta = (depth.array() * -0.3 + 1).matrix();
  EXPECT_EQ(tracking_finding(depth, depth, beta).verdict, Verdict::reproduced);
  EXPECT_EQ(tracking_finding(-depth, depth, beta).verdict, Verdict::not_reproduced);
  EXPECT_EQ(tracking_finding(depth.head(4), depth.head(4), beta.head(4)).verdict, Verdict::unclear);
}

/// Of a run of one cycle that stays `error` below the first leg of its planned path.
engine::loading::LoadingLog log_of_tracking(double error, double depth) {
  engine::loading::LoadingLog log;
  log.completed = true;
  log.signals.columns = {{"time", "s"}, {"cycle", "1"}, {"tip_x", "m"}, {"tip_z", "m"}, {"stage", "1"}};
  for (int k = 0; k < 3; ++k) log.signals.append_row(std::vector<double>{1.0 * k, 1, 0.5, -error, 1});
  engine::loading::CycleRecord cycle;
  cycle.t_end = 2;
  cycle.plan.depth = depth;
  cycle.planned_x = {0, 1, 1, 0};
  cycle.planned_z = {0, 0, 1, 1};
  log.cycles = {cycle};
  return log;
}

/// The first `n` runs with logs: the third cannot be read, the fifth is of a version that logged no plans.
StudyResults with_logs(StudyResults results, int n, const studies::test::TestFolder& place) {
  for (int i = 0; i < n; ++i) {
    results.logs.push_back(place / (std::to_string(i) + ".h5"));
    auto log = log_of_tracking(0.1 * (i + 1), 1 + 0.2 * (i % 5));
    if (i == 4) log.cycles[0].planned_x = log.cycles[0].planned_z = {};
    if (i == 2)
      studies::test::write_file(results.logs.back(), "no log");
    else
      write_log(results.logs.back(), log);
  }
  return results;
}

TEST(LoadingFindings, ALogThatCannotBeUsedIsSkippedAndCounted) {
  const studies::test::TestFolder place;
  const StudyResults without = results_of(40, as_the_source);
  const StudyResults results = with_logs(without, 8, place);
  const auto of = found(results), before = found(without);
  Eigen::VectorXd error(6), depth(6), beta(6);
  error << 0.1, 0.2, 0.4, 0.6, 0.7, 0.8;
  depth << 1, 1.2, 1.6, 1, 1.2, 1.4;
  beta = results.X(std::vector<int>{0, 1, 3, 5, 6, 7}, 1);
  const Finding expected = tracking_finding(error, depth, beta);
  EXPECT_EQ(of.at("F14").verdict, expected.verdict);
  EXPECT_EQ(of.at("F14").grounds.find(expected.grounds + "; 2 of 8 logs could not be used, the first: "), 0u)
      << of.at("F14").grounds;
  EXPECT_NE(of.at("F14").grounds.find("2.h5"), std::string::npos) << of.at("F14").grounds;
  for (const auto& [id, finding] : before) {
    if (id == "F14") continue;
    EXPECT_EQ(of.at(id).verdict, finding.verdict) << id;
    EXPECT_EQ(of.at(id).grounds, finding.grounds) << id;
  }
}

TEST(LoadingFindings, FourUsableLogsDecideNothing) {
  const studies::test::TestFolder place;
  const auto of = found(with_logs(results_of(40, as_the_source), 6, place));
  EXPECT_EQ(of.at("F14").verdict, Verdict::unclear);
  EXPECT_NE(of.at("F14").grounds.find("too few runs"), std::string::npos) << of.at("F14").grounds;
  EXPECT_NE(of.at("F14").grounds.find("2 of 6 logs"), std::string::npos) << of.at("F14").grounds;
}

TEST(LoadingFindings, ACornerTwiceDoesNotStandForAnother) {
  StudyResults results = results_of(1000, as_the_source);
  results.X.row(7) = results.X.row(12);
  EXPECT_EQ(found(results).at("F16").verdict, Verdict::not_reproduced) << found(results).at("F16").grounds;
}

// Sixteen corners among 26 runs put 8 points at each end: Kolmogorov's distance would be 8/26 √26 = 1.57 or
// more.
TEST(LoadingFindings, CornersDoNotCountAgainstUniformity) {
  const auto of = found(results_of(26, as_the_source));
  EXPECT_EQ(of.at("F16").verdict, Verdict::reproduced) << of.at("F16").grounds;
}

TEST(LoadingFindings, ASmallPlanHasNoCornersToJudge) {
  StudyResults results = results_of(39, as_the_source);
  results.X = uniform_points(39, 1);
  EXPECT_EQ(found(results).at("F16").verdict, Verdict::unclear) << found(results).at("F16").grounds;
}

/// All non-dominated: 20 runs that produce more, and n of high beta, low production and very low alpha.
StudyResults with_high_beta(int n) {
  StudyResults results{.problem = problem,
                       .X = Eigen::MatrixXd::Constant(20 + n, 4, 0.5),
                       .Y = Eigen::MatrixXd(20 + n, 3),
                       .X_new = Eigen::MatrixXd(0, 4),
                       .Y_new = Eigen::MatrixXd(0, 3),
                       .logs = {},
                       .nrmse = {}};
  results.X.topLeftCorner(20, 1).setConstant(1.6);
  for (int i = 0; i < 20; ++i) results.Y.row(i).setConstant(100 + i);
  for (int i = 20; i < 20 + n; ++i) {
    results.X.row(i).head<2>() << 0.3, 0.9;
    results.Y.row(i).setConstant(i);
  }
  return results;
}

TEST(LoadingFindings, FourParetoPointsTellNothing) {
  const Finding four = found(with_high_beta(4)).at("F12"), five = found(with_high_beta(5)).at("F12");
  EXPECT_EQ(four.verdict, Verdict::unclear) << four.grounds;
  EXPECT_EQ(four.grounds.find("4 such non-dominated runs"), 0u) << four.grounds;
  EXPECT_EQ(five.verdict, Verdict::reproduced) << five.grounds;
}

TEST(LoadingFindings, ParetoPointsOfHighAlphaAreCounted) {
  const Finding f2 = found(with_high_beta(5)).at("F2");
  EXPECT_NE(f2.grounds.find("20 of 25 non-dominated runs above 1.5"), std::string::npos) << f2.grounds;
}

TEST(LoadingFindings, AnotherProblemIsRefused) {
  StudyResults results = results_of(16, as_the_source);
  results.problem.variables.pop_back();
  support::expect_told<std::invalid_argument>([&] { loading_findings(results); },
                                              {"3 variables and 3 responses", "alpha, beta, gamma, kappa"});
}

}  // namespace
