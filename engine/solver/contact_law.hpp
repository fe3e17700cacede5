// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>

/// The SPOOK discretisation of one compliant, damped unilateral contact (C. Lacoursière, "Ghosts and
/// Machines", 2007).
///
/// ε λ_f + g + τ ġ = 0 with ε = 1/k, averaged over three steps, becomes for the impulse λ = h λ_f
///     0 ≤ λ ⊥ G v⁺ + Σ λ − b ≥ 0,   Σ = 4 Υ / (h² k),   b = Υ (G v⁻ − 4 g / h),   Υ = 1 / (1 + 4τ/h).
/// Three departures: an approach faster than `impact_speed` is an impact, which takes the whole approach speed
/// (b without the G v⁻ term, so that nothing bounces by the discretisation as long as h is not far below
/// √(m/k); restitution has its own stage); an open gap g > 0 only limits the approach to what closes it
/// within the step, b = −g/h, so that near contacts do nothing before they touch; and b ≤ `push_out_speed`, so that
/// bodies that were put into each other part slowly. h is the substep. Hertz's
/// law is the same with the secant stiffness at the overlap of the step's start, exact at rest and first
/// order in h.
namespace drawpoint::engine {

/// What a contact's law needs of its material and the substep.
struct SpookTerms {
  double upsilon = 0;  ///< Υ
  double sigma = 0;    ///< Σ [m/s per N s]
};

/// k [N/m]; τ [s], at least two whole steps: the stepper's own damping; h [s], of the substep.
inline SpookTerms spook(double k, double tau, double h) {
  const double upsilon = 1.0 / (1.0 + 4.0 * tau / h);
  return {upsilon, 4.0 * upsilon / (h * h * k)};
}

/// The secant stiffness k_n √δ of Hertz's law f = k_n δ^(3/2) at the overlap δ, k_n = (4/3) E* √R*. Overlaps
/// below `least_hertz_overlap` count as that, so that a first touch meets resistance.
inline double hertz_stiffness(double modulus, double radius, double overlap) {
  return 4.0 / 3.0 * modulus * std::sqrt(radius * std::max(overlap, constants::least_hertz_overlap));
}

}  // namespace drawpoint::engine
