// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Improves a Latin design by exchanges: simulated annealing, or pure descent from a start that is already
/// good.
///
/// A sweep tries movable·d/2 exchanges: a variable in turn and two rows at random swap their values, so the
/// design stays Latin. An exchange that adds Δ to the criterion's value V > 0 is kept when Δ <= -T·V·ln(1 -
/// u), u uniform in [0, 1) (Metropolis). T falls geometrically by a factor of 1000 over the first four fifths
/// of the sweeps and is 0 in the last fifth; at T = 0 the search ends early when five sweeps together gained
/// less than 1e-4 V. The work is counted in sweeps, never in seconds, so that equal input gives equal bits.
/// Cost of a sweep: O(n² d²). Morris, Mitchell 1995, "Exploratory designs for computational experiments".

#include <Eigen/Core>
#include <cmath>

#include <drawpoint/doe/detail/latin_criteria.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe::detail {

/// Which rows may swap in a variable: column j lists the movable rows, `size` after `size` of one group, and
/// rows of different groups never swap.
struct ExchangeGroups {
  Eigen::MatrixXi rows;
  int size = 0;

  /// Any two of n rows may swap in any of d variables.
  static ExchangeGroups whole(int n, Eigen::Index d) {
    return {Eigen::VectorXi::LinSpaced(n, 0, n - 1).replicate(1, d), n};
  }
};

struct AnnealingSchedule {
  int sweeps = 50;
  double temperature = 0.0;  ///< T at the start, as a share of V; 0: descent only

  double at(int sweep) const {
    const double share = sweep / (0.8 * sweeps);
    return share < 1.0 ? temperature * std::pow(10.0, -3.0 * share) : 0.0;
  }
};

/// One sweep at temperature T; the criterion holds the design.
template <class Criterion>
void sweep(Criterion& criterion, const ExchangeGroups& groups, double temperature, RandomStream& random) {
  const auto n = static_cast<int>(groups.rows.rows());
  const Eigen::Index d = groups.rows.cols();
  for (Eigen::Index attempt = 0; attempt < n * d / 2; ++attempt) {
    const Eigen::Index j = attempt % d;
    const int group = random.below(n / groups.size) * groups.size;
    const int first = random.below(groups.size), step = 1 + random.below(groups.size - 1);
    const int i = groups.rows(group + first, j), k = groups.rows(group + (first + step) % groups.size, j);
    const double change = criterion.change(i, k, j);
    const double allowed =
        temperature > 0.0 ? -temperature * criterion.value() * std::log1p(-random.uniform()) : 0.0;
    if (change < allowed) criterion.exchange(i, k, j, change);
  }
  criterion.refresh();
}

/// Leaves the best design of all sweep ends, the start included, and returns its value.
template <class Criterion>
double anneal(Criterion& criterion, const ExchangeGroups& groups, const AnnealingSchedule& schedule,
              RandomStream& random) {
  Criterion best = criterion;
  if (groups.size < 2) return best.value();
  double before = criterion.value();
  for (int s = 0; s < schedule.sweeps; ++s) {
    sweep(criterion, groups, schedule.at(s), random);
    if (criterion.value() < best.value()) best = criterion;
    if (s % 5 != 4) continue;
    const bool stalled = schedule.at(s) == 0.0 && criterion.value() > (1.0 - 1e-4) * before;
    before = criterion.value();
    if (stalled) break;
  }
  criterion = std::move(best);
  return criterion.value();
}

}  // namespace drawpoint::doe::detail
