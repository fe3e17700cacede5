// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Vecchia's likelihood in blocks: each block of runs is conditioned on its nearest runs of earlier blocks
/// alone, not on all of them.
///
///   LL = Σ_b ln p(y_b | y of the neighbours of b)
/// The rows that whiten (conditional.hpp) are uncorrelated with variance s²: with u of y and Φ of F, β is the
/// least squares solution of Φβ = u, S = |u − Φβ|², s² = S/n (or τ²/λ), and
///   LL = −n/2 ln(2π s²) − Σ ln Lᵢᵢ − S/(2s²),  ∂LL/∂p = Σ_b ∂ln p_b/∂p
/// since β and s² are stationary. With all earlier runs as neighbours it is that of likelihood.hpp. Blocks
/// share their factor, so that a run has hundreds of neighbours for the price of some 80 of its own. A smooth
/// response needs them: of few neighbours the likelihood is highest at other length scales. The noise is
/// inside the blocks: R = C + λ diag(w). Conditioning the latent field instead needs the factor of its sparse
/// precision, which is singular to round-off where the correlation is smooth; the price is that noise is
/// averaged over the neighbours only. Cost n/b (m + b)³/3 for m neighbours and blocks of b; O(n m/b) memory.
/// Sums are made in a fixed order: equal bits on any number of threads. Sources: Vecchia 1988, J. R. Statist.
/// Soc. B 50(2); Stein, Chi, Welty 2004, J. R. Statist. Soc. B 66(2), "Approximating likelihoods for large
/// spatial data sets"; Guinness 2018, Technometrics 60(4), "Permutation and grouping methods for sharpening
/// Gaussian process approximations".

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/least_squares.hpp>
#include <drawpoint/kriging/detail/nearest/conditional.hpp>
#include <drawpoint/kriging/detail/nearest/families.hpp>
#include <drawpoint/kriging/detail/parallel.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// Parameters, prior and the estimates' meaning are those of Likelihood. Remembers the last point.
class VecchiaLikelihood {
 public:
  /// Blocks and neighbours are chosen by the length scales of p.
  VecchiaLikelihood(const LikelihoodProblem& problem, Index neighbours, const Eigen::VectorXd& p)
      : in_(problem), most_(neighbours) {
    f_.family = in_.family;
    f_.exponent = in_.exponent;
    f_.levels = in_.levels;
    f_.structure = in_.structure;
    places_ = parameter_places(f_, in_.X.cols(),
                               in_.family == Correlation::power_exponential && in_.exponent.size() == 0);
    std::vector<bool> varies;
    for (Index k = 0; k < in_.X.cols(); ++k) varies.push_back(!never_varies(in_.X, k));
    if (in_.prior)
      prior_.emplace(spacing_of(f_, places_, runs(), varies), in_.known_noise == 0, in_.nugget_power);
    choose_neighbours(p);
  }

  void choose_neighbours(const Eigen::VectorXd& p) {
    CorrelationFunction f = f_;
    set_correlation(places_, p, f);
    families_ = families_of(in_.X, f, Cells(in_.X, f, runs_of_cell(most_)), most_, in_.threads);
    p_.resize(0);
  }

  Index runs() const { return in_.X.rows(); }
  const ParameterPlaces& places() const { return places_; }
  const std::vector<Family>& families() const { return families_; }
  const CorrelationFunction& correlation() const { return f_; }
  double nugget() const { return nugget_; }
  const Concentrated& estimates() const { return estimates_; }
  int evaluations() const { return evaluations_; }
  const Eigen::VectorXd& beta() const { return beta_; }  ///< q
  /// q x q, upper triangular: TᵀT = FᵀR⁻¹F.
  const Eigen::MatrixXd& T() const { return T_; }
  double sum_of_squares() const { return sum_of_squares_; }  ///< S
  const Eigen::VectorXd& residual() const { return z_; }     ///< y − Fβ

  /// With ln π where a prior is asked for; −∞ where a block is not numerically positive definite.
  double value(const Eigen::VectorXd& p) {
    whiten(p);
    return estimates_.log_likelihood + (prior_ ? prior_->value(p) : 0.0);
  }

  /// One entry a parameter; zero where the value is −∞.
  Eigen::VectorXd gradient(const Eigen::VectorXd& p) {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(places_.count());
    if (!whiten(p)) return g;
    const double s2 = estimates_.process_variance;
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(g.size(), blocks());
    for_each_task(blocks(), in_.threads,
                  [&](int b) { conditional(b).add_slopes(places_, z_, s2, column(sums, b)); });
    for (Index b = 0; b < sums.cols(); ++b) add_scaled(g.data(), 1.0, column(sums, b), g.size());
    if (in_.known_noise > 0)
      g[g.size() - 1] += 0.5 * static_cast<double>(runs()) - 0.5 * sum_of_squares_ / s2;
    if (prior_) prior_->add_gradient(p, g);
    return g;
  }

 private:
  int blocks() const { return static_cast<int>(families_.size()); }

  Conditional conditional(int b) const { return {in_, f_, nugget_, families_[static_cast<std::size_t>(b)]}; }

  bool whiten(const Eigen::VectorXd& p) {
    if (p_.size() == p.size() && p_ == p) return std::isfinite(estimates_.log_likelihood);
    p_ = p;
    estimates_ = {};
    set_correlation(places_, p, f_);
    nugget_ = std::exp(p[p.size() - 1]);
    ++evaluations_;
    Eigen::MatrixXd yF(runs(), in_.F.cols() + 1), u = yF;
    yF << in_.y, in_.F;
    Eigen::VectorXd logs(blocks());
    for_each_task(blocks(), in_.threads, [&](int b) {
      const Conditional block = conditional(b);
      const Family& family = families_[static_cast<std::size_t>(b)];
      logs[b] = block.regular() ? block.half_log_determinant() : std::numeric_limits<double>::infinity();
      if (!block.regular()) return;
      const Eigen::MatrixXd own = block.whitened(yF);
      for (Index a = 0; a < family.own; ++a)
        u.row(family.rows[static_cast<std::size_t>(family.neighbours() + a)]) = own.row(a);
    });
    const double half_log_determinant = mean_of(logs) * static_cast<double>(blocks());
    return std::isfinite(half_log_determinant) &&
           estimate(u.col(0), u.rightCols(in_.F.cols()), half_log_determinant);
  }

  bool estimate(Eigen::VectorXd u, Eigen::MatrixXd Q, double half_log_determinant) {
    const auto n = static_cast<double>(runs());
    T_ = Eigen::MatrixXd::Zero(Q.cols(), Q.cols());
    orthonormalize(Q, T_);
    const Eigen::VectorXd share = transposed_product(Q, u);
    beta_ = solve_upper(T_, share);
    add_product(u.data(), -1.0, Q, share.data());
    add_product(u.data(), -1.0, Q, transposed_product(Q, u).data());
    sum_of_squares_ = square(u);
    z_ = in_.y;
    add_product(z_.data(), -1.0, in_.F, beta_.data());
    const double variance = in_.known_noise > 0 ? in_.known_noise / nugget_ : sum_of_squares_ / n;
    const double value = -0.5 * n * std::log(2.0 * std::numbers::pi * variance) - half_log_determinant -
                         0.5 * sum_of_squares_ / variance;
    if (!(variance > 0) || !std::isfinite(value)) return false;
    estimates_ = {beta_[0], variance, value};
    return true;
  }

  LikelihoodProblem in_;
  Index most_;
  ParameterPlaces places_;
  std::optional<JointlyRobustPrior> prior_;
  std::vector<Family> families_;
  CorrelationFunction f_;
  double nugget_ = 0;
  Eigen::VectorXd p_, beta_, z_;
  Eigen::MatrixXd T_;
  double sum_of_squares_ = 0;
  Concentrated estimates_;
  int evaluations_ = 0;
};

}  // namespace drawpoint::kriging::detail
