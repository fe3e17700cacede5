// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The concentrated log likelihood of regression Kriging, its gradient, its Hessian and its information, with
/// or without a prior.
///
///   R = C(θ, p) + λ diag(w),  β = (FᵀR⁻¹F)⁻¹FᵀR⁻¹y,  α = R⁻¹(y − Fβ),  S = (y − Fβ)ᵀα
///   LL = −n/2 ln(2π s²) − ½ ln|R| − S/(2s²)
///   ∂LL/∂a = ½ Σᵢⱼ Mᵢⱼ (Rₐ)ᵢⱼ,  M = ααᵀ/s² − R⁻¹,  Rₐ = ∂R/∂a
///   ∂²LL/∂a∂b = ½ Σᵢⱼ Mᵢⱼ (R_ab)ᵢⱼ − αᵀRₐ P R_b α/s² + qₐq_b/(2n s⁴) + ½ tr(R⁻¹Rₐ R⁻¹R_b)
/// with qₐ = −αᵀRₐα, P = R⁻¹ − R⁻¹F(FᵀR⁻¹F)⁻¹FᵀR⁻¹. Parameters: ln θ, the exponents p where they are
/// estimated, ln λ (detail/parameter_places.hpp). s² = S/n is concentrated out. Known noise of mean τ² ties
/// s² = τ²/λ instead: then the derivatives by ln λ gain those through ln s², and the term with qₐq_b is gone.
/// Isotropic, Rₐ of a shared θ is the sum of those of its variables; of a sum, parameters are also the vₖ of
/// its weights. With a prior, value, gradient and Hessian are those of LL + ln π (prior.hpp); the estimates
/// keep LL itself.
///
/// Cost: value n³/3, gradient n³, Hessian about 3 parameters · n³ more; O(n²) memory whatever d is. Where R
/// is not numerically positive definite the value is −∞. Source: Forrester, Sóbester, Keane 2008, section 2.4
/// and chapter 6; derivatives: Mardia, Marshall 1984, Biometrika 71, "Maximum likelihood estimation of models
/// for residual covariance in spatial regression".

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/least_squares.hpp>
#include <drawpoint/kriging/detail/parameter_places.hpp>
#include <drawpoint/kriging/detail/prior.hpp>

namespace drawpoint::kriging {

/// Estimates that follow from θ, p and λ.
struct Concentrated {
  double trend = 0;             ///< β₁, unit of y
  double process_variance = 0;  ///< s², unit of y squared
  double log_likelihood = -std::numeric_limits<double>::infinity();
};

/// What the likelihood is of. X: n x d on [-1, 1], y: n.
struct LikelihoodProblem {
  Eigen::MatrixXd X;
  Eigen::VectorXd y;
  Eigen::MatrixXd F;       ///< n x q, the trend's terms; empty: a column of ones
  Eigen::VectorXd noise;   ///< w, n entries; empty: all 1
  double known_noise = 0;  ///< τ², unit of y squared; 0: s² is estimated
  Correlation family = Correlation::gaussian;
  Eigen::VectorXd exponent;  ///< given p of power_exponential, d entries; empty: parameters
  int threads = 1;
  bool prior = false;            ///< LL + ln π instead of LL
  double nugget_power = 0;       ///< of λ in π
  std::vector<int> levels = {};  ///< of the correlation
  Structure structure = Structure::product;
};

/// Remembers the last point, so that value, gradient and Hessian at one p share their factorisation. Not for
/// concurrent use; copies are independent.
class Likelihood {
 public:
  explicit Likelihood(LikelihoodProblem problem) : in_(std::move(problem)), points_(in_.X.transpose()) {
    if (in_.F.size() == 0) in_.F = Eigen::MatrixXd::Ones(runs(), 1);
    f_.family = in_.family;
    f_.exponent = in_.exponent;
    f_.levels = in_.levels;
    f_.structure = in_.structure;
    places_ = detail::parameter_places(
        f_, variables(), in_.family == Correlation::power_exponential && in_.exponent.size() == 0);
    if (places_.weights) weight_prior_.emplace(places_.weight(0), varying(), in_.prior);
    if (in_.prior)
      prior_.emplace(detail::spacing_of(f_, places_, runs(), varying()), in_.known_noise == 0,
                     in_.nugget_power);
  }

  /// Gaussian correlation, constant trend, the same noise everywhere.
  Likelihood(Eigen::MatrixXd X, Eigen::VectorXd y) : Likelihood(with(std::move(X), std::move(y))) {}

  Eigen::Index runs() const { return in_.X.rows(); }
  Eigen::Index variables() const { return in_.X.cols(); }
  bool estimates_exponents() const { return places_.exponents; }
  Eigen::Index parameters() const { return places_.count(); }
  const detail::ParameterPlaces& places() const { return places_; }
  const LikelihoodProblem& problem() const { return in_; }

  /// Number of matrices factored so far.
  int factorizations() const { return factorizations_; }

  /// LL(p), with ln π where a prior is asked for and with what holds the weights of a sum, or −∞ where R is
  /// not numerically positive definite.
  double value(const Eigen::VectorXd& p) {
    factor(p);
    return estimates_.log_likelihood + (prior_ ? prior_->value(p) : 0.0) +
           (weight_prior_ ? weight_prior_->value(p) : 0.0);
  }

  /// One entry a parameter; zero where the value is −∞.
  Eigen::VectorXd gradient(const Eigen::VectorXd& p) {
    if (!invert(p)) return Eigen::VectorXd::Zero(parameters());
    const Eigen::Index n = runs(), last = parameters() - 1;
    Eigen::VectorXd g = correlation_slopes();
    const double s2 = estimates_.process_variance;
    g[last] = slope_in_nugget();
    if (in_.known_noise > 0) g[last] += 0.5 * static_cast<double>(n) - 0.5 * gls_.sum_of_squares / s2;
    if (prior_) prior_->add_gradient(p, g);
    if (weight_prior_) weight_prior_->add_gradient(p, g);
    return g;
  }

  /// Symmetric, one row a parameter; zero where the value is −∞.
  Eigen::MatrixXd hessian(const Eigen::VectorXd& p);

  /// The expected value of −∂²LL/∂p∂p, symmetric and positive semidefinite: Fₐ_b = ½ tr(R⁻¹Rₐ R⁻¹R_b) −
  /// tr(R⁻¹Rₐ) tr(R⁻¹R_b)/(2n) with s² estimated; with s² = τ²/λ the first term of s²R. Zero where the value
  /// is −∞.
  Eigen::MatrixXd fisher(const Eigen::VectorXd& p);

  // What belongs to the last p with a finite value.
  const Concentrated& estimates() const { return estimates_; }
  const CorrelationFunction& correlation() const { return f_; }
  const Eigen::VectorXd& theta() const { return f_.theta; }
  double nugget() const { return nugget_; }
  const Eigen::VectorXd& weights() const { return gls_.alpha; }  ///< α
  const detail::LeastSquares& least_squares() const { return gls_; }
  /// Lower triangular, zeros above.
  Eigen::MatrixXd cholesky() const {
    Eigen::MatrixXd L = L_;
    detail::clear_upper(L);
    return L;
  }
  /// Product of the 1-norms of R and R⁻¹; needs the inverse, which costs 2n³/3 if it is not there yet.
  double condition() {
    if (!invert(p_)) return std::numeric_limits<double>::infinity();
    Eigen::MatrixXd R = C_;
    add_noise(R);
    return norm(R) * norm(K_);
  }

 private:
  static LikelihoodProblem with(Eigen::MatrixXd X, Eigen::VectorXd y) {
    LikelihoodProblem problem;
    problem.X = std::move(X);
    problem.y = std::move(y);
    return problem;
  }

  // Inputs of which two runs differ.
  std::vector<bool> varying() const {
    std::vector<bool> varies;
    for (Eigen::Index k = 0; k < variables(); ++k) varies.push_back(!detail::never_varies(in_.X, k));
    return varies;
  }

  double noise_weight(Eigen::Index i) const { return in_.noise.size() ? in_.noise[i] : 1.0; }

  // ∂LL/∂(ln λ) for a given s²: ½ λ Σ wᵢMᵢᵢ.
  double slope_in_nugget() const {
    double sum = 0;
    for (Eigen::Index i = 0; i < runs(); ++i)
      sum += noise_weight(i) * (gls_.alpha[i] * gls_.alpha[i] / estimates_.process_variance - K_(i, i));
    return 0.5 * nugget_ * sum;
  }

  void add_noise(Eigen::MatrixXd& R) const {
    const double floor = in_.noise.size() || in_.known_noise > 0 ? detail::noise_floor : 0.0;
    for (Eigen::Index i = 0; i < runs(); ++i) R(i, i) += nugget_ * noise_weight(i) + floor;
  }

  // 1-norm of the symmetric matrix of which A has the lower triangle.
  static double norm(const Eigen::MatrixXd& A) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(A.rows());
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      sums[j] += std::abs(A(j, j));
      for (Eigen::Index i = j + 1; i < A.rows(); ++i) {
        sums[i] += std::abs(A(i, j));
        sums[j] += std::abs(A(i, j));
      }
    }
    return *std::max_element(sums.begin(), sums.end());
  }

  void set(const Eigen::VectorXd& p) {
    const Eigen::Index d = variables();
    p_ = p;
    inverted_ = false;
    estimates_ = {};
    f_.theta.resize(d);
    for (Eigen::Index k = 0; k < d; ++k) f_.theta[k] = std::exp(p[places_.theta(k)]);
    if (places_.exponents) f_.exponent.resize(d);
    for (Eigen::Index k = 0; places_.exponents && k < d; ++k) f_.exponent[k] = p[places_.exponent(k)];
    if (places_.weights) set_weights(p);
    nugget_ = std::exp(p[p.size() - 1]);
  }

  bool factor(const Eigen::VectorXd& p) {
    if (p_.size() == p.size() && p_ == p) return std::isfinite(estimates_.log_likelihood);
    set(p);
    fill_correlation(in_.X, f_, C_, in_.threads);
    L_ = C_;
    add_noise(L_);
    ++factorizations_;
    return detail::factor(detail::block_of(L_), in_.threads) && estimate();
  }

  bool estimate() {
    const double n = static_cast<double>(runs());
    gls_ = detail::least_squares(L_, in_.F, in_.y);
    const double variance = in_.known_noise > 0 ? in_.known_noise / nugget_ : gls_.sum_of_squares / n;
    const double value = detail::concentrated_log_likelihood(L_, gls_.sum_of_squares, variance);
    if (!(variance > 0) || !std::isfinite(value)) return false;
    estimates_ = {gls_.beta[0], variance, value};
    return true;
  }

  bool invert(const Eigen::VectorXd& p) {
    if (!factor(p)) return false;
    if (inverted_) return true;
    detail::inverse_transposed(L_, work_, in_.threads);
    detail::product_of_upper(work_, K_, in_.threads);
    inverted_ = true;
    return true;
  }

  // Calls use(rows) for column j in pieces of at most 256 rows from the diagonal on.
  template <class Use>
  void in_chunks(Eigen::Index j, const Use& use) const {
    for (Eigen::Index i = j; i < runs(); i += detail::chunk_rows)
      use(detail::Rows{in_.X, i, std::min(detail::chunk_rows, runs() - i), &points_(0, j)});
  }

  void set_weights(const Eigen::VectorXd& p);
  detail::Chunk multipliers(Eigen::Index j, const detail::Rows& rows) const;
  detail::Chunk weight(Eigen::Index j, const detail::Rows& rows) const;
  Eigen::VectorXd correlation_slopes() const;
  void add_slopes(Eigen::Index j, double* g) const;
  void add_sum_slopes(Eigen::Index j, double* g) const;
  void add_second_derivatives_of_product(Eigen::MatrixXd& H) const;
  void add_second_derivatives_of_sum(Eigen::MatrixXd& H) const;
  detail::Chunk slope(Eigen::Index a, Eigen::Index j, const detail::Rows& rows) const;
  void fill_derivative(Eigen::Index a, Eigen::MatrixXd& D) const;
  void add_traces(Eigen::MatrixXd& H);
  Eigen::VectorXd traces() const;
  void add_trend_and_scale(Eigen::MatrixXd& H) const;

  LikelihoodProblem in_;
  Eigen::MatrixXd points_;  // X transposed
  detail::ParameterPlaces places_;
  std::optional<detail::JointlyRobustPrior> prior_;
  std::optional<detail::WeightPrior> weight_prior_;
  Eigen::VectorXd p_;
  CorrelationFunction f_;
  double nugget_ = 0;
  Concentrated estimates_;
  Eigen::MatrixXd C_, L_, K_, work_;
  detail::LeastSquares gls_;
  bool inverted_ = false;
  int factorizations_ = 0;
};

}  // namespace drawpoint::kriging

#include <drawpoint/kriging/detail/likelihood_curvature.hpp>
#include <drawpoint/kriging/detail/likelihood_slopes.hpp>
