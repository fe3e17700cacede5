// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/pareto/local_trade_off.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

using doe::Goal;

// Least squares of a handful of numbers about 1 at exact points of the front.
constexpr double rounding = 1e-12;

template <class F>
Front front_at(const F& f, const doe::Problem& problem, const Eigen::MatrixXd& X) {
  Front front;
  front.X = X;
  front.responses.resize(X.rows(), static_cast<Eigen::Index>(problem.responses.size()));
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    front.responses.row(i) = f(X.row(i).transpose()).values.transpose();
  front.Y = front.responses(Eigen::all, detail::roles(problem).objectives);
  return front;
}

/// |x - a|² minimised and -7 |x - b|² maximised: at a + t (b - a) they are t² L² and -7 (1-t)² L², so the
/// second gains 7 (1-t)/t for a unit of the first.
const Eigen::Vector3d a(0.2, 0.3, 0.5), b(0.8, 0.5, 0.5);
const doe::Problem opposed{{{"x", "1", 0.0, 1.0}, {"y", "1", 0.0, 1.0}, {"z", "1", 0.0, 1.0}},
                           {{"near", "m2", Goal::minimize}, {"score", "1", Goal::maximize}}};

ValueAndJacobian distances(const Eigen::VectorXd& x) {
  ValueAndJacobian y{Eigen::VectorXd(2), Eigen::MatrixXd(2, 3)};
  y.values << (x - a).squaredNorm(), -7.0 * (x - b).squaredNorm();
  y.jacobian << 2.0 * (x - a).transpose(), -14.0 * (x - b).transpose();
  return y;
}

Eigen::MatrixXd on_the_segment() {
  Eigen::MatrixXd X(5, 3);
  for (int i = 0; i < 5; ++i) X.row(i) = (a + 0.25 * i * (b - a)).transpose();
  return X;
}

TEST(LocalTradeOff, IsTheSlopeOfTheFrontInNaturalUnits) {
  const Front front = front_at(distances, opposed, on_the_segment());
  for (int i = 1; i < 4; ++i) {
    const double t = 0.25 * i, slope = 7.0 * (1.0 - t) / t;
    const LocalTradeOff local = local_trade_off(distances, opposed, front, i);
    EXPECT_EQ(local.status, LocalTradeOffStatus::stationary);
    EXPECT_NEAR(local.rates(1, 0), slope, rounding * slope);
    EXPECT_NEAR(local.rates(0, 1), 1.0 / slope, rounding / slope);
    EXPECT_EQ(local.rates(0, 0), 1.0);
  }
}

// At a itself the first gradient vanishes, λ = (1, 0): any loss of the first is free at first order.
TEST(LocalTradeOff, IsInfiniteAtAnEnd) {
  const Front front = front_at(distances, opposed, on_the_segment());
  const LocalTradeOff end = local_trade_off(distances, opposed, front, 0);
  EXPECT_TRUE(std::isinf(end.rates(1, 0)));
  EXPECT_EQ(end.rates(0, 1), 0.0);
}

// 0.4 off the segment's middle, in ranges of 0.4 and 2.8, the gradients are (±1.5, ±0.5, 2) and their shortest mean
// (0, 0, 2), which is 2/√6.5 of their length.
TEST(LocalTradeOff, SaysWhereThePointIsNotOnTheFront) {
  Eigen::MatrixXd X = on_the_segment();
  X(2, 2) = 0.9;
  const LocalTradeOff off = local_trade_off(distances, opposed, front_at(distances, opposed, X), 2);
  EXPECT_EQ(off.status, LocalTradeOffStatus::not_stationary);
  EXPECT_NEAR(off.residual, 2.0 / std::sqrt(6.5), rounding);
  EXPECT_NE(off.message.find("above the tolerance of 0.001; polish the front first"), std::string::npos);
}

/// x and y minimised with x y >= 1: the front is the limit itself, y = 1/x, of slope -1/x².
const doe::Problem hyperbola{
    {{"x", "m", 0.1, 10.0}, {"y", "s", 0.1, 10.0}},
    {{"x_cost", "m", Goal::minimize}, {"y_cost", "s", Goal::minimize}, {"area", "m s", Goal::at_least, 1.0}}};

ValueAndJacobian sides_and_area(const Eigen::VectorXd& x) {
  ValueAndJacobian y{Eigen::VectorXd(3), Eigen::MatrixXd(3, 2)};
  y.values << x[0], x[1], x[0] * x[1];
  y.jacobian << 1.0, 0.0, 0.0, 1.0, x[1], x[0];
  return y;
}

TEST(LocalTradeOff, HoldsActiveLimits) {
  Eigen::MatrixXd X(3, 2);
  X << 0.5, 2.0, 1.0, 1.0, 4.0, 0.25;
  const Front front = front_at(sides_and_area, hyperbola, X);
  for (int i = 0; i < 3; ++i) {
    const LocalTradeOff local = local_trade_off(sides_and_area, hyperbola, front, i);
    EXPECT_EQ(local.status, LocalTradeOffStatus::stationary);
    const double slope = 1.0 / (X(i, 0) * X(i, 0));
    EXPECT_NEAR(local.rates(1, 0), -slope, rounding * slope);
  }
}

// Σ x_j² = 1 on the octant of a sphere, objectives minimised with the limit at_least: ∂y_a/∂y_b = -x_b/x_a.
TEST(LocalTradeOff, ThreeObjectives) {
  doe::Problem problem = support::unit_problem(3, 4);
  problem.responses[3] = {"radius", "1", Goal::at_least, 1.0};
  const auto sphere = [](const Eigen::VectorXd& x) {
    ValueAndJacobian y{Eigen::VectorXd(4), Eigen::MatrixXd::Identity(4, 3)};
    y.values << x, x.squaredNorm();
    y.jacobian.row(3) = 2.0 * x.transpose();
    return y;
  };
  Eigen::MatrixXd X(4, 3);
  X << 2, 3, 6, 6, 2, 3, 3, 6, 2, 0, 7, 0;
  X /= 7.0;
  const LocalTradeOff local = local_trade_off(sphere, problem, front_at(sphere, problem, X), 0);
  EXPECT_NEAR(local.rates(0, 1), -1.5, rounding);
  EXPECT_NEAR(local.rates(2, 0), -1.0 / 3.0, rounding);
}

TEST(LocalTradeOff, FailuresAndBadInputAreNamed) {
  const Front front = front_at(distances, opposed, on_the_segment());
  const auto broken = [](const Eigen::VectorXd&) -> ValueAndJacobian { throw std::runtime_error("no"); };
  const LocalTradeOff failed = local_trade_off(broken, opposed, front, 1);
  EXPECT_EQ(failed.status, LocalTradeOffStatus::failed);
  EXPECT_NE(failed.message, "");
  const auto text = [&](int row, LocalTradeOffOptions options) {
    return support::thrown_text<std::invalid_argument>(
        [&] { local_trade_off(distances, opposed, front, row, options); });
  };
  EXPECT_EQ(text(5, {}), "pareto::local_trade_off: row is 5; allowed is 0 to the number of points - 1");
  EXPECT_EQ(text(0, {.tolerance = 0.0}), "pareto::local_trade_off: tolerance is 0; allowed is above 0");
}

}  // namespace
