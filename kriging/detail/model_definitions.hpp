// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What model.hpp declares.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/detail/threads.hpp>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/compiled.hpp>
#include <drawpoint/kriging/detail/parallel.hpp>
#include <drawpoint/kriging/detail/parameter_uncertainty.hpp>
#include <drawpoint/kriging/model.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::kriging {

DRAWPOINT_KRIGING_INLINE Model::Model(detail::ModelState state)
    : s_(std::move(state)), runs_(s_.X.transpose()) {
  stretched_ = runs_;
  for (Eigen::Index j = 0; j < runs_.cols(); ++j)
    for (Eigen::Index k = 0; k < runs_.rows(); ++k) stretched_(k, j) *= std::sqrt(s_.correlation.theta[k]);
  if (s_.other) other_ = std::make_shared<const Model>(*s_.other);
  if (s_.X.rows() == 0) return;
  triangle_ = s_.gls.T.transpose();
  effects_ = detail::parameter_effects(s_);
}

DRAWPOINT_KRIGING_INLINE Prediction Model::predict(const Eigen::MatrixXd& X, Target target,
                                                   int threads) const {
  check(X);
  if (threads < 0)
    throw std::invalid_argument("kriging::Model: threads is " + std::to_string(threads) +
                                "; allowed is 0 or more; use 0 for all cores");
  threads = doe::detail::thread_count(threads);
  Prediction p{Eigen::VectorXd(X.rows()), Eigen::VectorXd(X.rows())};
  detail::for_each_task(static_cast<int>((X.rows() + block - 1) / block), threads, [&](int b) {
    const Eigen::Index i = b * block, count = std::min(block, X.rows() - i);
    const Eigen::MatrixXd points = X.middleRows(i, count), scaled = s_.input.apply(points);
    const Eigen::VectorXd mean = mean_of(points, scaled), variance = variance_of(points, scaled);
    std::copy(mean.begin(), mean.end(), p.mean.begin() + i);
    std::copy(variance.begin(), variance.end(), p.variance.begin() + i);
  });
  if (other_) {
    const Eigen::VectorXd squares = squares_by_other(X, p.mean, threads);
    for (Eigen::Index i = 0; i < squares.size(); ++i)
      p.variance[i] += s_.doubt * std::max(0.0, squares[i] - p.variance[i]);
  }
  if (target == Target::observation)
    p.variance = detail::affine(p.variance, 1.0, (1.0 - s_.doubt) * noise_variance());
  return p;
}

DRAWPOINT_KRIGING_INLINE Eigen::VectorXd Model::squares_by_other(const Eigen::MatrixXd& X,
                                                                 const Eigen::VectorXd& mean,
                                                                 int threads) const {
  const Prediction other = other_->predict(X, Target::latent, threads);
  Eigen::VectorXd squares(mean.size());
  for (Eigen::Index i = 0; i < squares.size(); ++i) {
    const double apart = other.mean[i] - mean[i];
    squares[i] = other.variance[i] + apart * apart;
  }
  return squares;
}

DRAWPOINT_KRIGING_INLINE Eigen::VectorXd Model::mean(const Eigen::MatrixXd& X) const {
  check(X);
  Eigen::VectorXd mean(X.rows());
  for (Eigen::Index i = 0; i < X.rows(); i += block) {
    const Eigen::MatrixXd points = X.middleRows(i, std::min(block, X.rows() - i));
    const Eigen::VectorXd part = mean_of(points, s_.input.apply(points));
    std::copy(part.begin(), part.end(), mean.begin() + i);
  }
  return mean;
}

DRAWPOINT_KRIGING_INLINE PredictionGradient Model::gradient(const Eigen::VectorXd& x) const {
  check(x.transpose());
  PredictionGradient g{Eigen::VectorXd::Zero(x.size()), Eigen::VectorXd::Zero(x.size())};
  if (s_.X.rows() == 0) return g;
  const SlopesAt at = slopes_at(x);
  g.mean = mean_slope(at);
  // v = T⁻ᵀu and its derivatives; R⁻¹r = L⁻ᵀL⁻¹r.
  Eigen::VectorXd v = at.trend, w = at.r;
  Eigen::MatrixXd dv = at.trend_slopes;
  detail::solve_lower(triangle_, v);
  v = detail::difference(v, detail::transposed_product(s_.gls.B, at.r));
  detail::solve_lower(triangle_, dv);
  const Eigen::MatrixXd BJ = detail::transposed_product(s_.gls.B, at.slopes);
  detail::add_scaled(dv.data(), -1.0, BJ.data(), dv.size());
  detail::solve_lower(s_.L, w);
  detail::solve_lower_transposed(s_.L, w);
  g.variance =
      detail::difference(detail::transposed_product(dv, v), detail::transposed_product(at.slopes, w));
  g.variance = detail::affine(g.variance, 2.0 * process_variance());
  if (!effects_.none()) add_parameter_slopes(at, g.variance);
  if (other_) add_doubt(x, g);
  return g;
}

// Where the other explanation expects less, it adds nothing.
DRAWPOINT_KRIGING_INLINE void Model::add_doubt(const Eigen::VectorXd& x, PredictionGradient& g) const {
  const Eigen::MatrixXd X = x.transpose(), scaled = s_.input.apply(X);
  const double mean = mean_of(X, scaled)[0], variance = variance_of(X, scaled)[0];
  const Prediction other = other_->predict(X);
  const double apart = other.mean[0] - mean;
  if (other.variance[0] + apart * apart <= variance) return;
  const PredictionGradient by_other = other_->gradient(x);
  for (Eigen::Index k = 0; k < g.variance.size(); ++k)
    g.variance[k] +=
        s_.doubt * (by_other.variance[k] + 2.0 * apart * (by_other.mean[k] - g.mean[k]) - g.variance[k]);
}

DRAWPOINT_KRIGING_INLINE Eigen::VectorXd Model::mean_gradient(const Eigen::VectorXd& x) const {
  check(x.transpose());
  if (s_.X.rows() == 0) return Eigen::VectorXd::Zero(x.size());
  return mean_slope(slopes_at(x));
}

DRAWPOINT_KRIGING_INLINE Eigen::MatrixXd Model::covariance(const Eigen::MatrixXd& X) const {
  check(X);
  if (s_.X.rows() == 0) return detail::scaled_identity(X.rows(), s_.constant_variance);
  const Eigen::MatrixXd scaled = s_.input.apply(X);
  Eigen::MatrixXd R = correlations(scaled), C;
  const Eigen::MatrixXd F = detail::trend_matrix(s_.trend, X, scaled, s_.input);
  const Eigen::MatrixXd W = parameter_part(scaled, R, F);
  Eigen::MatrixXd V = trend_part(F, R);
  detail::solve_right(detail::block_of(s_.L), detail::block_of(R));
  fill_correlation(scaled, s_.correlation, C);
  detail::add_product(detail::block_of(V), detail::block_of(V), 1.0, detail::block_of(C),
                      detail::Part::lower);
  detail::add_product(detail::block_of(R), detail::block_of(R), -1.0, detail::block_of(C),
                      detail::Part::lower);
  for (double& entry : C.reshaped()) entry *= process_variance();
  detail::add_product(detail::block_of(W), detail::block_of(W), 1.0, detail::block_of(C),
                      detail::Part::lower);
  detail::mirror_lower(C);
  if (other_) add_doubt(X, C);
  return C;
}

// C + D E D, E what the other explanation expects of products of errors, D diagonal: variances come out as of
// predict().
DRAWPOINT_KRIGING_INLINE void Model::add_doubt(const Eigen::MatrixXd& X, Eigen::MatrixXd& C) const {
  const Eigen::VectorXd apart = detail::difference(other_->mean(X), mean(X));
  Eigen::MatrixXd E = other_->covariance(X);
  for (Eigen::Index j = 0; j < E.cols(); ++j)
    for (Eigen::Index i = 0; i < E.rows(); ++i) E(i, j) += apart[i] * apart[j];
  Eigen::VectorXd share(C.rows());
  for (Eigen::Index i = 0; i < share.size(); ++i)
    share[i] = E(i, i) > C(i, i) ? std::sqrt(s_.doubt * (E(i, i) - C(i, i)) / E(i, i)) : 0.0;
  for (Eigen::Index j = 0; j < E.cols(); ++j)
    for (Eigen::Index i = 0; i < E.rows(); ++i) C(i, j) += share[i] * share[j] * E(i, j);
}

DRAWPOINT_KRIGING_INLINE void Model::check(const Eigen::MatrixXd& X) const {
  if (X.cols() != variables())
    throw std::invalid_argument("kriging::Model: X has " + std::to_string(X.cols()) +
                                " columns; the model has " + std::to_string(variables()) +
                                " variables; give one point per row");
  if (!detail::all_finite(X))
    throw std::invalid_argument(
        "kriging::Model: X holds a number that is not finite; allowed are finite numbers; remove the "
        "point");
  detail::require_levels("kriging::Model", X, s_.correlation.levels);
}

DRAWPOINT_KRIGING_INLINE Eigen::MatrixXd Model::correlations(const Eigen::MatrixXd& scaled) const {
  Eigen::MatrixXd R(scaled.rows(), s_.X.rows());
  for (Eigen::Index j = 0; j < R.cols(); ++j)
    detail::correlate(s_.correlation, {scaled, 0, scaled.rows(), &runs_(0, j)}, &R(0, j));
  return R;
}

DRAWPOINT_KRIGING_INLINE Model::SlopesAt Model::slopes_at(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd scaled = s_.input.apply(x.transpose()).transpose();
  Eigen::VectorXd half_range = s_.input.half_range();
  for (Eigen::Index k = 0; k < half_range.size(); ++k)
    if (detail::is_category(s_.correlation.levels, k)) half_range[k] = 0.0;  // no slope of the trend
  const detail::TrendPoint point{x, scaled, half_range};
  SlopesAt at{scaled,
              cross_correlation(s_.X, scaled.transpose(), s_.correlation).col(0),
              s_.trend.values(point),
              {},
              s_.trend.jacobian(point)};
  at.slopes = slopes_of(at.r, scaled);
  return at;
}

DRAWPOINT_KRIGING_INLINE Eigen::VectorXd Model::mean_slope(const SlopesAt& at) const {
  Eigen::VectorXd slope = detail::transposed_product(at.slopes, s_.gls.alpha);
  const Eigen::VectorXd by_trend = detail::transposed_product(at.trend_slopes, s_.gls.beta);
  detail::add_scaled(slope.data(), 1.0, by_trend.data(), slope.size());
  return detail::affine(slope, s_.y_scale);
}

DRAWPOINT_KRIGING_INLINE Eigen::MatrixXd Model::slopes_of(const Eigen::VectorXd& r,
                                                          const Eigen::VectorXd& scaled) const {
  const bool sum = s_.correlation.structure == Structure::additive;
  Eigen::MatrixXd J(r.size(), scaled.size());
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const Eigen::VectorXd c = sum ? detail::summands(s_.correlation, k, s_.X, scaled) : r;
    for (Eigen::Index i = 0; i < J.rows(); ++i)
      J(i, k) = c[i] * s_.input.factor[k] * detail::slope_in_place(s_.correlation, k, scaled[k] - s_.X(i, k));
  }
  return J;
}

DRAWPOINT_KRIGING_INLINE Eigen::VectorXd Model::mean_of(const Eigen::MatrixXd& X,
                                                        const Eigen::MatrixXd& scaled) const {
  if (s_.X.rows() == 0) return Eigen::VectorXd::Constant(X.rows(), s_.y_centre);
  const bool of_distances = s_.correlation.family == Correlation::gaussian && s_.correlation.levels.empty() &&
                            s_.correlation.structure != Structure::additive;
  Eigen::VectorXd m =
      of_distances ? gaussian_sums(scaled) : detail::product(correlations(scaled), s_.gls.alpha);
  if (s_.trend.is_constant()) {
    m = detail::affine(m, 1.0, s_.gls.beta[0]);
  } else {
    const Eigen::MatrixXd F = detail::trend_matrix(s_.trend, X, scaled, s_.input);
    detail::add_product(m.data(), 1.0, F, s_.gls.beta.data());
  }
  return detail::affine(m, s_.y_scale, s_.y_centre);
}

DRAWPOINT_KRIGING_INLINE Eigen::VectorXd Model::gaussian_sums(const Eigen::MatrixXd& scaled) const {
  constexpr Eigen::Index step = detail::points_at_once;
  const Eigen::Index m = scaled.rows();
  const Eigen::VectorXd& theta = s_.correlation.theta;
  const detail::GaussianRuns runs{stretched_.data(), s_.gls.alpha.data(), s_.X.rows(), scaled.cols()};
  Eigen::VectorXd sums(m);
  Eigen::MatrixXd z(step, scaled.cols());
  for (Eigen::Index i = 0; i < m; i += step) {
    for (Eigen::Index k = 0; k < z.cols(); ++k)
      for (Eigen::Index a = 0; a < step; ++a)
        z(a, k) = scaled(std::min(i + a, m - 1), k) * std::sqrt(theta[k]);
    double out[step];
    detail::gaussian_sums(runs, z.data(), out);
    std::copy(out, out + std::min(step, m - i), sums.data() + i);
  }
  return sums;
}

DRAWPOINT_KRIGING_INLINE Eigen::MatrixXd Model::trend_part(Eigen::MatrixXd F,
                                                           const Eigen::MatrixXd& R) const {
  detail::solve_right(detail::block_of(triangle_), detail::block_of(F));
  for (Eigen::Index j = 0; j < F.cols(); ++j)
    detail::add_product(detail::column(F, j), -1.0, R, detail::column(s_.gls.B, j));
  return F;
}

DRAWPOINT_KRIGING_INLINE Eigen::MatrixXd Model::parameter_part(const Eigen::MatrixXd& scaled,
                                                               const Eigen::MatrixXd& R,
                                                               const Eigen::MatrixXd& F) const {
  if (effects_.none()) return Eigen::MatrixXd::Zero(scaled.rows(), 1);
  Eigen::MatrixXd W = detail::mean_deviations(s_, effects_, {scaled, R, F});
  for (double& entry : W.reshaped()) entry *= s_.y_scale;
  return W;
}

DRAWPOINT_KRIGING_INLINE void Model::add_parameter_slopes(const SlopesAt& at, Eigen::VectorXd& slope) const {
  const Eigen::MatrixXd scaled = at.scaled.transpose(), R = at.r.transpose(), F = at.trend.transpose();
  const Eigen::VectorXd w = parameter_part(scaled, R, F).transpose();
  const Eigen::MatrixXd dw =
      detail::mean_deviation_slopes(s_, effects_, {at.scaled, at.r, at.slopes, at.trend_slopes});
  detail::add_scaled(slope.data(), 2.0 * s_.y_scale, detail::transposed_product(dw, w).data(), slope.size());
}

DRAWPOINT_KRIGING_INLINE Eigen::VectorXd Model::variance_of(const Eigen::MatrixXd& X,
                                                            const Eigen::MatrixXd& scaled) const {
  if (s_.X.rows() == 0) return Eigen::VectorXd::Constant(X.rows(), s_.constant_variance);
  Eigen::MatrixXd R = correlations(scaled);
  const Eigen::MatrixXd F = detail::trend_matrix(s_.trend, X, scaled, s_.input);
  const Eigen::VectorXd unknown = detail::row_squares(parameter_part(scaled, R, F));
  const Eigen::VectorXd missing = detail::row_squares(trend_part(F, R));
  detail::solve_right(detail::block_of(s_.L), detail::block_of(R));
  Eigen::VectorXd variance = detail::row_squares(R);  // explained
  // Round-off may leave a small negative number at a run.
  for (Eigen::Index i = 0; i < variance.size(); ++i)
    variance[i] = process_variance() * std::max(1.0 - variance[i] + missing[i], 0.0) + unknown[i];
  return variance;
}

}  // namespace drawpoint::kriging
