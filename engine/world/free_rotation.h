// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>

/// The turn of a rigid body over a step, its angular momentum L = R I Rᵀ ω in the world kept.
///
/// Free rotation is split into flows that are known exactly (Touma and Wisdom 1994), ℓ = RᵀL:
/// H = |L|²/2I_p + a ℓ_s²/2 + b ℓ_j²/2, a = 1/I_s − 1/I_p, b = 1/I_j − 1/I_p, p and j the two axes of nearest
/// moments. The first two are a symmetric top: a turn by hL/I_p in the world and by h a ℓ_s about axis s; the
/// third, a turn by h b ℓ_j about axis j, stands between two halves of them. Exact for needles and round
/// plates, whose energy any error in the direction of L would multiply by I_p/I_s; else time-reversible,
/// so energy swings by O((hω)²) and does not drift. Second order in h. Cost: about 0.1 µs, nothing at rest.
///
/// What the solver's turn ∫ω dt has beyond hω, because contacts changed ω within the step, is turned as well.
/// That costs O(hΔω) in energy, times up to I_p/I_s for slender bodies: where energy would rise by more than
/// a tenth, L turns along, which keeps energy and changes the direction of L by the extra turn.
namespace drawpoint::engine {

inline Eigen::Quaterniond rotation_of(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
}

/// The attitude q after a time h of free rotation with angular momentum L [N m s] in the world.
inline Eigen::Quaterniond freely_rotated(const Eigen::Quaterniond& q, const Eigen::Vector3d& inertia,
                                         const Eigen::Vector3d& momentum, double h) {
  const Eigen::Vector3d inverse = inertia.cwiseInverse();
  const auto apart = [&](int k) { return std::abs(inverse[(k + 1) % 3] - inverse[(k + 2) % 3]); };
  int s = 0;  // opposite to the nearest pair
  for (int k = 1; k < 3; ++k)
    if (apart(k) < apart(s)) s = k;
  const int p = (s + 1) % 3, j = (s + 2) % 3;
  Eigen::Quaterniond body = q;
  const auto turn_about = [&](int axis, double rate, double time) {
    const double along = (body.conjugate() * momentum)[axis];
    body = body * Eigen::Quaterniond(Eigen::AngleAxisd(time * rate * along, Eigen::Vector3d::Unit(axis)));
  };
  turn_about(s, inverse[s] - inverse[p], 0.5 * h);
  turn_about(j, inverse[j] - inverse[p], h);
  turn_about(s, inverse[s] - inverse[p], 0.5 * h);
  return rotation_of(h * inverse[p] * momentum) * body;
}

/// q: attitude; inertia: principal [kg m²]; w: angular velocity in the world after the step's impulses
/// [rad/s]; turn: the solver's ∫ω dt [rad]; h [s]. Changes q and w.
inline void rotate_freely(Eigen::Quaterniond& q, const Eigen::Vector3d& inertia, Eigen::Vector3d& w,
                          const Eigen::Vector3d& turn, double h) {
  if (turn.squaredNorm() == 0) return;
  Eigen::Vector3d momentum = q * inertia.cwiseProduct(q.conjugate() * w);
  const double energy = w.dot(momentum);
  const auto rate = [&] { return Eigen::Vector3d(q * (q.conjugate() * momentum).cwiseQuotient(inertia)); };
  if (turn.squaredNorm() * inertia.maxCoeff() <
      constants::gyroscopic_angle * constants::gyroscopic_angle * inertia.minCoeff()) {
    q = (rotation_of(turn) * q).normalized();
    w = rate();
    return;
  }
  const Eigen::Quaterniond extra = rotation_of(turn - h * w);
  q = (extra * freely_rotated(q, inertia, momentum, h)).normalized();
  w = rate();
  if (w.dot(momentum) <= constants::energy_rise * energy) return;
  momentum = extra * momentum;
  w = rate();
}

}  // namespace drawpoint::engine
