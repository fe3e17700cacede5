// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Covariances of the latent function at any points with those at a few fixed ones.
///
/// They are those of Model::covariance by one explanation of the runs, with R⁻¹r of the fixed points Z solved for once:
///   s²(x, z) = s² [c(x, z) − rₓᵀ(R⁻¹r_z) + uₓᵀ(FᵀR⁻¹F)⁻¹u_z] + gₓᵀV g_z
/// Cost p n² for p fixed points, then n (p + q) per point.

#include <Eigen/Core>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/parameter_uncertainty.hpp>
#include <drawpoint/kriging/model.hpp>
#include <memory>
#include <utility>

namespace drawpoint::kriging::detail {

class CovarianceWith {
 public:
  /// Z: p x d, natural units.
  CovarianceWith(std::shared_ptr<const Model> model, const Eigen::MatrixXd& Z) : model_(std::move(model)) {
    const ModelState& s = model_->state();
    scaled_ = s.input.apply(Z);
    if (s.X.rows() == 0) return;
    effects_ = parameter_effects(s);
    const Points at = points(Z);
    V_ = trend_part(at);
    W_ = parameter_part(at);
    solved_ = at.R.transpose();
    solve_lower(s.L, solved_);
    solve_lower_transposed(s.L, solved_);
  }

  /// X: m x d, natural units. Gives m x p, unit of y squared.
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& X) const {
    const ModelState& s = model_->state();
    // The model is a constant: no point says anything about another.
    if (s.X.rows() == 0) return Eigen::MatrixXd::Zero(X.rows(), scaled_.rows());
    const Points at = points(X);
    const Eigen::MatrixXd V = trend_part(at), W = parameter_part(at);
    Eigen::MatrixXd C = cross_correlation(at.scaled, scaled_, s.correlation);
    for (Index j = 0; j < C.cols(); ++j) {
      add_product(column(C, j), -1.0, at.R, column(solved_, j));
      add_product(column(C, j), 1.0, V, Eigen::VectorXd(V_.row(j)).data());
      for (Index i = 0; i < C.rows(); ++i) C(i, j) *= model_->process_variance();
      add_product(column(C, j), s.y_scale * s.y_scale, W, Eigen::VectorXd(W_.row(j)).data());
    }
    return C;
  }

 private:
  struct Points {
    Eigen::MatrixXd scaled, R, F;  // m x d, m x n, m x q
  };

  Points points(const Eigen::MatrixXd& X) const {
    const ModelState& s = model_->state();
    const Eigen::MatrixXd scaled = s.input.apply(X);
    return {scaled, cross_correlation(scaled, s.X, s.correlation), trend_matrix(s.trend, X, scaled, s.input)};
  }

  /// Rows T⁻ᵀu: m x q.
  Eigen::MatrixXd trend_part(const Points& at) const {
    const ModelState& s = model_->state();
    Eigen::MatrixXd V = at.F.transpose();
    solve_lower(s.gls.T.transpose(), V);
    V.transposeInPlace();
    for (Index j = 0; j < V.cols(); ++j) add_product(column(V, j), -1.0, at.R, column(s.gls.B, j));
    return V;
  }

  /// Rows Sᵀg, standardised: m x k.
  Eigen::MatrixXd parameter_part(const Points& at) const {
    if (effects_.none()) return Eigen::MatrixXd::Zero(at.R.rows(), 0);
    return mean_deviations(model_->state(), effects_, {at.scaled, at.R, at.F});
  }

  std::shared_ptr<const Model> model_;
  ParameterEffects effects_;
  Eigen::MatrixXd scaled_, solved_, V_, W_;  // p x d, n x p, p x q, p x k
};

}  // namespace drawpoint::kriging::detail
