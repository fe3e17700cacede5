// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Sobol' indices: which share of a response's variance each input explains, when the inputs are independent,
/// and uniform in the box or distributed as one says (distribution.hpp).
///
///   first   S_j  = Var(E[f | x_j]) / V               alone; Σ S_j <= 1, = 1 for a sum of functions of one input
///   total   T_j  = E[Var(f | all but x_j)] / V       with all its interactions; T_j >= S_j, 0 for an inert input
///   second  S_jk = Var(E[f | x_j, x_k])/V − S_j − S_k  what two do together beyond what each does alone
/// From N pairs of points A_i, B_i and, for each input, C_i = A_i with entry j of B_i, N(d + 2) runs in all:
///   saltelli   S_j V = ⟨f(B)(f(C) − f(A))⟩,       T_j V = ½⟨(f(A) − f(C))²⟩   (its T is Jansen's)
///   jansen     S_j V = V − ½⟨(f(B) − f(C))²⟩,     T_j as above
///   martinez   S_j = corr(f(B), f(C)),            T_j = 1 − corr(f(A), f(C))
/// and, asked for second order, D_i = B_i with entry j of A_i, N(2d + 2) runs in all:
///   (S_jk + S_j + S_k) V = ½⟨f(D_j) f(C_k) + f(D_k) f(C_j)⟩ − ⟨f(A) f(B)⟩
/// ⟨⟩ is the mean over i, f has its mean taken off, V is the variance over A and B. Intervals by bootstrap
/// over i (percentiles); estimates may fall a little outside [0, 1]. The pairs come from a scrambled Sobol'
/// sequence in 2d dimensions while it has them, whose error is smaller than the intervals say, else from
/// random points. A pair with a failed run is left out whole, and the status says when that is more than a
/// few. The noise of a noisy black box counts as one more input that interacts with all. Sources: Saltelli,
/// Annoni, Azzini, Campolongo, Ratto, Tarantola 2010, Comput. Phys. Commun. 181, table 2; Saltelli 2002,
/// ibid. 145 (second order); Jansen 1999, ibid. 117; Martinez 2011 (GdR Ondes and Mascot Num).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/sobol_terms.hpp>
#include <drawpoint/doe/detail/sorted_quantile.hpp>
#include <drawpoint/doe/distribution.hpp>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/doe/uniform.hpp>

namespace drawpoint::doe {

struct SobolIndicesOptions {
  Seed seed = 1;       ///< of the pairs and the bootstrap
  int samples = 1024;  ///< N, 2 or more; powers of 2 suit the Sobol' sequence; N(d + 2) runs
  SobolEstimator estimator =
      SobolEstimator::saltelli;    ///< jansen where the S_j are large, martinez is in [-1, 1]
  double confidence = 0.95;        ///< of each interval, between 0 and 1
  int resamples = 500;             ///< of the bootstrap, 100 or more: fewer do not reach the tails
  bool second_order = false;       ///< S_jk as well, at N(2d + 2) runs
  bool quasi_random = true;        ///< false: random pairs, for which the intervals are exact for large N
  InputDistributions inputs = {};  ///< by variable; those that are not named are uniform in their box
  EvaluateOptions evaluate = {};
};

/// Estimates with their confidence intervals, one entry per variable.
struct IndexEstimates {
  Eigen::VectorXd value, lower, upper;
};

enum class SensitivityStatus {
  estimated,
  runs_lost,          ///< failures took more than a twentieth of what is averaged: see the message
  constant_response,  ///< no variance to explain: the indices are 0
  too_few_runs        ///< fewer than two pairs without a failure: the indices are NaN
};

inline std::string_view to_string(SensitivityStatus status) {
  switch (status) {
    case SensitivityStatus::estimated:
      return "estimated";
    case SensitivityStatus::runs_lost:
      return "runs_lost";
    case SensitivityStatus::constant_response:
      return "constant_response";
    case SensitivityStatus::too_few_runs:
      return "too_few_runs";
  }
  return "unknown";
}

/// d x d, symmetric, 0 on the diagonal; empty unless asked for.
struct PairEstimates {
  Eigen::MatrixXd value, lower, upper;
};

struct SobolIndices {
  std::string response;
  SensitivityStatus status = SensitivityStatus::estimated;
  std::string message = {};       ///< empty when estimated
  double mean = 0, variance = 0;  ///< over A and B, unit of the response and its square
  IndexEstimates first, total;
  PairEstimates second;
};

struct Sensitivity {
  std::vector<SobolIndices> responses;  ///< in the order of the problem
  int pairs = 0;                        ///< that were used
  Evaluations runs;                     ///< blocks of N: A, B, then C, then D of each variable
};

namespace detail {

inline void check_sensitivity(const SobolIndicesOptions& options) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("doe::sobol_indices: " + what);
  };
  if (options.samples < 2)
    reject("samples is " + std::to_string(options.samples) + "; allowed is 2 or more; take some hundred");
  if (options.resamples < 100)
    reject("resamples is " + std::to_string(options.resamples) +
           "; allowed is 100 or more; fewer do not reach the tails of the interval");
  if (!(options.confidence > 0.0 && options.confidence < 1.0))
    reject("confidence is " + number_text(options.confidence) +
           "; allowed is between 0 and 1; 0.95 is usual");
  if (options.evaluate.replicates != 1)
    reject("replicates is " + std::to_string(options.evaluate.replicates) +
           "; allowed is 1; average inside the black box");
}

/// The pairs side by side: N x 2d.
inline Eigen::MatrixXd pairs_of_points(const Problem& problem, const SobolIndicesOptions& options) {
  Problem doubled{{}, problem.responses};
  for (const char* side : {"A ", "B "})
    for (Variable v : problem.variables) {
      v.name = side + v.name;
      doubled.variables.push_back(std::move(v));
    }
  const bool quasi =
      options.quasi_random && static_cast<int>(doubled.variables.size()) <= sobol_max_dimensions;
  Eigen::MatrixXd pairs = quasi ? scrambled_sobol(doubled, options.samples, {.seed = options.seed})
                                : uniform_random(doubled, options.samples, {.seed = options.seed});
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  pairs.leftCols(d) = distributed(problem, options.inputs, pairs.leftCols(d));
  pairs.rightCols(d) = distributed(problem, options.inputs, pairs.rightCols(d));
  return pairs;
}

/// A, B, C_1, ..., C_d and, for the second order, D_1, ..., D_d below each other.
inline Eigen::MatrixXd saltelli_design(const Problem& problem, const SobolIndicesOptions& options) {
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  const Eigen::Index n = options.samples;
  const Eigen::MatrixXd pairs = pairs_of_points(problem, options);
  Eigen::MatrixXd X(n * ((options.second_order ? 2 * d : d) + 2), d);
  X.topRows(n) = pairs.leftCols(d);
  X.middleRows(n, n) = pairs.rightCols(d);
  for (Eigen::Index j = 0; j < d; ++j) {
    X.middleRows(n * (2 + j), n) = pairs.leftCols(d);
    X.col(j).segment(n * (2 + j), n) = pairs.col(d + j);
    if (!options.second_order) continue;
    X.middleRows(n * (2 + d + j), n) = pairs.rightCols(d);
    X.col(j).segment(n * (2 + d + j), n) = pairs.col(j);
  }
  return X;
}

/// Indices as SobolTerms gives them x resamples.
inline Eigen::MatrixXd bootstrapped(const SobolTerms& terms, const SobolIndicesOptions& options) {
  const Eigen::Index n = terms.pairs();
  RandomStream random(run_seed(options.seed, 0, 1));
  Eigen::MatrixXd indices;
  for (int k = 0; k < options.resamples; ++k) {
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i) weight[random.below(static_cast<int>(n))] += 1.0;
    const Eigen::VectorXd index =
        terms.indices(terms.means(weight / static_cast<double>(n)), options.estimator);
    if (k == 0) indices.resize(index.size(), options.resamples);
    indices.col(k) = index;
  }
  return indices;
}

inline IndexEstimates estimates(const Eigen::VectorXd& value, const Eigen::MatrixXd& resampled,
                                double confidence) {
  IndexEstimates result{value, value, value};
  for (Eigen::Index j = 0; j < value.size(); ++j) {
    Eigen::VectorXd sorted = resampled.row(j).transpose();
    std::sort(sorted.begin(), sorted.end());
    result.lower[j] = sorted_quantile(sorted, 0.5 * (1.0 - confidence));
    result.upper[j] = sorted_quantile(sorted, 0.5 * (1.0 + confidence));
  }
  return result;
}

/// Entries 12, 13, 23, 14, ... as symmetric matrices.
inline PairEstimates pairs_of(const IndexEstimates& entries, Eigen::Index d) {
  const auto matrix = [d](const Eigen::VectorXd& of) {
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(d, d);
    for (Eigen::Index j = 0, at = 0; j < d; ++j)
      for (Eigen::Index k = 0; k < j; ++k, ++at) m(j, k) = m(k, j) = of[at];
    return m;
  };
  return {matrix(entries.value), matrix(entries.lower), matrix(entries.upper)};
}

/// Every index the same.
inline void fill(SobolIndices& result, Eigen::Index d, double value, const SobolIndicesOptions& options) {
  const Eigen::VectorXd v = Eigen::VectorXd::Constant(d, value);
  result.first = result.total = {v, v, v};
  const Eigen::VectorXd entries = Eigen::VectorXd::Constant(d * (d - 1) / 2, value);
  if (options.second_order) result.second = pairs_of({entries, entries, entries}, d);
}

/// Y: pairs x blocks of one response.
inline SobolIndices indices_of(std::string response, Eigen::MatrixXd Y, const SobolIndicesOptions& options) {
  SobolIndices result;
  result.response = std::move(response);
  const Eigen::Index d = options.second_order ? (Y.cols() - 2) / 2 : Y.cols() - 2;
  if (Y.rows() < 2) {
    result.status = SensitivityStatus::too_few_runs;
    result.message =
        std::to_string(Y.rows()) + " of " + std::to_string(options.samples) +
        " pairs of points without a failed or missing run; two are needed: see the reasons of the failures";
    fill(result, d, std::numeric_limits<double>::quiet_NaN(), options);
    return result;
  }
  result.mean = Y.leftCols(2).mean();
  if ((Y.leftCols(2).array() == Y(0, 0)).all()) {
    result.status = SensitivityStatus::constant_response;
    result.message = "all responses equal " + number_text(result.mean) + ": there is no variance to explain";
    fill(result, d, 0.0, options);
    return result;
  }
  if (20 * (options.samples - Y.rows()) > options.samples) {
    result.status = SensitivityStatus::runs_lost;
    result.message =
        std::to_string(options.samples - Y.rows()) + " of " + std::to_string(options.samples) +
        " pairs of points are left out, each for a failed run: the indices are of the part of the "
        "box where runs succeed, over which the inputs are not independent, so that their sums "
        "mean little; narrow the box, or give failed runs a value";
  }
  const double size = Y.cwiseAbs().maxCoeff();  // whose square may leave the range
  Y = (Y / size).array() - result.mean / size;
  const SobolTerms terms(Y, d);
  const Eigen::VectorXd means = terms.means(), index = terms.indices(means, options.estimator);
  const Eigen::MatrixXd resampled = bootstrapped(terms, options);
  result.variance = SobolTerms::variance(means) * size * size;
  result.first = estimates(index.head(d), resampled.topRows(d), options.confidence);
  result.total = estimates(index.segment(d, d), resampled.middleRows(d, d), options.confidence);
  const Eigen::Index pairs = index.size() - 2 * d;
  if (options.second_order)
    result.second =
        pairs_of(estimates(index.tail(pairs), resampled.bottomRows(pairs), options.confidence), d);
  return result;
}

/// The table of one response, pairs with a failure left out: pairs x blocks.
inline Eigen::MatrixXd pair_values(const Evaluations& runs, Eigen::Index n, Eigen::Index response) {
  const auto blocks = static_cast<Eigen::Index>(runs.rows.size()) / n;
  Eigen::MatrixXd Y(n, blocks);
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    bool whole = true;
    for (Eigen::Index b = 0; b < blocks; ++b) {
      const Outcome& outcome = runs.rows[static_cast<std::size_t>(b * n + i)].outcome;
      whole = whole && !outcome.failed();
      if (whole) Y(kept, b) = outcome.values()[response];
    }
    kept += whole;
  }
  return Y.topRows(kept);
}

}  // namespace detail

/// Makes samples·(d + 2) runs, or samples·(2d + 2), and estimates the indices of every response. A stopped
/// evaluation (options.evaluate.stop) gives too_few_runs. Throws std::invalid_argument for options out of
/// range, and as evaluate does. Equal input gives equal bits on any number of threads.
template <class F>
Sensitivity sobol_indices(const F& f, const Problem& problem, const SobolIndicesOptions& options = {}) {
  require_black_box<F>();
  check(problem);
  detail::check_sensitivity(options);
  const Eigen::MatrixXd X = detail::saltelli_design(problem, options);
  Sensitivity result{{}, 0, evaluate(f, problem, X, options.evaluate)};
  const bool whole = static_cast<Eigen::Index>(result.runs.rows.size()) == X.rows();
  for (std::size_t r = 0; r < problem.responses.size(); ++r) {
    Eigen::MatrixXd Y(0, X.rows() / options.samples);
    if (whole) Y = detail::pair_values(result.runs, options.samples, static_cast<Eigen::Index>(r));
    result.pairs = static_cast<int>(Y.rows());
    result.responses.push_back(detail::indices_of(problem.responses[r].name, std::move(Y), options));
  }
  return result;
}

}  // namespace drawpoint::doe
