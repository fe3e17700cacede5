// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How likely a covariance of the latent process makes what all runs did, success or failure, with a prior.
///
///   K = c² + s² C(θ),  c = 2:  ln Z(θ, s²) + ln π,  ln Z of probit_posterior.hpp
///   ∂ln Z/∂a = ½ Σᵢⱼ (b bᵀ − W)ᵢⱼ ∂Kᵢⱼ/∂a
/// The constant c² is the spread of the mean of f, which stays open: in advance a run succeeds anywhere with
/// a chance between Φ(−4) and Φ(4). C is Matérn's with 5/2. Parameters: ln θ, then ln s². Runs that are only
/// yes or no tell little of d + 1 numbers, so these have priors, log normal: length scales on [0, 1] with
/// median √d, s with median 2, both within a factor e^1.5 in two of three cases. Medians and width are those
/// of 13 tried that decide best over eight kinds of regions (benchmarks/toolkit/success_table.cpp); twice or
/// half of any loses less than a tenth. Cost: 20 to 60 n³ a value, n³ a
/// gradient. Source: Rasmussen, Williams 2006, section 5.5.2.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/climb.hpp>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/probit_posterior.hpp>
#include <utility>

namespace drawpoint::kriging::detail {

inline constexpr double variance_of_mean = 4.0;  // c²

/// The latent covariance.
struct SuccessCovariance {
  CorrelationFunction correlation;
  double variance = 1;  ///< s²
};

/// (ln θ, ln s²), d + 1 numbers.
inline SuccessCovariance success_covariance(const Eigen::VectorXd& p) {
  const Index d = p.size() - 1;
  SuccessCovariance result{{Correlation::matern52, Eigen::VectorXd(d), {}}, std::exp(p[d])};
  for (Index k = 0; k < d; ++k) result.correlation.theta[k] = std::exp(p[k]);
  return result;
}

/// Remembers the last point. Not for concurrent use.
class SuccessLikelihood {
 public:
  /// X: n x d on [-1, 1]; y: n, +1 or −1.
  SuccessLikelihood(Eigen::MatrixXd X, Eigen::VectorXd y)
      : X_(std::move(X)), y_(std::move(y)), points_(X_.transpose()) {}

  Index variables() const { return X_.cols(); }

  /// Where the priors are highest.
  Eigen::VectorXd middle() const {
    Eigen::VectorXd p = Eigen::VectorXd::Constant(variables() + 1, log_theta_middle());
    p[variables()] = log_variance_middle;
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
    Eigen::VectorXd g = Eigen::VectorXd::Zero(d + 1);
    for (Index j = 0; j < n; ++j) add_slopes(j, W, g);
    for (Index k = 0; k <= d; ++k) g[k] -= prior_distance(p, k) / prior_width;
    return g;
  }

  const ProbitPosterior& posterior(const Eigen::VectorXd& p) {
    solve(p);
    return posterior_;
  }

 private:
  static constexpr double log_variance_middle = 1.3862943611198906;  // s = 2
  static constexpr double prior_width = 3.0;

  // θ = 1/(8 l²), l = √d.
  double log_theta_middle() const { return -std::log(8.0 * static_cast<double>(variables())); }
  double prior_distance(const Eigen::VectorXd& p, Index k) const {
    return (p[k] - (k < variables() ? log_theta_middle() : log_variance_middle)) / prior_width;
  }

  void solve(const Eigen::VectorXd& p) {
    if (p_.size() == p.size() && p_ == p) return;
    p_ = p;
    covariance_ = success_covariance(p);
    fill_correlation(X_, covariance_.correlation, C_);
    mirror_lower(C_);
    Eigen::MatrixXd K = C_;
    std::for_each(K.data(), K.data() + K.size(),
                  [this](double& k) { k = variance_of_mean + covariance_.variance * k; });
    posterior_ = probit_posterior(K, y_);
  }

  // Column j of b bᵀ − W from the diagonal down, times s²C there, doubled for its mirror.
  void add_slopes(Index j, const Eigen::MatrixXd& inverse, Eigen::VectorXd& g) const {
    const Index d = variables();
    const Eigen::VectorXd &b = posterior_.weights, &root = posterior_.root;
    for (Index first = j; first < X_.rows(); first += chunk_rows) {
      const Rows rows{X_, first, std::min(chunk_rows, X_.rows() - first), &points_(0, j)};
      Chunk w(rows.count), ones(rows.count);
      for (Index r = 0; r < rows.count; ++r) {
        const Index i = first + r;
        const double both = i == j ? 0.5 : 1.0;
        w.number[r] =
            both * covariance_.variance * C_(i, j) * (b[i] * b[j] - root[i] * root[j] * inverse(i, j));
        ones.number[r] = 1.0;
      }
      for (Index k = 0; k < d; ++k)
        g[k] += dot(w, slope_in_theta(covariance_.correlation, k, rows.distance(k)));
      g[d] += dot(w, ones);
    }
  }

  Eigen::MatrixXd X_;
  Eigen::VectorXd y_;
  Eigen::MatrixXd points_;  // X transposed
  Eigen::VectorXd p_;
  SuccessCovariance covariance_;
  Eigen::MatrixXd C_;
  ProbitPosterior posterior_;
};

/// (ln θ, ln s²) of the highest value that climbs from three lengths of correlation reach.
inline Eigen::VectorXd likeliest_success(SuccessLikelihood& likelihood) {
  const Eigen::VectorXd middle = likelihood.middle();
  const Index d = middle.size() - 1;
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

}  // namespace drawpoint::kriging::detail
