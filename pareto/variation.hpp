// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Simulated binary crossover and polynomial mutation in the unit box.
///
/// Crossover (Deb, Agrawal 1995): children y = ((a + b) ∓ β (b - a))/2 with β drawn so that children stay in
/// [0, 1] and near the parents, the nearer the larger the index η_c; each variable takes part with
/// probability 1/2. Mutation (Deb, Goyal 1996): y + δ with δ from a polynomial of index η_m, cut at the
/// bounds. Both as in Deb's NSGA-II, with (u)^(1/(η+1)) as the only transcendental.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include <drawpoint/doe/seed.hpp>

namespace drawpoint::pareto::detail {

/// β for one child; `room` is the distance from the parent to its bound over the distance of the parents.
inline double sbx_spread(double room, double u, double index) {
  const double alpha = 2.0 - std::pow(1.0 + 2.0 * room, -(index + 1.0));
  const double v = u * alpha;
  return std::pow(v <= 1.0 ? v : 1.0 / (2.0 - v), 1.0 / (index + 1.0));
}

/// Crosses two numbers of [0, 1] in place.
inline void sbx(double& first, double& second, double index, doe::RandomStream& random) {
  const double a = std::min(first, second), b = std::max(first, second);
  if (b - a < 1e-14) return;  // closer than rounding resolves: children equal the parents
  const double u = random.uniform();
  double low = 0.5 * (a + b - sbx_spread(a / (b - a), u, index) * (b - a));
  double high = 0.5 * (a + b + sbx_spread((1.0 - b) / (b - a), u, index) * (b - a));
  if (random.uniform() < 0.5) std::swap(low, high);
  first = std::clamp(low, 0.0, 1.0);
  second = std::clamp(high, 0.0, 1.0);
}

/// Mutates one number of [0, 1].
inline double polynomial_mutation(double y, double index, doe::RandomStream& random) {
  const double u = random.uniform(), power = index + 1.0;
  const double delta =
      u < 0.5 ? std::pow(2.0 * u + (1.0 - 2.0 * u) * std::pow(1.0 - y, power), 1.0 / power) - 1.0
              : 1.0 - std::pow(2.0 * (1.0 - u) + (2.0 * u - 1.0) * std::pow(y, power), 1.0 / power);
  return std::clamp(y + delta, 0.0, 1.0);
}

}  // namespace drawpoint::pareto::detail
