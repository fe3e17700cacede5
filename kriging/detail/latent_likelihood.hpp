// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How likely a covariance of the latent process makes what all runs gave, with a prior.
///
///   K = c² + s² C(θ) + σ² I,  c = 2:  ln Z(θ, s², σ²) + ln π,  ln Z of site_posterior.hpp
///   ∂ln Z/∂a = ½ Σᵢⱼ (b bᵀ − W)ᵢⱼ ∂Kᵢⱼ/∂a
/// The constant c² is the spread of the mean of f, which stays open: in advance a run succeeds anywhere with
/// a chance between Φ(−4) and Φ(4), and a count may be e⁴ times the mean of all or as much below it. C is
/// Matérn's with 5/2. σ² is what f has of a run's own, for runs whose counts scatter by more than Poisson's
/// law; success and failure cannot tell it. Parameters: ln θ, ln s², then ln σ² of counts. Such runs tell
/// little of so many numbers, so these have priors, log normal: length scales on [0, 1] with median √d, s
/// with median 2 (of counts 1) and σ with median 0.3, all within a factor e^1.5 in two of three cases. The
/// medians and the width for success are those of 13 tried that decide best over eight kinds of regions
/// (benchmarks/toolkit/success_table.cpp); twice or half of any loses less than a tenth. Cost: 20 to 60 n³ a
/// value, n³ a gradient. Source: Rasmussen, Williams 2006, section 5.5.2.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/climb.hpp>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/site_posterior.hpp>
#include <drawpoint/kriging/detail/training_data.hpp>
#include <drawpoint/kriging/model.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

inline constexpr double variance_of_mean = 4.0;  // c²

/// The latent covariance.
struct LatentCovariance {
  CorrelationFunction correlation;
  double variance = 1;  ///< s²
  double of_a_run = 0;  ///< σ²

  /// On inputs scaled to [0, 1], d entries.
  Eigen::VectorXd length_scales() const {
    Eigen::VectorXd l = correlation.theta;
    for (double& entry : l) entry = 1.0 / std::sqrt(8.0 * entry);
    return l;
  }
};

/// What differs between kinds of runs.
template <class Run>
struct LatentPrior;
template <>
struct LatentPrior<SuccessRun> {
  static constexpr double log_variance_middle = 1.3862943611198906;  // s = 2
  static constexpr Index of_a_run = 0;                               // numbers for σ²
};
template <>
struct LatentPrior<CountRun> {
  static constexpr double log_variance_middle = 0;  // s = 1
  static constexpr Index of_a_run = 1;
};
inline constexpr double log_own_variance_middle = -2.4079456086518722;  // σ = 0.3

/// (ln θ, ln s²), and ln σ² where runs have one.
template <class Run>
LatentCovariance latent_covariance(const Eigen::VectorXd& p, const std::vector<int>& levels) {
  const Index own = LatentPrior<Run>::of_a_run, d = p.size() - 1 - own;
  LatentCovariance result{{Correlation::matern52, Eigen::VectorXd(d), {}, levels}, std::exp(p[d])};
  for (Index k = 0; k < d; ++k) result.correlation.theta[k] = std::exp(p[k]);
  if (own > 0) result.of_a_run = std::exp(p[d + 1]);
  return result;
}

/// Remembers the last point. Not for concurrent use.
template <class Run>
class LatentLikelihood {
 public:
  /// X: n x d on [-1, 1]; `levels` of the correlation.
  LatentLikelihood(Eigen::MatrixXd X, std::vector<Run> runs, std::vector<int> levels = {})
      : X_(std::move(X)), runs_(std::move(runs)), levels_(std::move(levels)), points_(X_.transpose()) {}

  Index variables() const { return X_.cols(); }

  /// Where the priors are highest.
  Eigen::VectorXd middle() const {
    Eigen::VectorXd p(variables() + 1 + LatentPrior<Run>::of_a_run);
    for (Index k = 0; k < p.size(); ++k) p[k] = prior_middle(k);
    return p;
  }

  /// ln Z + ln π; the constants of π are left out.
  double value(const Eigen::VectorXd& p) {
    solve(p);
    double sum = posterior_.log_evidence;
    for (Index k = 0; k < p.size(); ++k) sum -= 0.5 * prior_distance(p, k) * prior_distance(p, k);
    return sum;
  }

  Eigen::VectorXd gradient(const Eigen::VectorXd& p) {
    solve(p);
    const Index n = X_.rows(), d = variables();
    Eigen::MatrixXd inverse_root, W;
    inverse_transposed(posterior_.L, inverse_root);
    product_of_upper(inverse_root, W);  // B⁻¹
    Eigen::VectorXd g = Eigen::VectorXd::Zero(p.size());
    for (Index j = 0; j < n; ++j) add_slopes(j, W, g);
    if (LatentPrior<Run>::of_a_run > 0)
      for (Index j = 0; j < n; ++j) g[d + 1] += 0.5 * covariance_.of_a_run * slope_in_covariance(j, j, W);
    for (Index k = 0; k < p.size(); ++k) g[k] -= prior_distance(p, k) / prior_width;
    return g;
  }

  const LatentPosterior& posterior(const Eigen::VectorXd& p) {
    solve(p);
    return posterior_;
  }

 private:
  static constexpr double prior_width = 3.0;

  // θ = 1/(8 l²), l = √d.
  double prior_middle(Index k) const {
    const Index d = variables();
    if (k < d) return -std::log(8.0 * static_cast<double>(d));
    return k == d ? LatentPrior<Run>::log_variance_middle : log_own_variance_middle;
  }
  double prior_distance(const Eigen::VectorXd& p, Index k) const {
    return (p[k] - prior_middle(k)) / prior_width;
  }

  void solve(const Eigen::VectorXd& p) {
    if (p_.size() == p.size() && p_ == p) return;
    p_ = p;
    covariance_ = latent_covariance<Run>(p, levels_);
    fill_correlation(X_, covariance_.correlation, C_);
    mirror_lower(C_);
    Eigen::MatrixXd K = C_;
    std::for_each(K.data(), K.data() + K.size(),
                  [this](double& k) { k = variance_of_mean + covariance_.variance * k; });
    add_to_diagonal(K, covariance_.of_a_run);
    posterior_ = latent_posterior(K, runs_);
  }

  // Entry of b bᵀ − W.
  double slope_in_covariance(Index i, Index j, const Eigen::MatrixXd& inverse) const {
    const Eigen::VectorXd &b = posterior_.weights, &root = posterior_.root;
    return b[i] * b[j] - root[i] * root[j] * inverse(i, j);
  }

  // Column j of b bᵀ − W from the diagonal down, times s²C there, doubled for its mirror.
  void add_slopes(Index j, const Eigen::MatrixXd& inverse, Eigen::VectorXd& g) const {
    const Index d = variables();
    for (Index first = j; first < X_.rows(); first += chunk_rows) {
      const Rows rows{X_, first, std::min(chunk_rows, X_.rows() - first), &points_(0, j)};
      Chunk w(rows.count), ones(rows.count);
      for (Index r = 0; r < rows.count; ++r) {
        const Index i = first + r;
        const double both = i == j ? 0.5 : 1.0;
        w.number[r] = both * covariance_.variance * C_(i, j) * slope_in_covariance(i, j, inverse);
        ones.number[r] = 1.0;
      }
      for (Index k = 0; k < d; ++k)
        g[k] +=
            dot(w, slope_in_theta(covariance_.correlation, k, distances(covariance_.correlation, rows, k)));
      g[d] += dot(w, ones);
    }
  }

  Eigen::MatrixXd X_;
  std::vector<Run> runs_;
  std::vector<int> levels_;
  Eigen::MatrixXd points_;  // X transposed
  Eigen::VectorXd p_;
  LatentCovariance covariance_;
  Eigen::MatrixXd C_;
  LatentPosterior posterior_;
};

/// Parameters of the highest value that climbs from three lengths of correlation reach.
template <class Run>
Eigen::VectorXd likeliest(LatentLikelihood<Run>& likelihood) {
  const Eigen::VectorXd middle = likelihood.middle();
  const Index d = likelihood.variables();
  const Box box{affine(middle, 1.0, -9.0), affine(middle, 1.0, 9.0)};  // three widths of the prior
  Eigen::VectorXd best = middle;
  double highest = likelihood.value(middle);
  for (const double shorter : {0.0, 2.0, -2.0}) {  // in ln θ
    Eigen::VectorXd start = middle;
    for (Index k = 0; k < d; ++k) start[k] += shorter;
    BoxClimb climb(likelihood, box, start);
    climb.advance(30, 1e-3);
    if (climb.value() <= highest) continue;
    highest = climb.value();
    best = climb.p();
  }
  return best;
}

/// Runs that the covariance is estimated from, at most.
inline constexpr Index latent_limit = 150;

struct LatentFit {
  LatentCovariance covariance;
  LatentPosterior posterior;
};

/// X: n x d on [-1, 1]; `levels` of the correlation. The covariance by the rows `few`, latent_limit at most,
/// the posterior by all.
template <class Run>
LatentFit fit_latent(const Eigen::MatrixXd& X, const std::vector<Run>& runs, const std::vector<Index>& few,
                     const std::vector<int>& levels) {
  std::vector<Run> some;
  for (const Index i : few) some.push_back(runs[static_cast<std::size_t>(i)]);
  LatentLikelihood<Run> likelihood(rows_of(X, few), some, levels);
  const Eigen::VectorXd p = likeliest(likelihood);
  return {latent_covariance<Run>(p, levels), X.rows() <= latent_limit
                                                 ? likelihood.posterior(p)
                                                 : LatentLikelihood<Run>(X, runs, levels).posterior(p)};
}

/// What the inputs of such runs are told to be: bounds and, of categories, levels.
struct LatentInputs {
  const Eigen::VectorXd &lower, &upper;
  const std::vector<int>& levels;
};

/// Points and inputs of runs that give no number with normal noise; `place` names the caller. Throws
/// std::invalid_argument for numbers that are not finite, bounds that do not fit or are out of order, and
/// what is no level.
inline void check_inputs(const std::string& place, const Eigen::MatrixXd& X, const LatentInputs& inputs) {
  const Eigen::VectorXd &lower = inputs.lower, &upper = inputs.upper;
  const auto refuse = [&](const std::string& what) { throw std::invalid_argument(place + ": " + what); };
  if (!std::all_of(X.data(), X.data() + X.size(), is_usable))
    refuse("X has an entry that is not finite or beyond 1e150; give numbers below it");
  const bool none = lower.size() == 0 && upper.size() == 0;
  if (!none && (lower.size() != X.cols() || upper.size() != X.cols()))
    refuse("the box has " + std::to_string(lower.size()) + " lower and " + std::to_string(upper.size()) +
           " upper bounds but X has " + std::to_string(X.cols()) +
           " columns; give one of each per variable, or neither");
  for (Index k = 0; k < lower.size(); ++k)
    if (!(upper[k] - lower[k] >= smallest_range) || !is_usable(lower[k]) || !is_usable(upper[k]))
      refuse("variable " + std::to_string(k) + " has the bounds " + text(lower[k]) + " and " +
             text(upper[k]) + "; allowed are finite ones with lower below upper");
  check_level_counts(place, inputs.levels, X.cols());
  require_levels(place, X, inputs.levels);
}

/// The scaling of the inputs of such runs to [-1, 1]; categories keep their levels.
inline InputScale latent_scale(const Eigen::MatrixXd& X, const LatentInputs& inputs) {
  FitOptions box;
  box.lower = inputs.lower;
  box.upper = inputs.upper;
  box.levels = inputs.levels;
  return input_scale(X, box);
}

/// Mean and variance of f at the rows of `points` (m x d, scaled as X, which is n x d): m entries each.
inline Prediction latent_at(const Eigen::MatrixXd& points, const Eigen::MatrixXd& X,
                            const LatentCovariance& covariance, const LatentPosterior& posterior) {
  Eigen::MatrixXd k = cross_correlation(points, X, covariance.correlation);  // m x n
  for (double* c = k.data(); c != k.data() + k.size(); ++c) *c = variance_of_mean + covariance.variance * *c;
  Prediction f{product(k, posterior.weights), {}};
  for (Index j = 0; j < k.cols(); ++j)
    for (Index i = 0; i < k.rows(); ++i) k(i, j) *= posterior.root[j];
  solve_right(block_of(posterior.L), block_of(k));
  f.variance = affine(row_squares(k), -1.0, variance_of_mean + covariance.variance);
  for (double& v : f.variance) v = std::max(v, 0.0);
  return f;
}

}  // namespace drawpoint::kriging::detail
