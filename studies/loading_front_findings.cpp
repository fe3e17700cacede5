// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading_front_findings.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace drawpoint::studies {
namespace {

using namespace of_loading;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double beyond_all = std::numeric_limits<double>::infinity();

// Where alpha does not matter, a point of the front lies above 1.5 as often as a run does.
Finding f2(const LoadingRuns& runs) {
  const VectorXd front = runs.front_x(alpha), all = runs.x(alpha);
  const double chance = all.size() == 0 ? 0 : (all.array() > 1.5).cast<double>().mean();
  const int beyond = static_cast<int>((front.array() > 1.5).count());
  Estimate spared;
  if (front.size() >= least_group && chance > 0) {
    const Estimate there = share(beyond, static_cast<int>(front.size()));
    spared = {chance - there.value, there.error};
  }
  return decided(
      "F2", "Beyond alpha 1.2 production falls, and fewer Pareto points than by chance have alpha above 1.5",
      {{"production at 0.9 to 1.3 over that above 1.5, in standard deviations",
        mean_difference(runs.within(production, alpha, 0.9, 1.3),
                        runs.within(production, alpha, 1.5, beyond_all)),
        small_difference},
       {std::to_string(beyond) + " of " + std::to_string(front.size()) +
            " non-dominated runs above 1.5; share of all runs there less that of these",
        spared, chance / 2}});
}

Finding f10(const LoadingRuns& runs) {
  const VectorXd p = runs.front_y(production), d = runs.front_y(damage), s = runs.front_y(spill);
  return decided("F10", "On the front production competes with damage and with spill, which rise together",
                 {{"rank correlation of production and damage", rank_correlation(p, d), small_correlation},
                  {"of production and spill", rank_correlation(p, s), small_correlation},
                  {"of damage and spill", rank_correlation(d, s), small_correlation}});
}

// Low in both: in the lowest third of the runs in damage, and in that of spill. Sure: runs of low alpha are
// low more often; only: most that are low have it.
Finding f11(const LoadingRuns& runs) {
  int low = 0, rest = 0, low_corner = 0, rest_corner = 0;
  const auto threshold = [&](Index r) {
    VectorXd v = runs.y(r);
    std::sort(v.data(), v.data() + v.size());
    return v.size() == 0 ? 0 : v[v.size() / 3];
  };
  const double d = threshold(damage), s = threshold(spill);
  const VectorXd a = runs.x(alpha), y_d = runs.y(damage), y_s = runs.y(spill);
  for (Index i = 0; i < runs.runs(); ++i) {
    const bool corner = y_d[i] <= d && y_s[i] <= s;
    if (a[i] < runs.third(alpha, 1))
      ++low, low_corner += corner;
    else
      ++rest, rest_corner += corner;
  }
  Estimate only;
  if (low_corner + rest_corner >= least_group) {
    only = share(low_corner, low_corner + rest_corner);
    only.value -= 0.5;
  }
  return decided("F11", "Low alpha is the only sure way to minimal damage and spill",
                 {{"share of runs low in both, lowest third of alpha less the rest",
                   share_difference(low_corner, low, rest_corner, rest), small_correlation},
                  {"share of these with alpha in its lowest third less a half", only}});
}

// By chance a third of them has alpha in its lowest third.
Finding f12(const LoadingRuns& runs) {
  const VectorXd a = runs.front_x(alpha), b = runs.front_x(beta), p = runs.front_y(production);
  VectorXd sorted = p;
  std::sort(sorted.data(), sorted.data() + sorted.size());
  int found = 0, low = 0;
  for (Index i = 0; i < p.size(); ++i)
    if (b[i] > runs.third(beta, 2) && p[i] < sorted[p.size() / 2]) {
      ++found;
      low += a[i] < runs.third(alpha, 1);
    }
  Estimate over_chance;
  if (found >= least_group) {
    over_chance = share(low, found);
    over_chance.value -= 1.0 / 3;
  }
  return decided(
      "F12", "Pareto points of high beta and low production exist, with low alpha more often than by chance",
      {{std::to_string(found) + " such non-dominated runs; share in the lowest third of alpha less 1/3",
        over_chance, 1.0 / 3}});
}

// The logarithm of a sample variance scatters by √(2/k), that of a ratio of two by 2/√k. A front that rises
// all the way leaves none; a millionth stands for it.
Finding f13(const LoadingRuns& runs) {
  const VectorXd p = runs.front_y(production);
  Estimate ratio;
  if (p.size() >= 10) {
    const double of_damage = std::max(rising_residual(p, runs.front_y(damage)), 1e-6),
                 of_spill = std::max(rising_residual(p, runs.front_y(spill)), 1e-6);
    ratio = {std::log(of_damage / of_spill), 2 / std::sqrt(static_cast<double>(p.size()))};
  }
  return decided("F13", "The production-spill front is smoother than the production-damage front",
                 {{"logarithm of damage's over spill's residual from a rising fit", ratio}});
}

}  // namespace

FrontFindings front_findings(const LoadingRuns& runs) {
  return {f2(runs), f10(runs), f11(runs), f12(runs), f13(runs)};
}

}  // namespace drawpoint::studies
