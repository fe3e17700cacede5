// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The blocks that Vecchia's likelihood is a product of, each with its neighbours.
///
/// Blocks are cells (cells.hpp), in random order: most of them have neighbours on all sides.

#include <Eigen/Core>
#include <cstddef>
#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/kriging/detail/nearest/cells.hpp>
#include <drawpoint/kriging/detail/nearest/conditional.hpp>
#include <drawpoint/kriging/detail/parallel.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

/// Blocks for so many neighbours: an eighth leaves neighbours on all sides.
inline Index runs_of_cell(Index neighbours) { return std::max<Index>(neighbours / 8, 1); }

/// One family a cell of `cells` of the rows of X: n x d, scaled; each with the `neighbours` runs of earlier
/// cells that are most correlated with its middle, or all. Cost n d/2 a cell.
inline std::vector<Family> families_of(const Eigen::MatrixXd& X, const CorrelationFunction& f,
                                       const Cells& cells, Index neighbours, int threads) {
  doe::RandomStream random(1);
  const std::vector<int> order = doe::detail::permutation(cells.count(), random);
  std::vector<Index> sequence, start;
  for (const int cell : order) {
    start.push_back(static_cast<Index>(sequence.size()));
    sequence.insert(sequence.end(), cells.runs(cell).begin(), cells.runs(cell).end());
  }
  const Eigen::MatrixXd ordered = rows_of(X, sequence);
  std::vector<Family> families(order.size());
  for_each_task(cells.count(), threads, [&](int t) {
    const auto at = static_cast<std::size_t>(t);
    const std::vector<int>& own = cells.runs(order[at]);
    const Eigen::VectorXd middle = middle_of(X, own);
    std::vector<double> c(static_cast<std::size_t>(start[at]));
    if (start[at] > 0) correlate(f, {ordered, 0, start[at], middle.data()}, c.data());
    Family& family = families[at];
    for (const int i : largest_of(c, start[at], neighbours))
      family.rows.push_back(sequence[static_cast<std::size_t>(i)]);
    family.rows.insert(family.rows.end(), own.begin(), own.end());
    family.own = static_cast<Index>(own.size());
  });
  return families;
}

}  // namespace drawpoint::kriging::detail
