// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The largest of many numbers: of the correlations with a place, the runs that tell most of it. Correlations
/// are distances in the present length scales, for all families and for categories alike.

#include <Eigen/Core>
#include <algorithm>
#include <drawpoint/kriging/detail/dense.hpp>
#include <functional>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// Indices of the `most` largest of n numbers, or of all, ascending; of equal ones the earlier.
inline std::vector<int> largest_of(const std::vector<double>& numbers, Index n, Index most) {
  std::vector<std::pair<double, int>> heap;  // (number, −index), the least on top
  const auto later = std::greater<>();
  for (Index j = 0; j < n; ++j) {
    const double number = numbers[static_cast<std::size_t>(j)];
    const bool full = static_cast<Index>(heap.size()) == most;
    if (full && !(number > heap.front().first)) continue;
    if (full) {
      std::pop_heap(heap.begin(), heap.end(), later);
      heap.pop_back();
    }
    heap.emplace_back(number, -static_cast<int>(j));
    std::push_heap(heap.begin(), heap.end(), later);
  }
  std::vector<int> indices;
  for (const auto& entry : heap) indices.push_back(-entry.second);
  std::sort(indices.begin(), indices.end());
  return indices;
}

}  // namespace drawpoint::kriging::detail
