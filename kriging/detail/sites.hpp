// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A site is a point with all of its runs: rows of X that are equal. What leaves a run out leaves its site
/// out, since a repeat gives the answer away.

#include <Eigen/Core>
#include <map>
#include <vector>

namespace drawpoint::kriging::detail {

/// For each distinct row of X the indices of its rows, ascending, in the order of the first.
inline std::vector<std::vector<Eigen::Index>> sites_of(const Eigen::MatrixXd& X) {
  std::map<std::vector<double>, std::size_t> known;
  std::vector<std::vector<Eigen::Index>> sites;
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    std::vector<double> row(static_cast<std::size_t>(X.cols()));
    for (Eigen::Index k = 0; k < X.cols(); ++k) row[static_cast<std::size_t>(k)] = X(i, k);
    const auto [place, fresh] = known.try_emplace(row, sites.size());
    if (fresh) sites.emplace_back();
    sites[place->second].push_back(i);
  }
  return sites;
}

}  // namespace drawpoint::kriging::detail
