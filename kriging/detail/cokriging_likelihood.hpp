// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The restricted log likelihood of one level's runs, given the runs of the levels below.
///
///   K = G + s² (C(θ) + λ diag(w)),  LL = −½ ln|K| − ½ ln|HᵀK⁻¹H| − ½ (y − Hβ)ᵀα,  α = K⁻¹(y − Hβ) = P y
///   ∂LL/∂a = ½ Σᵢⱼ (ααᵀ − P)ᵢⱼ (∂K/∂a)ᵢⱼ
/// up to a constant, with G = D S(X, X) D of cokriging_level.hpp held fixed, and ln π(θ, λ) of prior.hpp
/// where a fit is penalised. Parameters: ln θ, ln s², ln λ; known noise ties λ = τ²/s². It is restricted
/// (REML) because true runs are few: s² = S/n would be too small by the share q/n that estimating ρ and β
/// takes, a half for 4 runs. Le Gratiet and Garnier divide by n − q for the same reason. Cost: value n³/3,
/// gradient n³.

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/least_squares.hpp>
#include <drawpoint/kriging/detail/prior.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// Standardised. X: n x d, H: n x q, G: n x n.
struct CokrigingProblem {
  Eigen::MatrixXd X, H, G;
  Eigen::VectorXd y;
  CorrelationFunction correlation;  ///< its exponents are kept
  Eigen::VectorXd noise;            ///< w, n entries; empty: all 1
  double known_noise = 0;           ///< τ²; 0: λ is estimated
  std::optional<JointlyRobustPrior> prior;
};

class CokrigingLikelihood {
 public:
  explicit CokrigingLikelihood(CokrigingProblem problem) : in_(std::move(problem)), f_(in_.correlation) {
    if (in_.noise.size() > 0 || in_.known_noise > 0) floor_ = noise_floor;
    if (in_.noise.size() == 0) in_.noise = Eigen::VectorXd::Ones(in_.y.size());
  }

  /// p: ln θ, ln s², ln λ. −∞ where K is not numerically positive definite.
  double value(const Eigen::VectorXd& p) {
    set(p);
    L_ = C_;
    for (double& entry : L_.reshaped()) entry *= variance_;
    for (Index i = 0; i < L_.rows(); ++i) L_(i, i) += variance_ * (nugget_ * in_.noise[i] + floor_);
    add_scaled(L_.data(), 1.0, in_.G.data(), L_.size());
    valid_ = factor(block_of(L_), 1);
    if (!valid_) return -std::numeric_limits<double>::infinity();
    clear_upper(L_);
    gls_ = least_squares(L_, in_.H, in_.y);
    double value = -0.5 * gls_.sum_of_squares + (in_.prior ? in_.prior->value(of_prior(p)) : 0.0);
    for (Index i = 0; i < L_.rows(); ++i) value -= std::log(L_(i, i));
    for (Index i = 0; i < gls_.T.rows(); ++i) value -= std::log(std::abs(gls_.T(i, i)));
    return value;
  }

  /// Zero where the value is −∞.
  Eigen::VectorXd gradient(const Eigen::VectorXd& p) {
    value(p);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(p.size());
    if (!valid_) return g;
    const Index d = f_.theta.size(), n = in_.y.size();
    const Eigen::MatrixXd M = sensitivity();
    for (Index j = 0; j < n; ++j) {
      const double own = 0.5 * M(j, j) * variance_, by_noise = own * nugget_ * in_.noise[j];
      g[d] += own * (1.0 + floor_) + (in_.known_noise > 0 ? 0.0 : by_noise);
      g[d + 1] += in_.known_noise > 0 ? 0.0 : by_noise;
      for (Index i = j + 1; i < n; ++i) {
        const double weight = M(i, j) * variance_ * C_(i, j);
        g[d] += weight;
        Chunk h(1);
        for (Index k = 0; k < d; ++k) {
          h.number[0] = distance_between(f_.levels, k, in_.X(i, k), in_.X(j, k));
          g[k] += weight * slope_in_theta(f_, k, h)[0];
        }
      }
    }
    if (in_.prior) add_prior(p, g);
    return g;
  }

  /// The least-squares estimates at the last p with a finite value; variance() and nugget() are those of the last p.
  const LeastSquares& estimates() const { return gls_; }
  double variance() const { return variance_; }
  double nugget() const { return nugget_; }

 private:
  void set(const Eigen::VectorXd& p) {
    const Index d = f_.theta.size();
    for (Index k = 0; k < d; ++k) f_.theta[k] = std::exp(p[k]);
    variance_ = std::exp(p[d]);
    nugget_ = in_.known_noise > 0 ? in_.known_noise / variance_ : std::exp(p[d + 1]);
    fill_correlation(in_.X, f_, C_);
    mirror_lower(C_);
  }

  // ααᵀ − P, P = K⁻¹ − B Bᵀ.
  Eigen::MatrixXd sensitivity() {
    Eigen::MatrixXd inverse, M;
    inverse_transposed(L_, inverse);
    product_of_upper(inverse, M);
    mirror_lower(M);
    for (double& entry : M.reshaped()) entry = -entry;
    for (Index j = 0; j < gls_.B.cols(); ++j) add_outer(M, 1.0, gls_.B.col(j), gls_.B.col(j));
    add_outer(M, 1.0, gls_.alpha, gls_.alpha);
    return M;
  }

  // (ln θ, ln λ), which the prior is of.
  Eigen::VectorXd of_prior(const Eigen::VectorXd& p) const {
    const Index d = f_.theta.size();
    Eigen::VectorXd q(d + 1);
    for (Index k = 0; k < d; ++k) q[k] = p[k];
    q[d] = std::log(nugget_);
    return q;
  }

  void add_prior(const Eigen::VectorXd& p, Eigen::VectorXd& g) const {
    const Index d = f_.theta.size();
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(d + 1);
    in_.prior->add_gradient(of_prior(p), slope);
    for (Index k = 0; k < d; ++k) g[k] += slope[k];
    if (in_.known_noise == 0) g[d + 1] += slope[d];
  }

  CokrigingProblem in_;
  CorrelationFunction f_;
  double floor_ = 0, variance_ = 1, nugget_ = 0;
  Eigen::MatrixXd C_, L_;
  LeastSquares gls_;
  bool valid_ = false;
};

}  // namespace drawpoint::kriging::detail
