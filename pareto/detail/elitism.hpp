// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Controlled elitism: how many places each front gets in the next population.
///
/// Front i of K may have N_i = N (1 - r)/(1 - r^K) r^(i-1) of N places, 0 <= r < 1; what it cannot fill
/// passes to the next front, and what is left after the last front is filled from the best front down (Deb,
/// Goel 2001, "Controlled elitist non-dominated sorting genetic algorithms for better convergence"). Keeping
/// some dominated points keeps directions across the front alive. r = 0 is plain NSGA-II: the best front
/// first, to the last place.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace drawpoint::pareto {

/// sizes: points in each front from the best; places: N >= 0; ratio: r. Returns the places each front gets:
/// never more than its size, together min(N, all points).
inline std::vector<int> elitist_places(const std::vector<int>& sizes, int places, double ratio) {
  const auto K = static_cast<double>(sizes.size());
  std::vector<int> taken(sizes.size(), 0);
  double quota = places * (1.0 - ratio) / (1.0 - std::pow(ratio, K));
  int left = places, slack = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const int allowed = std::min(static_cast<int>(std::lround(quota)) + slack, left);
    taken[i] = std::min(allowed, sizes[i]);
    slack = allowed - taken[i];
    left -= taken[i];
    quota *= ratio;
  }
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const int more = std::min(left, sizes[i] - taken[i]);
    taken[i] += more;
    left -= more;
  }
  return taken;
}

/// gamultiobj's form, as its documentation states it: the best front gets at most the share `fraction` of the
/// places, rounded up, the others follow in order, and what they cannot fill goes back to the best. sizes and
/// places as above, 0 < fraction <= 1.
inline std::vector<int> fraction_places(const std::vector<int>& sizes, int places, double fraction) {
  std::vector<int> taken(sizes.size(), 0);
  int left = places;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const int allowed = i == 0 ? static_cast<int>(std::ceil(fraction * places)) : left;
    taken[i] = std::min({allowed, sizes[i], left});
    left -= taken[i];
  }
  if (!sizes.empty()) taken[0] += std::min(left, sizes[0] - taken[0]);
  return taken;
}

}  // namespace drawpoint::pareto
