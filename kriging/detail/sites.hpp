// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A site is a point with all of its runs: rows of X that are equal. What leaves a run out leaves its site
/// out, since a repeat gives the answer away.

#include <Eigen/Core>
#include <algorithm>
#include <iterator>
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

/// Whether there are repeats, and all of them give what the first run of their site gave: no chance is at work.
inline bool repeats_agree(const std::vector<std::vector<Eigen::Index>>& sites, const Eigen::VectorXd& y) {
  if (static_cast<Eigen::Index>(sites.size()) == y.size()) return false;
  return std::all_of(sites.begin(), sites.end(), [&](const std::vector<Eigen::Index>& site) {
    return std::all_of(site.begin(), site.end(), [&](Eigen::Index i) { return y[i] == y[site.front()]; });
  });
}

/// Whether repeats that agree show that runs are exact: at one site at least they gave a value between the least and
/// the largest, not 0, that no other site has. Where nothing happens, at a corner of the box, noisy runs agree, too.
/// Nor may one pair of other sites in twenty be equal there: counts and rounded numbers agree by chance anywhere.
inline bool agreement_tells(const std::vector<std::vector<Eigen::Index>>& sites, const Eigen::VectorXd& y) {
  std::map<double, double> places;
  for (const std::vector<Eigen::Index>& site : sites) ++places[y[site.front()]];
  if (places.size() < 3) return false;
  places.erase(places.begin());
  places.erase(std::prev(places.end()));
  double count = 0, equal_pairs = 0;
  for (const auto& [value, times] : places) {
    count += times;
    equal_pairs += times * (times - 1);
  }
  if (20 * equal_pairs > count * (count - 1)) return false;
  return std::any_of(sites.begin(), sites.end(), [&](const std::vector<Eigen::Index>& site) {
    const double value = y[site.front()];
    const auto place = places.find(value);
    return site.size() > 1 && value != 0 && place != places.end() && place->second == 1;
  });
}

/// The first run of each site.
inline std::vector<Eigen::Index> first_runs(const std::vector<std::vector<Eigen::Index>>& sites) {
  std::vector<Eigen::Index> rows;
  for (const std::vector<Eigen::Index>& site : sites) rows.push_back(site.front());
  return rows;
}

}  // namespace drawpoint::kriging::detail
