// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The findings on made-up runs in which they hold, fail, and cannot be decided. Responses are formulas of
/// the variables, without noise, on a uniform sample of fixed seed: effects are many standard errors away
/// from 0. What is said of fronts is asked of surfaces whose points are chosen.

#include <drawpoint/studies/loading/loading_findings.h>
#include <drawpoint/studies/loading/loading_front_findings.h>
#include <drawpoint/studies/loading/loading_run_findings.h>
#include <gtest/gtest.h>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/tests/studies/loading_formulas.hpp>
#include <drawpoint/tests/studies/support.hpp>
#include <drawpoint/tests/support/told.hpp>

#include <cmath>

using namespace drawpoint;
using namespace drawpoint::studies;
using namespace drawpoint::studies::test;

namespace {

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
  for (std::size_t r = 0; r < 3; ++r) {
    const std::string name = told.problem.responses[r].name + "_error";
    told.problem.responses[r].standard_error = name;
    told.problem.responses.push_back({.name = name, .unit = "1", .goal = doe::Goal::record, .lower = 0});
  }
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

/// A surface that is known: its findings are decided by their sign.
FrontFindings fronts_of(const Eigen::MatrixXd& points, const Eigen::MatrixXd& means) {
  return front_findings({problem, points, {means}});
}

FrontFindings fronts_of(const Formula& f) {
  const Eigen::MatrixXd points = uniform_points(100, 1);
  Eigen::MatrixXd means(100, 3);
  for (int i = 0; i < 100; ++i) means.row(i) = f(points.row(i).transpose()).transpose();
  return fronts_of(points, means);
}

/// Production rises with x₀, and one of the others does too; the third swings about it.
Vector3d uneven(const Vector4d& x, bool damage_is) {
  const double even = x[0], swinging = x[0] + 0.3 * std::sin(40 * x[0]);
  return damage_is ? Vector3d(x[0], swinging, even) : Vector3d(x[0], even, swinging);
}

// Higher production costs more of the even response, so that all points are on the front.
TEST(LoadingFindings, FrontsAreComparedBySmoothness) {
  const auto smoothness = [](bool damage_is) {
    return fronts_of([&](const Vector4d& x) { return uneven(x, damage_is); }).f13.verdict;
  };
  EXPECT_EQ(smoothness(true), Verdict::reproduced);
  EXPECT_EQ(smoothness(false), Verdict::not_reproduced);
}

// On a front where all three rise together, and on one where damage falls as production rises.
TEST(LoadingFindings, CompetitionIsByRankOnTheFront) {
  const Finding together = fronts_of([](const Vector4d& x) { return Vector3d(x[0], x[0], x[0]); }).f10;
  EXPECT_EQ(together.verdict, Verdict::reproduced) << together.grounds;
  const Finding apart = fronts_of([](const Vector4d& x) { return Vector3d(x[0], -x[0], 3 * x[0]); }).f10;
  EXPECT_NE(apart.verdict, Verdict::reproduced) << apart.grounds;
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
StudyResults with_logs(StudyResults results, int n, const TestFolder& place) {
  for (int i = 0; i < n; ++i) {
    results.logs.push_back(place / (std::to_string(i) + ".h5"));
    auto log = log_of_tracking(0.1 * (i + 1), 1 + 0.2 * (i % 5));
    if (i == 4) log.cycles[0].planned_x = log.cycles[0].planned_z = {};
    if (i == 2)
      write_file(results.logs.back(), "no log");
    else
      write_log(results.logs.back(), log);
  }
  return results;
}

TEST(LoadingFindings, ALogThatCannotBeUsedIsSkippedAndCounted) {
  const TestFolder place;
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
  const TestFolder place;
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

/// All non-dominated: 20 points that produce more, and n of high beta, low production and very low alpha.
FrontFindings with_high_beta(int n) {
  Eigen::MatrixXd points = Eigen::MatrixXd::Constant(20 + n, 4, 0.5), means(20 + n, 3);
  points.topLeftCorner(20, 1).setConstant(1.6);
  for (int i = 0; i < 20; ++i) means.row(i).setConstant(100 + i);
  for (int i = 20; i < 20 + n; ++i) {
    points.row(i).head<2>() << 0.3, 0.9;
    means.row(i).setConstant(i);
  }
  return fronts_of(points, means);
}

TEST(LoadingFindings, FourParetoPointsDecideNothing) {
  const Finding four = with_high_beta(4).f12, five = with_high_beta(5).f12;
  EXPECT_EQ(four.verdict, Verdict::unclear) << four.grounds;
  EXPECT_EQ(five.verdict, Verdict::reproduced) << five.grounds;
}

TEST(LoadingFindings, AnotherProblemIsRefused) {
  StudyResults results = results_of(16, as_the_source);
  results.problem.variables.pop_back();
  support::expect_told<std::invalid_argument>([&] { loading_findings(results); },
                                              {"3 variables and 3 responses", "alpha, beta, gamma, kappa"});
}

}  // namespace
