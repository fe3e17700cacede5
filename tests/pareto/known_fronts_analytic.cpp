// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Test functions against the fronts and optimal points that their authors publish.

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/tests/pareto/known_fronts.hpp>
#include <functional>
#include <numbers>

using namespace drawpoint;
using namespace drawpoint::support;

namespace {

using Place = std::function<Eigen::VectorXd(double)>;

Eigen::VectorXd first_and_rest(int d, double first, double rest) {
  Eigen::VectorXd x = Eigen::VectorXd::Constant(d, rest);
  x[0] = first;
  return x;
}

Place rest_at(int d, double rest) {
  return [d, rest](double t) { return first_and_rest(d, t, rest); };
}

/// y in [0, 1], position variables all at t.
Eigen::VectorXd wfg_point(const Eigen::VectorXd& y) {
  return y.cwiseProduct(Eigen::VectorXd::LinSpaced(y.size(), 2.0, 2.0 * static_cast<double>(y.size())));
}

Eigen::VectorXd wfg_optimum(double t) {
  Eigen::VectorXd y = Eigen::VectorXd::Constant(wfg_variables, 0.35);
  y.head(wfg_position).setConstant(t);
  return wfg_point(y);
}

/// Huband et al. 2006: from the last variable on, y_i = 0.35^(1/(0.02 + 1.96 u)), u the mean of those after
/// it.
Eigen::VectorXd wfg9_optimum(double t) {
  Eigen::VectorXd y = Eigen::VectorXd::Constant(wfg_variables, 0.35);
  y.head(wfg_position).setConstant(t);
  for (Eigen::Index i = wfg_variables - 2; i >= wfg_position; --i)
    y[i] = std::pow(0.35, 1.0 / (0.02 + 1.96 * y.tail(wfg_variables - 1 - i).mean()));
  return wfg_point(y);
}

/// x_i^13 = 1/2 + (i - 1)/30 for i = 2..15: the distance of MW1 is 1.
Eigen::VectorXd mw1_optimum(double t) {
  Eigen::VectorXd x = first_and_rest(15, t, 0.0);
  for (int i = 1; i < 15; ++i) x[i] = std::pow(0.5 + i / 30.0, 1.0 / 13.0);
  return x;
}

/// x_i = 1 - (x_(i-1) - 1/2)²: the distance of MW3 and MW7 is 1.
Eigen::VectorXd linked_optimum(double t) {
  Eigen::VectorXd x = first_and_rest(15, t, 0.0);
  for (int i = 1; i < 15; ++i) x[i] = 1.0 - std::pow(x[i - 1] - 0.5, 2);
  return x;
}

Eigen::VectorXd bnh_optimum(double t) { return Eigen::Vector2d(5.0 * t, std::min(5.0 * t, 3.0)); }

/// Optimal points, and the residual of the equation of their front.
struct Published {
  doe::Outcome (*f)(const Eigen::VectorXd&);
  Place optimum;
  std::function<double(const Eigen::VectorXd&)> residual;
};

double off_line(const Eigen::VectorXd& y) { return y.head(2).sum() - 1.0; }
double off_circle(const Eigen::VectorXd& y) { return y.head(2).norm() - 1.0; }
double off_ellipse(const Eigen::VectorXd& y) { return std::hypot(y[0] / 2.0, y[1] / 4.0) - 1.0; }
double off_zdt2(const Eigen::VectorXd& y) { return y[1] - (1.0 - y[0] * y[0]); }
/// Binh, Korn: sqrt(f_1)/(2 √2) = x_1 where x_1 = x_2, and so sqrt(f_2) = √2 (5 - x_1); beyond, f_2 - 4 = (5
/// - x_1)².
double off_bnh(const Eigen::VectorXd& y) {
  if (y[0] <= 72.0) return std::sqrt(y[1]) - std::numbers::sqrt2 * (5.0 - std::sqrt(y[0] / 8.0));
  return y[1] - 4.0 - std::pow(5.0 - std::sqrt((y[0] - 36.0) / 4.0), 2);
}

// Rounding: a few operations on numbers of about 1, to at most 160 for BNH, a power of 1/0.02 in WFG9.
TEST(KnownFronts, OptimalPointsLieOnThem) {
  const auto off_zdt1 = [](const Eigen::VectorXd& y) { return y[1] - (1.0 - std::sqrt(y[0])); };
  for (const Published& p : std::vector<Published>{{zdt1, rest_at(30, 0.0), off_zdt1},
                                                   {zdt2, rest_at(30, 0.0), off_zdt2},
                                                   {zdt4, rest_at(10, 0.5), off_zdt1},
                                                   {zdt6, rest_at(10, 0.0), off_zdt2},
                                                   {wfg4, wfg_optimum, off_ellipse},
                                                   {wfg9, wfg9_optimum, off_ellipse},
                                                   {bnh, bnh_optimum, off_bnh},
                                                   {mw3, linked_optimum, off_line},
                                                   {mw7, linked_optimum, off_circle}})
    for (int i = 0; i <= 200; ++i)
      EXPECT_NEAR(p.residual(p.f(p.optimum(i / 200.0)).values()), 0.0, 1e-12) << i;
}

TEST(KnownFronts, OptimalPointsHaveTheValuesOfTheCurve) {
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0;
    EXPECT_NEAR((zdt3(first_and_rest(30, t, 0.0)).values() - on_zdt3(t)).norm(), 0.0, 1e-12);
    // position is a mean of t^0.02
    EXPECT_NEAR((wfg1(wfg_optimum(t)).values() - on_wfg1(std::pow(t, 0.02))).norm(), 0.0, 1e-11);
    EXPECT_NEAR((wfg2(wfg_optimum(t)).values() - on_wfg2(t)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(mw1(mw1_optimum(t)).values()[1], 1.0 - 0.85 * t, 1e-12);
  }
}

TEST(KnownFronts, OfThreeObjectivesLieOnPlaneAndSphere) {
  for (int i = 0; i <= 20; ++i)
    for (int k = 0; k <= 20; ++k) {
      Eigen::VectorXd x = Eigen::VectorXd::Constant(12, 0.5);
      x.head(2) << i / 20.0, k / 20.0;
      EXPECT_NEAR(dtlz1(x.head(7)).values().sum(), 0.5, 1e-12);
      EXPECT_NEAR(dtlz2(x).values().norm(), 1.0, 1e-12);
      EXPECT_EQ(c2_dtlz2(x).values().head(3), dtlz2(x).values());
    }
}

// The ends of the five pieces in Deb's table: f_1 from -274 to -42, f_2 from 4 to 76. All limits are met: x_1
// of
// 4.056 and x_3 of 3.732 are given to three digits.
TEST(KnownFronts, OsyHasTheEndsOfTheTable) {
  EXPECT_NEAR(on_osy(0.2 - 1e-12)[0], -274.0, 1e-9);
  EXPECT_NEAR(on_osy(0.2 - 1e-12)[1], 76.0, 1e-9);
  EXPECT_NEAR(on_osy(1.0)[0], -(25.0 + 1.0 + 16.0), 1e-12);
  EXPECT_NEAR(on_osy(1.0)[1], 4.0, 1e-12);
  for (int i = 0; i <= 1000; ++i)
    EXPECT_LE(osy(osy_optimum(i / 1000.0)).values().tail(6).maxCoeff(), 1e-3) << i;
}

// A search comes near and not beyond: a hundred points dominate some half a percent less than a front, more
// than the volume of a sampled front is short by.
TEST(KnownFronts, NoSearchFindsMore) {
  for (const KnownFront& known : known_fronts()) {
    const pareto::Front found = pareto::nsga2(
        known.f, known.problem, {.search = {.population = 100, .stopping = {.generations = 150}}});
    const double share = pareto::hypervolume(found.Y, known.reference) / known.volume;
    EXPECT_LT(share, 1.0) << known.name;
  }
}

}  // namespace
