// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

/// Contact materials: what happens between two kinds of surface.
///
/// Normal law: linear, f = k δ, with k the stiffness of the pair of bodies shared by the points of its
/// manifold. The thesis's Young's modulus E is read as k = E ℓ with ℓ = 0.1 m for rock on rock (1e9 N/m); see
/// docs/decisions. Friction: Coulomb with a circular cone. Rolling resistance: a moment of at most μ_r R*
/// times the normal force, once a pair. Restitution is zero: every pair of the founding case has e = 0.
namespace drawpoint::engine::contact {

struct Material {
  double friction = 0;      ///< Coulomb coefficient μ, ≥ 0
  double rolling = 0;       ///< rolling-resistance coefficient μ_r, ≥ 0
  double stiffness = 1e9;   ///< k of the pair of bodies [N/m], > 0
  double damping_time = 0;  ///< SPOOK relaxation time τ [s]; at least two steps are used
};

/// Symmetric table of pairs of surface kinds 0 .. kinds-1.
class MaterialTable {
 public:
  explicit MaterialTable(int kinds = 1) : kinds_(kinds), pairs_(kinds * kinds) {}
  void set(int a, int b, const Material& m) { pairs_.at(a * kinds_ + b) = pairs_.at(b * kinds_ + a) = m; }
  const Material& of(int a, int b) const { return pairs_[a * kinds_ + b]; }

 private:
  int kinds_;
  std::vector<Material> pairs_;
};

}  // namespace drawpoint::engine::contact
