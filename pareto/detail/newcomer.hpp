// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The ranking of a population that one point joins, from the ranking of the others.
///
/// The newcomer joins the first front of which no point dominates it. What it dominates there moves to the
/// next front, what that dominates there to the one after, until nothing moves (Li, Deb, Zhang, Kwong 2017,
/// "Efficient nondomination level update method for steady-state evolutionary multiobjective optimization").
/// The fronts are those of the sort (population.hpp). Cost O(m n) where few points move.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/population.hpp>

namespace drawpoint::pareto::detail {

/// The ranking of the survivors `rows` among themselves, from the ranking of all n. None unless all are feasible,
/// `rows` lists those of a front in rising order, and every front but their last is whole: else some may have
/// risen.
inline std::optional<Ranking> ranking_of_survivors(const Ranking& ranking, const std::vector<int>& rows,
                                                   Eigen::Index n) {
  std::vector<int> place(static_cast<std::size_t>(n), -1);
  for (std::size_t k = 0; k < rows.size(); ++k)
    place[static_cast<std::size_t>(rows[k])] = static_cast<int>(k);
  Ranking left;
  std::size_t ranked = 0;
  for (std::size_t f = 0; f < ranking.feasible && ranked < rows.size(); ++f) {
    const std::vector<int>& front = ranking.fronts[f];
    std::vector<int>& own = left.fronts.emplace_back();
    for (const int i : front)
      if (const int k = place[static_cast<std::size_t>(i)]; k >= 0) own.push_back(k);
    ranked += own.size();
    const bool whole = own.size() == front.size();
    if ((!whole && ranked < rows.size()) || !std::is_sorted(own.begin(), own.end())) return std::nullopt;
  }
  if (ranked < rows.size()) return std::nullopt;
  left.feasible = left.fronts.size();
  return left;
}

/// One entry per row but the last: 1 where it dominates the last one, -1 where the last one dominates it, else 0.
inline std::vector<signed char> against_the_last(const Eigen::MatrixXd& Y) {
  const auto last = static_cast<std::size_t>(Y.rows()) - 1;
  std::vector<signed char> lower(last, 0), higher(last, 0);  // in any objective
  for (Eigen::Index j = 0; j < Y.cols(); ++j) {
    const double* y = Y.col(j).data();
    for (std::size_t i = 0; i < last; ++i) {
      lower[i] |= y[i] < y[last];
      higher[i] |= y[i] > y[last];
    }
  }
  for (std::size_t i = 0; i < last; ++i) lower[i] -= higher[i];
  return lower;
}

template <class Goes>
std::vector<int> taken_out(std::vector<int>& rows, const Goes& goes) {
  std::vector<int> taken;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(taken), goes);
  if (!taken.empty()) std::erase_if(rows, goes);
  return taken;
}

/// others: the ranking of all rows but the last, feasible ones. Returns what `rank` would.
inline Ranking rank_with_newcomer(const Population& p, Ranking others) {
  const auto last = static_cast<int>(p.size()) - 1;
  if (!p.feasible(last)) {
    others.fronts.push_back({last});
    return others;
  }
  const std::vector<signed char> relation = against_the_last(p.Y);
  const auto of = [&](int i) { return relation[static_cast<std::size_t>(i)]; };
  auto front = std::find_if(others.fronts.begin(), others.fronts.end(), [&](const std::vector<int>& rows) {
    return std::none_of(rows.begin(), rows.end(), [&](int i) { return of(i) > 0; });
  });
  std::vector<int> moving{last};
  while (!moving.empty() && front != others.fronts.end()) {
    const auto is_beaten = [&](int i) {
      if (moving.front() == last) return of(i) < 0;
      return std::any_of(moving.begin(), moving.end(),
                         [&](int k) { return dominates(p.Y.row(k), p.Y.row(i)); });
    };
    std::vector<int> beaten = taken_out(*front, is_beaten);
    const auto middle = front->insert(front->end(), moving.begin(), moving.end());
    std::inplace_merge(front->begin(), middle, front->end());
    moving = std::move(beaten);
    ++front;
  }
  if (!moving.empty()) others.fronts.push_back(std::move(moving));
  others.feasible = others.fronts.size();
  return others;
}

}  // namespace drawpoint::pareto::detail
