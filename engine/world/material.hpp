// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

/// Contact materials: what happens between two kinds of surface.
///
/// Normal law, selectable: *linear*, f = k δ, with k the stiffness of the pair of bodies shared by the points
/// of its manifold; *Hertz*, f = k_n δ^(3/2) with k_n = (4/3) E* √R*, shared likewise, R* from the radii of
/// the spheres of the bodies' volumes. A stiffness is a choice of accuracy: rocks of 20 to 500 kg in substeps
/// of 0.6 ms hold still from 1e8 N/m down, where 100 kN on a contact are 1 mm of overlap; with 1e9 N/m a
/// contact answers faster than a substep, the iterations do not keep up and a pile without rolling resistance
/// creeps (docs/decisions/0008). Lindmark's (2016) Young's modulus E reads as k = E ℓ, ℓ = 0.1 m: 1e9 N/m.
/// Friction: Coulomb with a circular cone. Rolling and spinning resistance: moments of at most μ_r R* and
/// μ_s R* times the normal force, once per pair. Restitution: Newton's law by an impulse stage before the
/// step, for approaches faster than `impact_speed`.
namespace drawpoint::engine {

enum class NormalLaw { linear, hertz };

struct Material {
  double friction = std::numeric_limits<double>::
      quiet_NaN();  ///< Coulomb coefficient μ, ≥ 0; no default: it would let rocks slide like ice, or
  ///< hold them
  double rolling = 0;       ///< rolling-resistance coefficient μ_r, ≥ 0
  double stiffness = 1e8;   ///< linear: k of the pair of bodies [N/m], > 0; Hertz: E* [Pa]
  double damping_time = 0;  ///< SPOOK relaxation time τ [s]; at least two steps are used
  double spinning = 0;      ///< spinning-resistance coefficient μ_s, ≥ 0
  double restitution = 0;   ///< e, 0 to 1
  NormalLaw law = NormalLaw::linear;
};

/// Symmetric table of pairs of surface kinds 0 .. kinds-1. A world refuses a surface that can touch another one with
/// which its kind has no entry.
class MaterialTable {
 public:
  /// Both throw std::invalid_argument: for fewer than one kind; for a kind that is not in the table.
  explicit MaterialTable(int kinds = 1)
      : kinds_(checked(kinds)), pairs_(kinds_ * kinds_), given_(kinds_ * kinds_) {}
  void set(int a, int b, const Material& m) {
    if (a < 0 || b < 0 || a >= kinds_ || b >= kinds_)
      throw std::invalid_argument("engine::MaterialTable: there are no kinds " + std::to_string(a) + " and " +
                                  std::to_string(b) + "; allowed: 0 to " + std::to_string(kinds_ - 1));
    pairs_[a * kinds_ + b] = pairs_[b * kinds_ + a] = m;
    given_[a * kinds_ + b] = given_[b * kinds_ + a] = true;
  }
  bool given(int a, int b) const { return given_[a * kinds_ + b]; }
  const Material& of(int a, int b) const { return pairs_[a * kinds_ + b]; }
  int kinds() const { return kinds_; }

 private:
  static int checked(int kinds) {
    if (kinds >= 1 && kinds <= 1000) return kinds;
    throw std::invalid_argument("engine::MaterialTable: " + std::to_string(kinds) +
                                " kinds; allowed: 1 to 1000");
  }

  int kinds_;
  std::vector<Material> pairs_;
  std::vector<bool> given_;
};

}  // namespace drawpoint::engine
