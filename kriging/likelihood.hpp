// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The concentrated log likelihood of regression Kriging, its gradient and its Hessian.
///
///   R = C(θ) + λ I,  μ = 1ᵀR⁻¹y / 1ᵀR⁻¹1,  α = R⁻¹(y − 1μ),  s² = (y − 1μ)ᵀα / n
///   LL(p) = −n/2 ln(2π s²) − ½ ln|R| − n/2,  p = (ln θ₁ .. ln θ_d, ln λ)
///   ∂LL/∂pₐ = ½ Σᵢⱼ Mᵢⱼ (Rₐ)ᵢⱼ,  M = ααᵀ/s² − R⁻¹,  Rₐ = ∂R/∂pₐ
///   ∂²LL/∂pₐ∂p_b = ½ Σᵢⱼ Mᵢⱼ (R_ab)ᵢⱼ − αᵀRₐ P R_b α/s² + qₐq_b/(2n s⁴) + ½ tr(R⁻¹Rₐ R⁻¹R_b)
/// with qₐ = −αᵀRₐα and P = R⁻¹ − R⁻¹1 1ᵀR⁻¹/(1ᵀR⁻¹1).
///
/// Cost: value n³/3, gradient n³, Hessian about 3d n³ more; O(n²) memory whatever d is: derivatives of R are
/// summed as they are computed and never stored together. Where R is not numerically positive definite the
/// value is −∞. Source: Forrester, Sóbester, Keane 2008, section 2.4 and chapter 6; the derivatives are those
/// of Mardia, Marshall 1984, Biometrika 71, "Maximum likelihood estimation of models for residual covariance
/// in spatial regression".

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <drawpoint/kriging/cholesky.hpp>
#include <drawpoint/kriging/correlation.hpp>

namespace drawpoint::kriging {

/// Estimates that follow from θ and λ.
struct Concentrated {
  double trend = 0;             ///< μ, unit of y
  double process_variance = 0;  ///< s², unit of y squared
  double log_likelihood = -std::numeric_limits<double>::infinity();
};

/// Remembers the last point, so that value, gradient and Hessian at one p share their factorisation. Not for
/// concurrent use; copies are independent.
class Likelihood {
  // (xᵢₖ − xⱼₖ)² for i ≥ j; above the public part because its type is deduced.
  auto squares(Eigen::Index j, Eigen::Index k) const {
    return (X_.col(k).tail(runs() - j).array() - X_(j, k)).square();
  }

 public:
  /// X: n x d on [-1, 1], y: n.
  Likelihood(Eigen::MatrixXd X, Eigen::VectorXd y) : X_(std::move(X)), y_(std::move(y)) {}

  Eigen::Index runs() const { return X_.rows(); }
  Eigen::Index parameters() const { return X_.cols() + 1; }

  /// Number of matrices factored so far.
  int factorizations() const { return factorizations_; }

  /// LL(p), or −∞ where R is not numerically positive definite.
  double value(const Eigen::VectorXd& p) {
    factor(p);
    return estimates_.log_likelihood;
  }

  /// d + 1 entries; zero where the value is −∞.
  Eigen::VectorXd gradient(const Eigen::VectorXd& p) {
    if (!invert(p)) return Eigen::VectorXd::Zero(parameters());
    Eigen::VectorXd g = Eigen::VectorXd::Zero(parameters());
    const Eigen::Index n = runs(), d = X_.cols();
    for (Eigen::Index j = 0; j < n; ++j) {
      weigh(j);
      for (Eigen::Index k = 0; k < d; ++k)
        g[k] -= theta_[k] * (weight_.tail(n - j).array() * squares(j, k)).sum();
    }
    g[d] = 0.5 * nugget_ * (alpha_.squaredNorm() / estimates_.process_variance - K_.diagonal().sum());
    return g;
  }

  /// (d + 1) x (d + 1), symmetric; zero where the value is −∞.
  Eigen::MatrixXd hessian(const Eigen::VectorXd& p) {
    const Eigen::Index m = parameters();
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(m, m);
    const Eigen::VectorXd g = gradient(p);
    if (!std::isfinite(estimates_.log_likelihood)) return H;
    K_.triangularView<Eigen::StrictlyUpper>() = K_.transpose();
    add_second_derivatives(g, H);
    add_traces(H);
    add_trend_and_scale(H);
    H.triangularView<Eigen::StrictlyUpper>() = H.transpose();
    return H;
  }

  /// The expected value of −∂²LL/∂p∂p: (d + 1) x (d + 1), symmetric and positive semidefinite, with μ and s²
  /// estimated: Fₐ_b = ½ tr(R⁻¹Rₐ R⁻¹R_b) − tr(R⁻¹Rₐ) tr(R⁻¹R_b)/(2n). Zero where the value is −∞.
  Eigen::MatrixXd fisher(const Eigen::VectorXd& p) {
    const Eigen::Index m = parameters();
    Eigen::MatrixXd F = Eigen::MatrixXd::Zero(m, m);
    if (!invert(p)) return F;
    K_.triangularView<Eigen::StrictlyUpper>() = K_.transpose();
    add_traces(F);
    Eigen::VectorXd t(m);
    for (Eigen::Index a = 0; a + 1 < m; ++a) t[a] = 2.0 * trace_with_derivative(K_, a);
    t[m - 1] = nugget_ * K_.diagonal().sum();
    F.triangularView<Eigen::Lower>() -= t * t.transpose() / (2.0 * runs());
    F.triangularView<Eigen::StrictlyUpper>() = F.transpose();
    return F;
  }

  // What belongs to the last p with a finite value.
  const Concentrated& estimates() const { return estimates_; }
  const Eigen::VectorXd& theta() const { return theta_; }
  double nugget() const { return nugget_; }
  const Eigen::VectorXd& weights() const { return alpha_; }        ///< α
  const Eigen::VectorXd& weights_of_one() const { return beta_; }  ///< R⁻¹1
  Eigen::MatrixXd cholesky() const { return llt_.matrixL(); }
  double condition() const { return 1.0 / llt_.rcond(); }  ///< estimate in the 1-norm

 private:
  bool factor(const Eigen::VectorXd& p) {
    if (p_.size() == p.size() && p_ == p) return std::isfinite(estimates_.log_likelihood);
    p_ = p;
    inverted_ = false;
    estimates_ = {};
    theta_ = p.head(X_.cols()).array().exp();
    nugget_ = std::exp(p[X_.cols()]);
    fill_correlation(X_, theta_, C_);
    K_ = C_;
    K_.diagonal().array() += nugget_;
    ++factorizations_;
    llt_.compute(K_);
    return llt_.info() == Eigen::Success && estimate();
  }

  bool estimate() {
    const double n = static_cast<double>(runs());
    beta_ = llt_.solve(Eigen::VectorXd::Ones(runs()));
    const double trend = beta_.dot(y_) / beta_.sum();
    const Eigen::VectorXd residual = y_.array() - trend;
    alpha_ = llt_.solve(residual);
    const double variance = residual.dot(alpha_) / n;
    const double log_determinant = 2.0 * llt_.matrixLLT().diagonal().array().log().sum();
    const double value =
        -0.5 * n * std::log(2.0 * std::numbers::pi * variance) - 0.5 * log_determinant - 0.5 * n;
    if (!(beta_.sum() > 0) || !(variance > 0) || !std::isfinite(value)) return false;
    estimates_ = {trend, variance, value};
    return true;
  }

  bool invert(const Eigen::VectorXd& p) {
    if (!factor(p)) return false;
    if (!inverted_) detail::inverse_from_cholesky(llt_.matrixLLT(), K_);
    inverted_ = true;
    return true;
  }

  // weight_ from row j on: column j of M∘C.
  void weigh(Eigen::Index j) {
    const Eigen::Index m = runs() - j;
    weight_.resize(runs());
    weight_.tail(m) = (alpha_.tail(m) * (alpha_[j] / estimates_.process_variance) - K_.col(j).tail(m))
                          .cwiseProduct(C_.col(j).tail(m));
  }

  // ½ Σ M R_ab, lower triangle.
  void add_second_derivatives(const Eigen::VectorXd& g, Eigen::MatrixXd& H) {
    const Eigen::Index n = runs(), d = X_.cols();
    for (Eigen::Index j = 0; j < n; ++j) {
      weigh(j);
      for (Eigen::Index a = 0; a < d; ++a)
        for (Eigen::Index b = 0; b <= a; ++b)
          H(a, b) +=
              theta_[a] * theta_[b] * (weight_.tail(n - j).array() * squares(j, a) * squares(j, b)).sum();
    }
    H.diagonal() += g;
  }

  // Rₐ of a θ: n x n.
  void fill_derivative(Eigen::Index a, Eigen::MatrixXd& D) const {
    const Eigen::Index n = runs();
    D.resize(n, n);
    for (Eigen::Index j = 0; j < n; ++j)
      D.col(j).tail(n - j) = -theta_[a] * C_.col(j).tail(n - j).array() * squares(j, a);
    D.triangularView<Eigen::StrictlyUpper>() = D.transpose();
  }

  // ½ tr(K Rₐ K R_b), lower triangle.
  void add_traces(Eigen::MatrixXd& H) const {
    const Eigen::Index d = X_.cols();
    Eigen::MatrixXd D, W, V;
    for (Eigen::Index a = 0; a < d; ++a) {
      fill_derivative(a, D);
      W.noalias() = K_ * D;
      H(a, a) += 0.5 * W.cwiseProduct(W.transpose()).sum();
      H(d, a) += 0.5 * nugget_ * W.cwiseProduct(K_).sum();
      if (a + 1 == d) continue;
      V.noalias() = W * K_;
      for (Eigen::Index b = a + 1; b < d; ++b) H(b, a) += trace_with_derivative(V, b);
    }
    H(d, d) += 0.5 * nugget_ * nugget_ * K_.squaredNorm();
  }

  // ½ Σ V R_b for symmetric V.
  double trace_with_derivative(const Eigen::MatrixXd& V, Eigen::Index b) const {
    double sum = 0;
    for (Eigen::Index j = 0; j < runs(); ++j) {
      const Eigen::Index m = runs() - j;
      sum -= (V.col(j).tail(m).array() * C_.col(j).tail(m).array() * squares(j, b)).sum();
    }
    return theta_[b] * sum;
  }

  // −αᵀRₐ P R_b α/s² + qₐq_b/(2n s⁴), lower triangle.
  void add_trend_and_scale(Eigen::MatrixXd& H) const {
    const Eigen::Index d = X_.cols();
    const double s2 = estimates_.process_variance;
    Eigen::MatrixXd U(runs(), d + 1), D;
    for (Eigen::Index a = 0; a < d; ++a) {
      fill_derivative(a, D);
      U.col(a).noalias() = D * alpha_;
    }
    U.col(d) = nugget_ * alpha_;
    const Eigen::VectorXd q = U.transpose() * alpha_, t = U.transpose() * beta_;
    const Eigen::MatrixXd PU = K_ * U - beta_ * (t.transpose() / beta_.sum());
    H.triangularView<Eigen::Lower>() +=
        q * q.transpose() / (2.0 * runs() * s2 * s2) - U.transpose() * PU / s2;
  }

  Eigen::MatrixXd X_;
  Eigen::VectorXd y_;
  Eigen::VectorXd p_, theta_, alpha_, beta_, weight_;
  double nugget_ = 0;
  Concentrated estimates_;
  Eigen::MatrixXd C_, K_;
  Eigen::LLT<Eigen::MatrixXd> llt_;
  bool inverted_ = false;
  int factorizations_ = 0;
};

}  // namespace drawpoint::kriging
