// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Where the parameters of a correlation stand in p = (ln θ, exponents where they are estimated, vₖ of the
/// weights of a sum, ln λ).
///
/// There is one θ, and one exponent, per variable; isotropic, all variables that are numbers share theirs.

#include <Eigen/Core>
#include <cstddef>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/levels.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

struct ParameterPlaces {
  std::vector<Index> thetas;  ///< per variable the place of its ln θ
  Index theta_count = 0;
  bool exponents = false, weights = false;

  Index variables() const { return static_cast<Index>(thetas.size()); }
  Index theta(Index k) const { return thetas[static_cast<std::size_t>(k)]; }
  Index exponent(Index k) const { return theta_count + theta(k); }
  Index weight(Index k) const { return theta_count * (exponents ? 2 : 1) + k; }
  Index count() const { return weight(weights ? variables() : 0) + 1; }
  /// Whether no variable before k has the same θ.
  bool leads(Index k) const {
    for (Index before = 0; before < k; ++before)
      if (theta(before) == theta(k)) return false;
    return true;
  }
};

inline ParameterPlaces parameter_places(const CorrelationFunction& f, Index d, bool exponents) {
  ParameterPlaces places;
  places.exponents = exponents;
  places.weights = f.structure == Structure::additive;
  Index shared = -1;
  for (Index k = 0; k < d; ++k) {
    const bool shares = f.structure == Structure::isotropic && !is_category(f.levels, k);
    const bool joins = shares && shared >= 0;
    places.thetas.push_back(joins ? shared : places.theta_count);
    if (joins) continue;
    if (shares) shared = places.theta_count;
    ++places.theta_count;
  }
  return places;
}

/// Those of `count` parameters, of which the exponents may be some.
inline ParameterPlaces places_among(const CorrelationFunction& f, Index d, Index count) {
  const ParameterPlaces places = parameter_places(f, d, false);
  return places.count() == count ? places : parameter_places(f, d, true);
}

}  // namespace drawpoint::kriging::detail
