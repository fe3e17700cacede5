// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Points shared out among directions so that no direction and no point would both rather have each other.
///
/// Each direction asks for the points in the order in which they serve it; a point that is asked twice goes
/// to the direction that it lies nearer to (Gale, Shapley 1962, "College admissions and the stability of
/// marriage"; for MOEA/D: Li, Zhang, Kwong, Li, Wang 2014, "Stable matching-based selection in evolutionary
/// multiobjective optimization"). A good point so gets a direction that keeps it, and no point gets two. Cost
/// at most k n questions.

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

namespace drawpoint::pareto::detail {

/// choices: for each of k directions all n >= k points, the best first; distance: k x n, of point from
/// direction. Returns the point of each direction; of two at one distance the later direction loses.
inline std::vector<int> stable_matching(const std::vector<std::vector<int>>& choices,
                                        const Eigen::MatrixXd& distance) {
  std::vector<int> owner(static_cast<std::size_t>(distance.cols()), -1), point(choices.size(), -1);
  std::vector<std::size_t> asked(choices.size(), 0);
  for (std::size_t first = 0; first < choices.size(); ++first)
    for (int k = static_cast<int>(first); k >= 0;) {  // whoever loses a point asks on
      const auto direction = static_cast<std::size_t>(k);
      const int i = choices[direction][asked[direction]++];
      int& holder = owner[static_cast<std::size_t>(i)];
      if (holder >= 0 &&
          (distance(holder, i) < distance(k, i) || (distance(holder, i) == distance(k, i) && holder < k)))
        continue;
      std::swap(holder, k);
      point[direction] = i;
    }
  return point;
}

}  // namespace drawpoint::pareto::detail
