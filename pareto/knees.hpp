// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Knees: points of a front from which every further gain is dear.
///
/// F: the objectives minimised and scaled to 0..1 on the front (normalized.hpp). Strength of point i:
/// * distance: (1 - Σ_j F_ij)/√m, how far the point bulges from the plane Σ F_j = 1 towards the ideal point.
///   For two objectives that is the line through the two ends (Das 1999, "On characterizing the knee of the
///   Pareto curve based on normal-boundary intersection"); for more, the plane of equal weights stands in for
///   the one through the extreme points, which need not be unique. A knee has a strength above 0.
/// * trade_off: min over neighbours k of Σ_j max(F_kj - F_ij, 0) / Σ_j max(F_ij - F_kj, 0), what must be
///   given up for one unit of gain, at the best offer (Rachmawati, Srinivasan 2009, IEEE TEC 13(4), 810-824).
///   1 on a straight front, above 1 at a knee. Needs no convexity and finds knees in any number of
///   objectives.
/// A knee is a point at least as strong as all its neighbours: the k nearest in F, or the whole front. Cost
/// O(n² m).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <drawpoint/pareto/choice.hpp>
#include <drawpoint/pareto/detail/normalized.hpp>

namespace drawpoint::pareto {

enum class KneeMeasure { distance, trade_off };

struct KneeOptions {
  KneeMeasure measure = KneeMeasure::trade_off;  ///< the one that holds for bent and dented fronts alike
  /// k, 1 or more; none: all points, so that there is one knee; 10 to 20 finds local ones.
  std::optional<int> neighbours{};
};

enum class KneeStatus { found, no_knee, too_few_points };

inline std::string_view to_string(KneeStatus status) {
  switch (status) {
    case KneeStatus::found:
      return "found";
    case KneeStatus::no_knee:
      return "no_knee";
    case KneeStatus::too_few_points:
      return "too_few_points";
  }
  return "unknown";
}

struct Knees {
  KneeStatus status = KneeStatus::found;
  std::vector<int> rows;     ///< of the front, the strongest first
  Eigen::VectorXd strength;  ///< n
  std::string message;       ///< empty when found
};

namespace detail {

/// The k nearest other rows of F, or all of them without k; the earlier row wins a tie.
inline std::vector<int> neighbours_of(const Eigen::MatrixXd& F, int i, const std::optional<int>& k) {
  std::vector<int> rows = all_rows(F.rows());
  rows.erase(rows.begin() + i);
  if (!k || *k >= static_cast<int>(rows.size())) return rows;
  const Eigen::VectorXd distance = (F.rowwise() - F.row(i)).rowwise().squaredNorm();
  rows = ranked(std::move(rows), distance);
  rows.resize(static_cast<std::size_t>(*k));
  return rows;
}

/// What point i gives up per unit gained by the best move to another; infinity when no move gains.
inline double price_of_leaving(const Eigen::MatrixXd& F, int i, const std::vector<int>& others) {
  double least = std::numeric_limits<double>::infinity();
  for (const int k : others) {
    const auto change = (F.row(k) - F.row(i)).array();
    const double gain = (-change).max(0.0).sum();
    if (gain > 0.0) least = std::min(least, change.max(0.0).sum() / gain);
  }
  return least;
}

inline Knees too_few_points(Eigen::Index rows, const std::string& points) {
  return {KneeStatus::too_few_points,
          {},
          Eigen::VectorXd::Zero(rows),
          "the front has " + points + "; a knee needs 3 or more"};
}

}  // namespace detail

/// Throws std::invalid_argument for a front of another problem and for neighbours < 1. A knee must exceed a
/// straight front by more than 1e-9, so that rounding makes none.
inline Knees knees(const doe::Problem& problem, const Front& front, const KneeOptions& options = {}) {
  constexpr double rounding = 1e-9;
  detail::check_front("pareto::knees: ", problem, front);
  const int k = options.neighbours.value_or(1);
  detail::check_range("pareto::knees: ", "neighbours", k, k >= 1, "1 or more; leave it out for all");
  Knees result;
  const auto n = static_cast<int>(front.Y.rows());
  if (n < 3) return detail::too_few_points(n, std::to_string(n) + " points");
  const Eigen::MatrixXd F = detail::normalized(problem, front).F;
  if (F.isZero(0.0)) return detail::too_few_points(n, "one point, " + std::to_string(n) + " times");
  const bool by_distance = options.measure == KneeMeasure::distance;
  std::vector<std::vector<int>> near;
  for (int i = 0; i < n; ++i) near.push_back(detail::neighbours_of(F, i, options.neighbours));
  result.strength = (1.0 - F.rowwise().sum().array()) / std::sqrt(static_cast<double>(F.cols()));
  if (!by_distance)
    for (int i = 0; i < n; ++i) result.strength[i] = detail::price_of_leaving(F, i, near[i]);
  for (int i = 0; i < n; ++i) {
    const auto& s = result.strength;
    const bool strongest = std::all_of(near[i].begin(), near[i].end(), [&](int k) { return s[i] >= s[k]; });
    if (strongest && s[i] > (by_distance ? 0.0 : 1.0) + rounding) result.rows.push_back(i);
  }
  result.rows = detail::ranked(std::move(result.rows), -result.strength);
  if (result.rows.empty()) {
    result.status = KneeStatus::no_knee;
    result.message = "the front is straight or bulges away from the ideal point: no point stands out";
  }
  return result;
}

}  // namespace drawpoint::pareto
