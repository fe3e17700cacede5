// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The answer to a question about a front: which of its points.

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace drawpoint::pareto {

enum class ChoiceStatus {
  found,
  none_meets,  ///< no point meets the conditions: `row` is the nearest to meeting them
  empty_front  ///< there is nothing to choose from: `row` is -1
};

inline std::string_view to_string(ChoiceStatus status) {
  switch (status) {
    case ChoiceStatus::found:
      return "found";
    case ChoiceStatus::none_meets:
      return "none_meets";
    case ChoiceStatus::empty_front:
      return "empty_front";
  }
  return "unknown";
}

struct Choice {
  ChoiceStatus status = ChoiceStatus::found;
  int row = -1;                                             ///< of the front
  double value = std::numeric_limits<double>::quiet_NaN();  ///< what the row was chosen by
  std::vector<int> ranking;                                 ///< rows that may be chosen, the best first
  std::string message;                                      ///< empty when found
};

namespace detail {

/// `rows` by rising cost (one entry per row of the front); the earlier row wins a tie.
inline std::vector<int> ranked(std::vector<int> rows, const Eigen::VectorXd& cost) {
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return cost[a] < cost[b]; });
  return rows;
}

inline std::vector<int> all_rows(Eigen::Index n) {
  std::vector<int> rows(static_cast<std::size_t>(n));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

inline Choice nothing_to_choose() {
  return {
      ChoiceStatus::empty_front, -1, std::numeric_limits<double>::quiet_NaN(), {}, "the front has no points"};
}

/// The row of least cost.
inline Choice cheapest(const Eigen::VectorXd& cost) {
  Choice choice;
  choice.ranking = ranked(all_rows(cost.size()), cost);
  choice.row = choice.ranking.front();
  choice.value = cost[choice.row];
  return choice;
}

}  // namespace detail
}  // namespace drawpoint::pareto
