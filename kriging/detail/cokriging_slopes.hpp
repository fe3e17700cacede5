// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Derivatives by the inputs of what levels of co-Kriging say of one point (cokriging_level.hpp).
///
///   ∂k/∂x = ∂c/∂x + D (∂S(X, x)/∂x ρ + S(X, x) ∂ρ/∂x)/s²
///   ∂h/∂x = (∂f/∂x, ∂g/∂x (m − c) + g ∂m/∂x)
/// and Q, V, W, mean and variance follow linearly or by squares. Cost per level: n² d.

#include <Eigen/Core>
#include <cstddef>
#include <drawpoint/kriging/detail/cokriging_level.hpp>
#include <drawpoint/kriging/model.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

/// By the natural inputs: one column per input.
struct LevelSlopes {
  Eigen::VectorXd mean, rho;  ///< d
  Eigen::MatrixXd Q, V, W;    ///< n x d, q x d, parameters x d
};

/// n x d: of c(x, B) for the scaled rows of B.
inline Eigen::MatrixXd correlation_slopes(const ModelState& s, const Eigen::VectorXd& scaled,
                                          const Eigen::MatrixXd& B) {
  const Eigen::VectorXd r = cross_correlation(B, scaled.transpose(), s.correlation).col(0);
  Eigen::MatrixXd J(B.rows(), scaled.size());
  for (Index k = 0; k < J.cols(); ++k)
    for (Index i = 0; i < J.rows(); ++i)
      J(i, k) = r[i] * s.input.factor[k] * slope_in_place(s.correlation, k, scaled[k] - B(i, k));
  return J;
}

/// One point's views and their slopes at the levels below.
struct PointBelow {
  const LevelViews& views;
  const std::vector<LevelSlopes>& slopes;
};

/// n x d: of S(B, x) after the first `count` levels, for the views of n points B.
inline Eigen::MatrixXd covariance_slopes(const CokrigingLevels& levels, std::size_t count,
                                         const LevelViews& b, const PointBelow& at) {
  const Index n = b[0].mean.size(), d = at.views[0].scaled.cols();
  Eigen::VectorXd S = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, d);
  for (std::size_t t = 0; t < count; ++t) {
    const LevelView& v = at.views[t];
    const LevelSlopes& slope = at.slopes[t];
    const double variance = levels[t].variance();
    Eigen::MatrixXd own = correlation_slopes(levels[t].s, v.scaled.row(0).transpose(), b[t].scaled);
    for (Index k = 0; k < d; ++k) {
      add_product(column(own, k), -1.0, b[t].Q, column(slope.Q, k));
      add_product(column(own, k), 1.0, b[t].V, column(slope.V, k));
      for (Index i = 0; i < n; ++i)
        J(i, k) = b[t].rho[i] * (v.rho[0] * J(i, k) + S[i] * slope.rho[k]) + variance * own(i, k);
      add_product(column(J, k), 1.0, b[t].W, column(slope.W, k));
    }
    S = covariance_of(levels, t + 1, b, at.views).col(0);
  }
  return J;
}

/// ∂h/∂x: q x d. `below`: slope of m, unused at the cheapest level.
inline Eigen::MatrixXd regressor_slopes(const CokrigingLevel& level, const TrendPoint& x, double mean_below,
                                        const Eigen::VectorXd& below) {
  const Eigen::MatrixXd df = level.s.trend.jacobian(x);
  if (level.rho.empty()) return df;
  const TrendFunction rho{level.rho, {}, {}};
  const Eigen::MatrixXd dg = rho.jacobian(x);
  const Eigen::VectorXd g = rho.values(x);
  Eigen::MatrixXd dh(df.rows() + dg.rows(), df.cols());
  for (Index j = 0; j < dh.cols(); ++j) {
    for (Index i = 0; i < df.rows(); ++i) dh(i, j) = df(i, j);
    for (Index i = 0; i < dg.rows(); ++i)
      dh(df.rows() + i, j) =
          (dg(i, j) * (mean_below - level.below_centre) + g[i] * below[j]) / level.s.y_scale;
  }
  return dh;
}

/// Adds to ∂c/∂x: n x d what makes it ∂k/∂x.
inline void add_slopes_below(const CokrigingLevels& levels, std::size_t t, const PointBelow& at,
                             const Eigen::VectorXd& rho_slope, Eigen::MatrixXd& k) {
  const CokrigingLevel& level = levels[t];
  const Eigen::VectorXd S = covariance_of(levels, t, level.runs_below, at.views).col(0);
  const Eigen::MatrixXd dS = covariance_slopes(levels, t, level.runs_below, at);
  for (Index j = 0; j < k.cols(); ++j)
    for (Index i = 0; i < k.rows(); ++i)
      k(i, j) +=
          level.rho_at_runs[i] * (at.views[t].rho[0] * dS(i, j) + S[i] * rho_slope[j]) / level.variance();
}

/// ∂W/∂x: parameters x d, from ∂c/∂x, ∂h/∂x and ∂k/∂x.
inline Eigen::MatrixXd deviation_slopes(const CokrigingLevel& level, const PredictedSlopes& at,
                                        Eigen::MatrixXd k) {
  if (level.effects.none()) return Eigen::MatrixXd::Zero(0, k.cols());
  Eigen::MatrixXd W = mean_deviation_slopes(level.s, level.effects, at);
  add_scaled(k.data(), -1.0, at.slopes.data(), k.size());
  const Eigen::MatrixXd by_alpha = transposed_product(level.effects.alpha, k);
  add_scaled(W.data(), 1.0, by_alpha.data(), W.size());
  for (double& entry : W.reshaped()) entry *= level.s.y_scale;
  return W;
}

/// The slopes of the view at levels[t] of the point x; `at`: its views up to levels[t], its slopes below that.
inline LevelSlopes slopes_of(const CokrigingLevels& levels, std::size_t t, const Eigen::VectorXd& x,
                             const PointBelow& at) {
  const CokrigingLevel& level = levels[t];
  const ModelState& s = level.s;
  const Eigen::VectorXd scaled = at.views[t].scaled.row(0).transpose(), half_range = s.input.half_range();
  const TrendPoint point{x, scaled, half_range};
  LevelSlopes J{{}, Eigen::VectorXd::Zero(x.size()), {}, {}, {}};
  const Eigen::MatrixXd c = correlation_slopes(s, scaled, s.X);
  const Eigen::MatrixXd h =
      t == 0 ? s.trend.jacobian(point)
             : regressor_slopes(level, point, at.views[t - 1].mean[0], at.slopes[t - 1].mean);
  J.Q = c;
  if (!level.rho.empty()) {
    J.rho = transposed_product(TrendFunction{level.rho, {}, {}}.jacobian(point), level.rho_given);
    add_slopes_below(levels, t, at, J.rho, J.Q);
  }
  const Eigen::VectorXd by_k = transposed_product(J.Q, s.gls.alpha), by_h = transposed_product(h, s.gls.beta);
  J.mean = by_h;
  add_scaled(J.mean.data(), 1.0, by_k.data(), J.mean.size());
  J.mean = affine(J.mean, s.y_scale);
  const Eigen::VectorXd r = cross_correlation(s.X, scaled.transpose(), s.correlation).col(0);
  J.W = deviation_slopes(level, {scaled, r, c, h}, J.Q);
  const Eigen::MatrixXd triangle = s.gls.T.transpose(), part = transposed_product(s.gls.B, J.Q);
  J.V = h;
  solve_lower(triangle, J.V);
  add_scaled(J.V.data(), -1.0, part.data(), part.size());
  solve_lower(s.L, J.Q);
  return J;
}

/// The gradients of the mean and the variance after all levels at one point x of d entries.
inline PredictionGradient cokriging_gradient(const CokrigingLevels& levels, const Eigen::VectorXd& x) {
  LevelViews views;
  std::vector<LevelSlopes> slopes;
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(x.size());
  double below = 0;
  for (std::size_t t = 0; t < levels.size(); ++t) {
    views.push_back(view_of(levels, t, x.transpose(), views));
    slopes.push_back(slopes_of(levels, t, x, {views, slopes}));
    const LevelView& v = views[t];
    const LevelSlopes& J = slopes[t];
    const auto by_square = [](const Eigen::MatrixXd& dA, const Eigen::MatrixXd& a) {
      return transposed_product(dA, Eigen::VectorXd(a.row(0).transpose()));
    };
    const Eigen::VectorXd explained = by_square(J.Q, v.Q), missing = by_square(J.V, v.V),
                          unknown = by_square(J.W, v.W);
    for (Index k = 0; k < x.size(); ++k)
      variance[k] = v.rho[0] * v.rho[0] * variance[k] + 2.0 * v.rho[0] * J.rho[k] * below +
                    2.0 * levels[t].variance() * (missing[k] - explained[k]) + 2.0 * unknown[k];
    below = variance_of(levels, t + 1, views)[0];
  }
  return {slopes.back().mean, variance};
}

}  // namespace drawpoint::kriging::detail
