// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What one objective costs in another from a point of the front to the next, in natural units.
///
/// A step from row i to row k changes the objectives by Δ = y_k - y_i; Δ_a/Δ_b is the average rate between
/// the two, e.g. -12 kg/s per second of damage. loss and gain are Σ_j of what gets worse and better, each in
/// ranges of the front; price = loss/gain is 1 on a straight front. Between neighbours only: on a curved
/// front the rate at the point itself is local_trade_off (local_trade_off.hpp). Cost O(n m + n log n) per
/// call.

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/knees.hpp>

namespace drawpoint::pareto {

struct TradeOff {
  int from = 0, to = 0;    ///< rows of the front
  Eigen::VectorXd change;  ///< m, natural units and signs
  double gain = 0.0, loss = 0.0;

  /// Infinity when the step gains nothing.
  double price() const { return gain > 0.0 ? loss / gain : std::numeric_limits<double>::infinity(); }
  /// Change of objective a for a unit of objective b; NaN or infinity where b stays.
  double rate(int a, int b) const { return change[a] / change[b]; }
};

namespace detail {

inline TradeOff trade_off_between(const NormalizedFront& scaled, const Front& front, int from, int to) {
  const auto change = (scaled.F.row(to) - scaled.F.row(from)).array();
  return {from, to, (front.Y.row(to) - front.Y.row(from)).transpose(), (-change).max(0.0).sum(),
          change.max(0.0).sum()};
}

}  // namespace detail

/// From one row to its `count` nearest others (1 or more; none: all) in scaled objectives, nearest first.
/// Throws std::invalid_argument for a row that does not exist and for a front of another problem.
inline std::vector<TradeOff> trade_offs(const doe::Problem& problem, const Front& front, int row,
                                        std::optional<int> count = 4) {
  const std::string place = "pareto::trade_offs: ";
  detail::check_front(place, problem, front);
  const auto n = static_cast<int>(front.Y.rows());
  detail::check_range(place, "row", row, row >= 0 && row < n, "0 to the number of points - 1");
  detail::check_range(place, "count", count.value_or(1), count.value_or(1) >= 1,
                      "1 or more; std::nullopt for all");
  const detail::NormalizedFront scaled = detail::normalized(problem, front);
  std::vector<int> others = detail::neighbours_of(scaled.F, row, count);
  others =
      detail::ranked(std::move(others), (scaled.F.rowwise() - scaled.F.row(row)).rowwise().squaredNorm());
  std::vector<TradeOff> steps;
  for (const int k : others) steps.push_back(detail::trade_off_between(scaled, front, row, k));
  return steps;
}

/// Two objectives: the n - 1 steps along the front, from the best of the first objective to the best of the
/// second. Throws std::invalid_argument for other numbers of objectives.
inline std::vector<TradeOff> trade_offs_along(const doe::Problem& problem, const Front& front) {
  const std::string place = "pareto::trade_offs_along: ";
  detail::check_front(place, problem, front);
  const std::size_t m = detail::roles(problem).objectives.size();
  if (m != 2)
    throw std::invalid_argument(place + "the problem has " + std::to_string(m) +
                                " objectives; allowed are 2; use trade_offs for a point's neighbours");
  if (front.Y.rows() < 2) return {};
  const detail::NormalizedFront scaled = detail::normalized(problem, front);
  const std::vector<int> order = detail::sorted_points(scaled.F).order;
  std::vector<TradeOff> steps;
  for (std::size_t i = 1; i < order.size(); ++i)
    steps.push_back(detail::trade_off_between(scaled, front, order[i - 1], order[i]));
  return steps;
}

}  // namespace drawpoint::pareto
