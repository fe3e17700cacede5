// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Responses whose models err together: by how much, and draws that do.
///
/// Each response has a model of its own. Where all are observed by the same runs and share their correlation
/// function, trend and ratio of noise, and their noise is correlated as they are, a joint model with covariance
/// B ⊗ (R + λI) has these same means and variances, whatever B (Wackernagel 2003, "Multivariate Geostatistics",
/// chapter 24: autokrigeability). What it adds is how errors go together: at every point the correlation of
/// B. It is wanted where a question is about several responses at once: whether a point is dominated, whether
/// it keeps all limits. `error_correlation` estimates it, and `correlated_normals` with sample_paths.hpp draws
/// by it.
///
/// Simplified: one correlation for all points, of the models' own errors and of the noise of runs alike, since
/// the left-out errors hold both; and for models of unlike parameters, or that count what is unknown of them,
/// it is not that of a known joint model, though it is a valid one.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/detail/symmetric_root.hpp>
#include <drawpoint/kriging/sample_paths.hpp>
#include <drawpoint/kriging/score.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::kriging {

namespace detail {

/// What was observed, in deviations from what was predicted, on the scale of the predictions.
inline Eigen::VectorXd standardised_errors(const Validation& v) {
  Eigen::VectorXd errors(v.observed.size());
  for (Index i = 0; i < errors.size(); ++i) {
    const PredictedRun p = predicted_run(v, i);
    const double y =
        v.transform.scale == Scale::linear ? v.observed[i] : transformed(v.transform, v.observed[i]);
    const double error = (y - p.mean) / p.deviation;
    errors[i] = std::isfinite(error) ? error : 0.0;
  }
  return errors;
}

/// The share of the entries beside the diagonal that chance would give (Schäfer, Strimmer 2005, "A shrinkage
/// approach to large-scale covariance matrix estimation", Stat. Appl. Genet. Mol. Biol. 4(1)), of n runs with
/// normal errors. Errors with heavy tails give more by chance.
inline double share_of_chance(const Eigen::MatrixXd& R, Index n) {
  double variance = 0, squares = 0;
  for (Index j = 0; j < R.cols(); ++j)
    for (Index k = 0; k < j; ++k) {
      const double r2 = R(j, k) * R(j, k);
      variance += (1 - r2) * (1 - r2) / static_cast<double>(n - 1);
      squares += r2;
    }
  return squares > 0 ? std::min(variance / squares, 1.0) : 1.0;
}

inline void check_validations(const std::vector<Validation>& responses) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("kriging::error_correlation: " + what);
  };
  for (const Validation& v : responses) {
    if (v.observed.size() != responses.front().observed.size())
      reject("one response has " + std::to_string(responses.front().observed.size()) + " runs and another " +
             std::to_string(v.observed.size()) + "; give the same runs of each");
    if (v.observed.size() == 0) reject("there are 0 runs; allowed is 1 or more; validate first");
  }
}

}  // namespace detail

/// The correlation of the errors of k responses at the same runs, each left out or validated; one Validation per
/// response, in the same order of runs. k x k, symmetric, 1 on the diagonal, no negative eigenvalue. Correlations are
/// reduced by the share that chance would give, one share for all pairs: for two unrelated responses mostly to 0.
/// With fewer than three runs it is the identity.
/// Throws std::invalid_argument for unlike numbers of runs and for none.
inline Eigen::MatrixXd error_correlation(const std::vector<Validation>& responses) {
  detail::check_validations(responses);
  const auto k = static_cast<Eigen::Index>(responses.size());
  if (k == 0) return {};
  const Eigen::Index n = responses.front().observed.size();
  if (n < 3) return Eigen::MatrixXd::Identity(k, k);
  Eigen::MatrixXd errors(n, k);
  for (Eigen::Index j = 0; j < k; ++j) {
    errors.col(j) = detail::standardised_errors(responses[static_cast<std::size_t>(j)]);
    const double norm = errors.col(j).norm();
    if (norm > 0) errors.col(j) /= norm;
  }
  Eigen::MatrixXd R = (errors.transpose() * errors).cwiseMax(-1.0).cwiseMin(1.0);  // but for round-off it is
  R *= 1.0 - detail::share_of_chance(R, n);
  R.diagonal().setOnes();
  return R;
}

namespace detail {

/// But for round-off.
inline bool is_correlation(const Eigen::MatrixXd& R) {
  constexpr double round_off = 1e-10;
  return R.cols() == R.rows() && R.allFinite() && (R - R.transpose()).cwiseAbs().maxCoeff() <= round_off &&
         (R.diagonal().array() - 1.0).abs().maxCoeff() <= round_off &&
         R.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() >= -round_off;
}

}  // namespace detail

/// Standard normal numbers for k responses, rows x count each: entries at the same place have this
/// correlation, all others none. `correlation`: k x k, as error_correlation() gives it; of the identity,
/// response j has the numbers of the seed run_seed(seed, j, 0). Throws std::invalid_argument for a matrix that
/// is no correlation.
inline std::vector<Eigen::MatrixXd> correlated_normals(const Eigen::MatrixXd& correlation, Eigen::Index rows,
                                                       Eigen::Index count, doe::Seed seed) {
  const Eigen::Index k = correlation.rows();
  if (k == 0) return {};
  if (!detail::is_correlation(correlation))
    throw std::invalid_argument(
        "kriging::correlated_normals: the matrix is no correlation; allowed are symmetric ones with 1 on the "
        "diagonal and no negative eigenvalue; give that of error_correlation");
  const Eigen::MatrixXd root = detail::symmetric_root(correlation);
  std::vector<Eigen::MatrixXd> normals(static_cast<std::size_t>(k), Eigen::MatrixXd::Zero(rows, count));
  for (Eigen::Index source = 0; source < k; ++source) {
    const Eigen::MatrixXd independent =
        detail::standard_normals(rows, count, doe::run_seed(seed, static_cast<std::uint64_t>(source), 0));
    for (Eigen::Index j = 0; j < k; ++j)
      if (root(j, source) != 0) normals[static_cast<std::size_t>(j)] += root(j, source) * independent;
  }
  return normals;
}

}  // namespace drawpoint::kriging
