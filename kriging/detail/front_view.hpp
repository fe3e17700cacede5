// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The front of runs, and a reference point beyond it, for improvements of hypervolume. All objectives are minimised.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/dense.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

/// Whether row b of Y (n x m) adds nothing to row a: it is at most as good in every objective. Alike rows count once.
inline bool covers(const Eigen::MatrixXd& Y, Eigen::Index a, Eigen::Index b) {
  bool better = false;
  for (Eigen::Index k = 0; k < Y.cols(); ++k) {
    if (Y(a, k) > Y(b, k)) return false;
    better = better || Y(a, k) < Y(b, k);
  }
  return better || a < b;
}

/// Gives those of the rows of Y that no other of them covers. Cost rows² m.
inline std::vector<Eigen::Index> front_rows(const Eigen::MatrixXd& Y, const std::vector<Eigen::Index>& rows) {
  std::vector<Eigen::Index> front;
  for (const Eigen::Index i : rows)
    if (std::none_of(rows.begin(), rows.end(),
                     [&](Eigen::Index other) { return other != i && covers(Y, other, i); }))
      front.push_back(i);
  return front;
}

/// The point lies as far beyond the front, rows of Y, as that is long, but no farther than the worst of all runs: early
/// fronts are short, and what would make them longer is worth something, while places that are far from the front are
/// worth nothing. Two or three runs may lie at nearly one value of an objective: their front counts as a tenth of the
/// extent of all runs at least, and one without extent as all of it. Where the worst run ends the front, a tenth of all
/// runs' extent beyond.
inline Eigen::VectorXd reference_beyond(const Eigen::MatrixXd& Y, const std::vector<Eigen::Index>& front) {
  Eigen::VectorXd reference(Y.cols());
  for (Eigen::Index k = 0; k < Y.cols(); ++k) {
    const Eigen::VectorXd all = Y.col(k), best = entries_of(all, front);
    const double low = smallest_entry(best), high = largest_entry(best), worst = largest_entry(all);
    const double size = std::max(std::abs(smallest_entry(all)), std::abs(worst));
    const double of_all = std::max(worst - smallest_entry(all), 1e-9 * (size > 0 ? size : 1.0));
    const double extent = high > low ? std::max(high - low, 0.1 * of_all) : of_all;
    reference[k] = worst > high ? std::min(worst, high + extent) : high + 0.1 * of_all;
  }
  return reference;
}

}  // namespace drawpoint::kriging::detail
