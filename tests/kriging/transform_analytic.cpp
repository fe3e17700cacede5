// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/kriging/detail/normal.hpp>
#include <drawpoint/kriging/transform.hpp>
#include <limits>
#include <numbers>
#include <vector>

using namespace drawpoint::kriging;
using Eigen::VectorXd;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const std::vector<Transform> all = {{Scale::linear, 0, 0, 0},
                                    {Scale::square_root, 2, 0, 0},
                                    {Scale::logarithm, 2, 0, 0.25},
                                    {Scale::logit, 2, 5, 0.25, 0.125}};

// ∫ f(z + s t) φ(t) dt by the trapezoidal rule over [-9, 9]; for smooth f its error is far below 1e-9.
template <class F>
double normal_mean(const F& f, double z, double s) {
  constexpr int steps = 36000;
  const double h = 18.0 / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double t = -9 + h * i;
    sum += f(z + s * t) * detail::normal_density(t) * h;
  }
  return sum;
}

}  // namespace

// Round-off alone: each way is a handful of operations, and ln and its inverse lose at most |z| ulp.
TEST(Transform, IsUndoneByItsInverse) {
  for (const Transform& t : all) {
    for (const double y : {2.0, 2.001, 3.3, 4.999, 5.0})
      EXPECT_NEAR(back_transformed(t, transformed(t, y)), y, 1e-14 * 5) << to_string(t.scale);
    EXPECT_LT(transformed(t, 2.5), transformed(t, 2.5001)) << to_string(t.scale);
  }
}

TEST(Transform, KeepsPredictionsWithinItsOffsetOfTheBounds) {
  for (const double z : {-50.0, -3.0, 0.0, 40.0}) {
    EXPECT_GE(back_transformed(all[1], z), 2.0);
    EXPECT_GE(back_transformed(all[2], z), 1.75);
    EXPECT_GE(back_transformed(all[3], z), 1.75);
    EXPECT_LE(back_transformed(all[3], z), 5.125);
  }
}

// Central differences of step h = 1e-5: h² f‴/6 + ε f/h, with f and f‴ below 20 that is below 1e-9.
TEST(Transform, HasTheSlopeOfItsInverse) {
  const double h = 1e-5;
  for (const Transform& t : all)
    for (const double z : {-1.2, 0.3, 1.7})
      EXPECT_NEAR(back_slope(t, z), (back_transformed(t, z + h) - back_transformed(t, z - h)) / (2 * h), 1e-9)
          << to_string(t.scale);
}

// E e^(z + ε) = e^(z + τ²/2). The remainder of nine points is 9!/18! τ^18 times the eighteenth derivative
// near the middle: 6e-11 at τ = 1, 1.5e-5 times e^z at τ = 2.
TEST(MeanResponse, OfALogarithmIsThatOfTheLognormalDistribution) {
  const Transform t{Scale::logarithm, 0, 0, 0};
  for (const double z : {-4.0, 0.0, 3.0}) {
    EXPECT_NEAR(mean_response(t, z, 1.0) / std::exp(z + 0.5), 1, 1e-9);
    EXPECT_NEAR(mean_response(t, z, 4.0) / std::exp(z + 2.0), 1, 1e-5);
    EXPECT_EQ(mean_response(t, z, 0.0), std::exp(z));
  }
}

// E max(z + ε, 0)² = (z² + τ²)Φ(z/τ) + zτφ(z/τ).
TEST(MeanResponse, OfASquareRootMissesByLessThanOnePerCentOfTheNoise) {
  const Transform t{Scale::square_root, 0, 0, 0};
  const double tau = 0.7;
  for (double z = -3; z <= 3; z += 0.05) {
    const double u = z / tau, exact = (z * z + tau * tau) * detail::normal_probability(u) +
                                      z * tau * detail::normal_density(u);
    EXPECT_NEAR(mean_response(t, z, tau * tau), exact, 0.01 * tau * tau) << z;
  }
}

// The quadrature of a logistic function of slope 1 and noise 0.8 converges geometrically; 1e-4 of its range
// is what its poles, π from the axis, leave of nine points.
TEST(MeanResponse, OfALogitIsTheIntegral) {
  const Transform& t = all[3];
  for (const double z : {-3.0, -0.5, 0.0, 1.0}) {
    const auto inverse = [&](double at) { return back_transformed(t, at); };
    EXPECT_NEAR(mean_response(t, z, 0.64), normal_mean(inverse, z, 0.8), 1e-4 * 3.5) << z;
  }
  EXPECT_NEAR(mean_response(t, 0.0, 2.0), 0.5 * (1.75 + 5.125), 1e-14 * 5) << "the middle, by symmetry";
}

// Both are sums over the same nine points, so the slope is that of the sum: as above.
TEST(MeanResponse, HasItsSlope) {
  const double h = 1e-5;
  for (const Transform& t : all)
    for (const double z : {0.6, 1.7})
      EXPECT_NEAR(mean_response_slope(t, z, 0.25),
                  (mean_response(t, z + h, 0.25) - mean_response(t, z - h, 0.25)) / (2 * h), 1e-8)
          << to_string(t.scale);
}

// The first three of the runs at 0.01, 0.1, 0.4 and 9 scatter by more than that: 0.1, 0.2 and 0.5. Noise that is a
// share of the response reaches no bound, however small some runs are.
TEST(TransformFor, PutsTheScatterBelowRunsWhoseNoiseReachesABound) {
  const ResponseRange positive{0, infinity}, share{0, 10};
  const VectorXd y = (VectorXd(4) << 0.01, 0.1, 0.4, 9.0).finished();
  const VectorXd variance = (VectorXd(4) << 0.01, 0.04, 0.25, 0.04).finished();
  const VectorXd touching = (VectorXd(4) << 0.0, 0.1, 0.4, 9.0).finished();
  const VectorXd proportional = (0.3 * y).array().square();
  EXPECT_EQ(transform_for(Scale::logarithm, y, positive, variance).offset, 0.2);
  EXPECT_EQ(transform_for(Scale::logarithm, touching, positive, variance).offset, 0.2);
  EXPECT_EQ(transform_for(Scale::logarithm, y, positive, proportional).offset, 0.0);
  EXPECT_EQ(transform_for(Scale::logarithm, y, positive, VectorXd::Zero(4)).offset, 0.0) << "exact runs";
  EXPECT_EQ(transform_for(Scale::logarithm, touching, positive, VectorXd::Zero(4)).offset, 0.05);
  EXPECT_EQ(transform_for(Scale::square_root, y, positive, variance).offset, 0.0);
  EXPECT_EQ(transform_for(Scale::logit, y, share, variance).offset, 0.2);
  EXPECT_EQ(transform_for(Scale::logit, y, share, variance).upper_offset, 0.0);
  EXPECT_THROW(transform_for(Scale::logarithm, y, positive, variance.head(3)), std::invalid_argument)
      << "one variance per run";
  EXPECT_THROW(transform_for(Scale::logarithm, y, positive, -variance), std::invalid_argument);
  for (const double unit : {1e-8, 1e8})
    EXPECT_NEAR(transform_for(Scale::logarithm, unit * y, positive, unit * unit * variance).offset,
                0.2 * unit, 1e-12 * unit);
}

TEST(TransformFor, PutsHalfOfTheLeastDistanceBelowRunsOnABound) {
  const ResponseRange positive{0, infinity}, share{0, 1};
  const VectorXd inside = Eigen::Vector3d(0.2, 0.5, 0.9), touching = Eigen::Vector3d(0.0, 0.5, 0.9);
  EXPECT_EQ(transform_for(Scale::logarithm, inside, positive).offset, 0.0);
  EXPECT_EQ(transform_for(Scale::logarithm, touching, positive).offset, 0.25);
  EXPECT_EQ(transform_for(Scale::square_root, touching, positive).offset, 0.0);
  EXPECT_EQ(transform_for(Scale::logit, inside, share).offset, 0.0);
  EXPECT_EQ(transform_for(Scale::logit, touching, share).offset, 0.25);
  EXPECT_EQ(transform_for(Scale::logit, touching, share).upper_offset, 0.0) << "each bound has its own";
  const VectorXd other = Eigen::Vector3d(1.0, 0.5, 0.75);
  EXPECT_EQ(transform_for(Scale::logit, other, share).upper_offset, 0.125);
  EXPECT_EQ(transform_for(Scale::logarithm, VectorXd::Zero(3), positive).scale, Scale::linear)
      << "all on the bound";
}

TEST(TransformFor, NamesWhatIsMissing) {
  const VectorXd y = Eigen::Vector2d(0.5, 2.0);
  const auto message = [&](Scale scale, const ResponseRange& range) -> std::string {
    try {
      transform_for(scale, y, range);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message(Scale::logarithm, {}).find("need a finite lower bound"), std::string::npos);
  EXPECT_NE(message(Scale::logit, {0, infinity}).find("logit both"), std::string::npos);
  EXPECT_NE(message(Scale::logit, {0, 1}).find("y[1] is 2"), std::string::npos);
  EXPECT_NE(message(Scale::square_root, {3, 3}).find("lower < upper"), std::string::npos);
  EXPECT_EQ(message(Scale::linear, {}), "");
}
