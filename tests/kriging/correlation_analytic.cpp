// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/tests/kriging/correlations.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

CorrelationFunction function(Correlation family) {
  CorrelationFunction f{family, Eigen::Vector3d(0.3, 2.0, 11.0), {}};
  if (family == Correlation::power_exponential) f.exponent = Eigen::Vector3d(1.0, 1.4, 2.0);
  return f;
}

double product(const CorrelationFunction& f, const VectorXd& a, const VectorXd& b) {
  double c = 1;
  for (Eigen::Index k = 0; k < a.size(); ++k)
    c *= reference::one_correlation(f.family, f.theta[k], f.exponent.size() ? f.exponent[k] : 2.0,
                                    std::abs(a[k] - b[k]));
  return c;
}

template <class F>
double derivative(const F& f, double x, double h) {
  const double coarse = (f(x + h) - f(x - h)) / (2 * h), fine = (f(x + h / 2) - f(x - h / 2)) / h;
  return (4 * fine - coarse) / 3;
}

}  // namespace

// 301 rows: more than one chunk, and a rest that fills no vector.
TEST(Correlation, IsTheProductOfItsDefinition) {
  const MatrixXd X = 2.0 * reference::design(301, 3, 4).array() - 1.0;
  for (const Correlation family : reference::families) {
    const CorrelationFunction f = function(family);
    MatrixXd C;
    fill_correlation(X, f, C);
    const MatrixXd cross = cross_correlation(X, X.topRows(5), f);
    for (Eigen::Index j = 0; j < X.rows(); j += 7)
      for (Eigen::Index i = j; i < X.rows(); ++i) {
        const double expected = product(f, X.row(i), X.row(j));
        // The argument of exp, below 60, is good to a few of its last bits: 60 · 4 · 1.1e-16 of the result.
        EXPECT_NEAR(C(i, j), expected, 3e-14 * expected) << to_string(family);
        if (j < 5) {
          EXPECT_EQ(cross(i, j), C(i, j));
        }
      }
  }
}

// Far away exp stays at 3e-308 and Matérn's polynomials, held at h = 800, below (800²)³ = 3e17.
TEST(Correlation, IsOneAtNoDistanceAndVanishesFarAway) {
  for (const Correlation family : reference::families) {
    const CorrelationFunction f = function(family);
    const MatrixXd c = cross_correlation(MatrixXd::Zero(1, 3), MatrixXd::Zero(1, 3), f);
    EXPECT_EQ(c(0, 0), 1.0) << to_string(family);
    const MatrixXd far = cross_correlation(MatrixXd::Zero(1, 3), MatrixXd::Constant(1, 3, 1e8), f);
    EXPECT_GE(far(0, 0), 0.0);
    EXPECT_LT(far(0, 0), 1e-290);
    EXPECT_TRUE(std::isfinite(detail::slope_in_place(f, 0, 1e160)));
  }
}

// Richardson's extrapolation with h = 0.02 leaves h⁴ f⁽⁵⁾/480 = 3e-10 f⁽⁵⁾. ln c is a power of e^(ln θ) up to
// u² with u below 5 here (or a ratio of such), so f⁽⁵⁾ stays below 5⁵ of the slope: 1e-6 of it, and 1e-6 near
// zero.
TEST(Correlation, SlopesAreDifferenceQuotients) {
  for (const Correlation family : reference::families) {
    const CorrelationFunction f = function(family);
    for (Eigen::Index k = 0; k < 3; ++k) {
      for (const double distance : {0.05, 0.4, 1.1}) {
        const auto logarithm = [&](double log_theta, double exponent, double at) {
          return std::log(reference::one_correlation(f.family, std::exp(log_theta), exponent, at));
        };
        const double t = std::log(f.theta[k]), p = f.exponent.size() ? f.exponent[k] : 2.0;
        detail::Chunk h(1);
        h.number[0] = distance;
        const double slope = detail::slope_in_theta(f, k, h)[0];
        const double tolerance = 1e-6 * (1 + std::abs(slope));
        EXPECT_NEAR(slope, derivative([&](double x) { return logarithm(x, p, distance); }, t, 0.02),
                    tolerance);
        const auto slope_at = [&](double log_theta) {
          CorrelationFunction moved = f;
          moved.theta[k] = std::exp(log_theta);
          return detail::slope_in_theta(moved, k, h)[0];
        };
        EXPECT_NEAR(detail::curvature_in_theta(f, k, h)[0], derivative(slope_at, t, 0.02), tolerance);
        EXPECT_NEAR(detail::slope_in_place(f, k, -distance),
                    -derivative([&](double x) { return logarithm(t, p, x); }, distance, 0.01 * distance),
                    1e-6 * (1 + std::abs(slope) / distance));
        if (family == Correlation::power_exponential) {
          EXPECT_NEAR(detail::slope_in_exponent(f, k, h)[0],
                      derivative([&](double x) { return logarithm(t, x, distance); }, p, 0.02), tolerance);
        }
      }
    }
  }
}
