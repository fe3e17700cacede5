// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How likely a run succeeds where none was made: `SuccessModel model = fit_success(runs);`
///
/// A simulator that fails in a part of the box (stuck, diverged, out of time) leaves no response there, and
/// models of the responses know nothing of it. This one is fitted to success and failure alone: Gaussian
/// process classification, P = Φ(f) of a latent process f, its covariance by penalised likelihood
/// (detail/latent_likelihood.hpp), its posterior by expectation propagation (detail/site_posterior.hpp).
/// Failures that follow no place give about their share everywhere; far from all runs P goes back towards it.
/// Repeated runs at one place count each.
///
///   const Front front = nsga2(..., failing where model.probability(X) < 0.5);
///   product_of_criteria({expected_improvement(y, doe::Goal::minimize), probability_of_success(model)});
///
/// Simplifications: what the estimates of the covariance leave unknown is not in P; beyond 150 runs they are
/// estimated from 150 of them, half of these failed where there are as many; the posterior has all. Cost: 1 s
/// up to 150 runs on one core, then some 20 n³; n² a prediction. Deterministic.
///
/// Source: Rasmussen, Williams 2006, "Gaussian Processes for Machine Learning", chapter 3; for designs with
/// failures: Bachoc, Helbert, Picheny 2020, J. Global Optimization 78, "Gaussian process optimization with
/// failures: classification and convergence proof".

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/doe/criterion.hpp>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/latent_likelihood.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

struct SuccessOptions {
  /// The box of the problem, natural units, one entry per variable. Empty: the range of the data.
  Eigen::VectorXd lower, upper;
  /// Per variable 0 for a number, L for a category of L levels (doe::level_counts). Empty: all are numbers.
  std::vector<int> levels = {};
};

/// A value that threads may share.
class SuccessModel {
 public:
  /// P(success) of one more run at each row of X: m x d, natural units; m entries between 0 and 1.
  Eigen::VectorXd probability(const Eigen::MatrixXd& X) const;

  Eigen::Index runs() const { return X_.rows(); }
  Eigen::Index failures() const { return failures_; }
  /// The length scales of f on inputs scaled to [0, 1], d entries: how far a run informs about its surroundings.
  Eigen::VectorXd length_scales() const { return covariance_.length_scales(); }
  /// s of f: with 0.3 all places are about alike, with 3 most are either safe or lost.
  double deviation() const { return std::sqrt(covariance_.variance); }

  /// Mean logarithm of the probability that the other runs give to what a run did, at most 0; higher is
  /// better. And the same of the share of failures among the others, (k + 1)/(n + 1): places tell something
  /// where the first is the higher one.
  double left_out_score() const { return left_out_score_; }
  double share_score() const { return share_score_; }
  /// Whether places tell which runs fail: over all runs the first score is more than 3 above the second. So
  /// it is in 87 to 100 of 100 designs of 20 to 100 runs with an edge or a corner that fails, and in 2 to 20
  /// of 100 where failures follow no place, since the covariance has seen the runs that are left out.
  bool place_tells() const { return static_cast<double>(runs()) * (left_out_score_ - share_score_) > 3.0; }

  /// Whether expectation propagation met its stopping rule.
  bool converged() const { return posterior_.converged; }

 private:
  friend SuccessModel fit_success(const Eigen::MatrixXd& X, const std::vector<bool>& succeeded,
                                  const SuccessOptions& options);

  detail::InputScale input_;
  Eigen::MatrixXd X_;  // scaled
  detail::LatentCovariance covariance_;
  detail::LatentPosterior posterior_;
  Eigen::Index failures_ = 0;
  double left_out_score_ = 0, share_score_ = 0;
};

namespace detail {

[[noreturn]] inline void reject_success(const std::string& what) {
  throw std::invalid_argument("kriging::fit_success: " + what);
}

inline void check_success(const Eigen::MatrixXd& X, const std::vector<bool>& succeeded,
                          const SuccessOptions& options) {
  if (X.rows() < 1 || X.cols() < 1)
    reject_success("X is " + std::to_string(X.rows()) + " x " + std::to_string(X.cols()) +
                   "; allowed is 1 x 1 or more; give one row per run, failed ones too");
  if (static_cast<Eigen::Index>(succeeded.size()) != X.rows())
    reject_success("X has " + std::to_string(X.rows()) + " rows but succeeded has " +
                   std::to_string(succeeded.size()) + " entries; give one per run");
  check_inputs("kriging::fit_success", X, {options.lower, options.upper, options.levels});
}

/// Rows that the covariance is estimated from: at most `limit`, failures first while they are half or fewer,
/// evenly picked of both kinds. The mean of f is open, so that their share may differ from that of all runs.
inline std::vector<Index> rows_of_both_kinds(const std::vector<bool>& succeeded, Index limit) {
  std::vector<Index> kinds[2];
  for (std::size_t i = 0; i < succeeded.size(); ++i)
    kinds[succeeded[i] ? 1 : 0].push_back(static_cast<Index>(i));
  const Index all[2] = {static_cast<Index>(kinds[0].size()), static_cast<Index>(kinds[1].size())};
  if (all[0] + all[1] <= limit) limit = all[0] + all[1];
  const Index failed = std::clamp(all[0], std::min(all[0], limit - std::min(all[1], limit / 2)),
                                  std::max(limit / 2, limit - all[1]));
  const Index wanted[2] = {failed, limit - failed};
  std::vector<Index> rows;
  for (int kind = 0; kind < 2; ++kind)
    for (Index i = 0; i < wanted[kind]; ++i)
      rows.push_back(kinds[kind][static_cast<std::size_t>(i * all[kind] / wanted[kind])]);
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// The mean logarithm of each run's probability: the share of its kind among the others with one more of both kinds.
inline double share_score(Index failures, Index runs) {
  const auto of = [&](Index kind) {
    return kind == 0 ? 0.0
                     : static_cast<double>(kind) *
                           std::log(static_cast<double>(kind) / static_cast<double>(runs + 1));
  };
  return (of(failures) + of(runs - failures)) / static_cast<double>(runs);
}

}  // namespace detail

/// X: n x d, natural units, all runs, failed ones too; succeeded: n. All may have succeeded, or failed.
/// Throws std::invalid_argument for no run, unequal lengths, numbers that are not finite and bounds out of
/// order.
inline SuccessModel fit_success(const Eigen::MatrixXd& X, const std::vector<bool>& succeeded,
                                const SuccessOptions& options = {}) {
  detail::check_success(X, succeeded, options);
  SuccessModel model;
  model.input_ = detail::latent_scale(X, {options.lower, options.upper, options.levels});
  model.X_ = model.input_.apply(X);
  std::vector<detail::SuccessRun> all;
  for (const bool success : succeeded) {
    all.push_back({success ? 1.0 : -1.0});
    model.failures_ += !success;
  }
  detail::LatentFit fitted =
      detail::fit_latent(model.X_, all, detail::rows_of_both_kinds(succeeded, detail::latent_limit),
                         detail::categories_of(options.levels));
  model.covariance_ = std::move(fitted.covariance);
  model.posterior_ = std::move(fitted.posterior);
  model.left_out_score_ = detail::mean_of(model.posterior_.left_out);
  model.share_score_ = detail::share_score(model.failures_, X.rows());
  return model;
}

/// Fits the success of all rows, in the problem's box. Throws as above.
inline SuccessModel fit_success(const doe::Evaluations& runs) {
  const auto d = static_cast<Eigen::Index>(runs.problem.variables.size());
  Eigen::MatrixXd X(static_cast<Eigen::Index>(runs.rows.size()), d);
  std::vector<bool> succeeded;
  for (const doe::Evaluation& row : runs.rows) {
    for (Eigen::Index k = 0; k < d; ++k) X(static_cast<Eigen::Index>(succeeded.size()), k) = row.x[k];
    succeeded.push_back(!row.outcome.failed());
  }
  return fit_success(
      X, succeeded,
      {doe::lower_bounds(runs.problem), doe::upper_bounds(runs.problem), doe::level_counts(runs.problem)});
}

inline Eigen::VectorXd SuccessModel::probability(const Eigen::MatrixXd& X) const {
  if (X.cols() != X_.cols())
    throw std::invalid_argument("kriging::SuccessModel::probability: X has " + std::to_string(X.cols()) +
                                " columns; allowed are " + std::to_string(X_.cols()) +
                                "; give one per variable");
  detail::require_levels("kriging::SuccessModel::probability", X, covariance_.correlation.levels);
  const Prediction f = detail::latent_at(input_.apply(X), X_, covariance_, posterior_);
  Eigen::VectorXd P = f.mean;
  for (detail::Index i = 0; i < P.size(); ++i)
    P[i] = detail::normal_probability(f.mean[i] / std::sqrt(1.0 + f.variance[i]));
  return P;
}

/// P(success), as a criterion for doe::propose and doe::refine and a factor of others.
inline doe::Criterion probability_of_success(SuccessModel model) {
  return [model = std::move(model)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    return model.probability(X);
  };
}

}  // namespace drawpoint::kriging
