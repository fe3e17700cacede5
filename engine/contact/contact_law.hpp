// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

/// The SPOOK discretisation of one compliant, damped unilateral contact (C. Lacoursière, "Ghosts and
/// Machines", 2007).
///
/// ε λ_f + g + τ ġ = 0 with ε = 1/k, averaged over three steps, becomes for the impulse λ = h λ_f
///     0 ≤ λ ⊥ G v⁺ + Σ λ − b ≥ 0,   Σ = 4 / (h² k (1 + 4τ/h)),   b = Υ (G v⁻ − 4 g / h),   Υ = 1 / (1 +
///     4τ/h).
/// Two departures, both for e = 0 contacts: an approach faster than `impact_speed` is an impact, which takes
/// the whole approach speed (b without the G v⁻ term, so that nothing bounces); and an open gap g > 0 only
/// limits the approach to what closes it within the step, b = −g/h, so that near contacts do nothing before
/// they touch.
namespace drawpoint::engine::contact {

constexpr double impact_speed =
    0.05;  ///< [m/s]; slower approaches are resting contact and keep their damping

struct SpookTerms {
  double sigma;   ///< Σ [m/s per N s]
  double target;  ///< b [m/s]
};

/// gap [m] (negative: overlap), approach = G v⁻ [m/s] (negative: closing), k [N/m], τ [s] (used: at least 2
/// h), h [s].
inline SpookTerms spook(double gap, double approach, double k, double tau, double h) {
  const double upsilon = 1.0 / (1.0 + 4.0 * std::max(tau, 2.0 * h) / h);
  const double sigma = 4.0 * upsilon / (h * h * k);
  if (gap > 0) return {sigma, -gap / h};
  const double damping = approach < -impact_speed ? 0.0 : approach;
  return {sigma, upsilon * (damping - 4.0 * gap / h)};
}

}  // namespace drawpoint::engine::contact
