// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Designs for quadratic response surfaces: central composite and Box-Behnken.
///
/// Coded units: -1 and 1 are the bounds, 0 the middle. Central composite (Box, Wilson 1951): the 2^d corners
/// or a fraction of them, 2d star points at ±α on the axes, and runs in the centre. `circumscribed` has
/// corners at the bounds and stars *outside* them (evaluate refuses such runs: widen the bounds or choose
/// another kind); `inscribed` is the same shrunk by 1/α, so that the stars are at the bounds; `face_centred`
/// has α = 1. The default α = F^(1/4), F the corner runs, makes it rotatable: the variance of a fitted
/// quadratic depends only on the distance from the centre. Box-Behnken (1960): the middles of the edges in
/// blocks of two variables (three for d = 6 and 7), no corner; tables of the paper for d up to 7, all pairs
/// beyond. Integer variables are rounded; categorical ones have no middle and are refused. Cost O(n d).

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/fractional_factorial.hpp>

namespace drawpoint::doe {

enum class CentralCompositeKind { circumscribed, inscribed, face_centred };

struct CentralCompositeOptions {
  CentralCompositeKind kind = CentralCompositeKind::inscribed;
  /// Star distance in coded units, 1 or more; empty: rotatable; face_centred ignores it.
  std::optional<double> alpha = {};
  int centre_runs = 1;  ///< 0 or more; replicates tell the noise, a deterministic simulator needs one
  std::vector<std::string> generators = {};  ///< of a fraction of the corners, at best of resolution V
};

struct BoxBehnkenOptions {
  int centre_runs = 1;  ///< as above
};

namespace detail {

inline void check_response_surface(const std::string& place, const Problem& problem, int centre_runs) {
  check(problem);
  for (const Variable& v : problem.variables)
    if (v.kind == VariableKind::categorical)
      throw std::invalid_argument(
          place + ": variable \"" + v.name +
          "\" is categorical and has no middle; make one design for each of its levels");
  if (centre_runs < 0)
    throw std::invalid_argument(place + ": centre_runs is " + std::to_string(centre_runs) +
                                "; allowed is 0 or more");
}

/// Coded units to natural ones, beyond the bounds too.
inline Eigen::MatrixXd coded_to_natural(Eigen::MatrixXd coded, const Problem& problem) {
  for (Eigen::Index j = 0; j < coded.cols(); ++j) {
    const Variable& v = problem.variables[static_cast<std::size_t>(j)];
    for (double& x : coded.col(j)) {
      if (x == -1.0 || x == 1.0)
        x = x < 0.0 ? v.lower : v.upper;
      else
        x = v.lower + 0.5 * (x + 1.0) * (v.upper - v.lower);
      if (is_discrete(v)) x = std::round(x);
    }
  }
  return coded;
}

/// Pairs or triples of variables that move together.
inline std::vector<std::vector<int>> box_behnken_blocks(int d) {
  if (d == 6) return {{0, 1, 3}, {1, 2, 4}, {2, 3, 5}, {0, 3, 4}, {1, 4, 5}, {0, 2, 5}};
  if (d == 7) return {{3, 4, 5}, {0, 5, 6}, {1, 4, 6}, {0, 1, 3}, {2, 3, 6}, {0, 2, 4}, {1, 2, 5}};
  std::vector<std::vector<int>> pairs;
  for (int j = 0; j < d; ++j)
    for (int k = j + 1; k < d; ++k) pairs.push_back({j, k});
  return pairs;
}

}  // namespace detail

/// (corners + 2d + centre_runs) x d: corners, then stars (lower, upper of each variable), then centres.
/// Throws std::invalid_argument on a categorical variable or an option out of range.
inline Eigen::MatrixXd central_composite(const Problem& problem,
                                         const CentralCompositeOptions& options = {}) {
  const std::string place = "doe::central_composite";
  detail::check_response_surface(place, problem, options.centre_runs);
  if (options.alpha && !(*options.alpha >= 1.0 && std::isfinite(*options.alpha)))
    throw std::invalid_argument(place + ": alpha is " + detail::number_text(*options.alpha) +
                                "; allowed is 1 or more; leave it out for the rotatable design");
  Problem coded = problem;
  for (Variable& v : coded.variables) v = {v.name, "1", -1.0, 1.0};
  const Eigen::MatrixXd corners = fractional_factorial(coded, options.generators);
  const Eigen::Index d = corners.cols(), factorial = corners.rows();
  double alpha = options.alpha.value_or(std::pow(static_cast<double>(factorial), 0.25));
  if (options.kind == CentralCompositeKind::face_centred) alpha = 1.0;
  const bool inscribed = options.kind == CentralCompositeKind::inscribed;
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(factorial + 2 * d + options.centre_runs, d);
  C.topRows(factorial) = inscribed ? corners / alpha : corners;
  for (Eigen::Index j = 0; j < d; ++j) {
    C(factorial + 2 * j, j) = inscribed ? -1.0 : -alpha;
    C(factorial + 2 * j + 1, j) = inscribed ? 1.0 : alpha;
  }
  return detail::coded_to_natural(std::move(C), problem);
}

/// n x d: each block's combinations of the bounds with the other variables in the middle, then centres. Runs
/// without centres: 12, 24, 40, 48, 56 for d = 3..7 and 2d(d - 1) beyond. Throws std::invalid_argument when d
/// < 3, on a categorical variable or an option out of range.
inline Eigen::MatrixXd box_behnken(const Problem& problem, const BoxBehnkenOptions& options = {}) {
  const std::string place = "doe::box_behnken";
  detail::check_response_surface(place, problem, options.centre_runs);
  const auto d = static_cast<int>(problem.variables.size());
  if (d < 3)
    throw std::invalid_argument(place + ": the problem has " + std::to_string(d) +
                                " variables; allowed is 3 or more; use central_composite");
  const auto blocks = detail::box_behnken_blocks(d);
  const auto size = static_cast<int>(blocks.front().size());
  const Eigen::Index of_block = Eigen::Index{1} << size;
  Eigen::MatrixXd C =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(blocks.size()) * of_block + options.centre_runs, d);
  Eigen::Index row = 0;
  for (const std::vector<int>& block : blocks)
    for (Eigen::Index combination = 0; combination < of_block; ++combination, ++row)
      for (int k = 0; k < size; ++k)
        C(row, block[static_cast<std::size_t>(k)]) = (combination >> (size - 1 - k) & 1) != 0 ? 1.0 : -1.0;
  return detail::coded_to_natural(std::move(C), problem);
}

}  // namespace drawpoint::doe
