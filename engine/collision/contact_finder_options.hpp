// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// What the search for contacts can be told.
namespace drawpoint::engine {

/// Who finds the axis of two polyhedra: the engine's search for separating axes, or FCL's narrow phase by one of
/// its two solvers. FCL's axis is checked by the support heights of both shapes; where they contradict it, the
/// engine's search decides, and ContactFinder::times() counts it. The manifold is clipped in the same way.
///
/// fcl_libccd: FCL's signed distance on libccd (GJK, then EPA). fcl_indep: fcl::collide with GST_INDEP, and
/// fcl::distance where that finds no collision. Several times slower, and no truer (docs/decisions/0007).
enum class NarrowMethod { separating_axes, fcl_libccd, fcl_indep };

/// "separating_axes", "fcl_libccd", "fcl_indep".
std::string_view to_string(NarrowMethod method);
/// Throws std::invalid_argument with the known names.
NarrowMethod narrow_method_named(std::string_view name);

struct ContactFinderOptions {
  double margin =
      0.01;  ///< [m] ≥ 0; points with a gap up to this are reported: a fast rock's travel in a step
  double slack = 0.02;  ///< [m] ≥ 0; growth of the boxes of the broad phase, in addition to the margin
  double reuse_distance = 1e-3;  ///< [m] ≥ 0; relative motion below which a manifold is carried along
  double reuse_angle = 2e-3;     ///< [rad] ≥ 0; the same for rotation
  double hysteresis = 1e-4;  ///< [m] ≥ 0; last time's axis is kept while its overlap is the least within this
  NarrowMethod narrow = NarrowMethod::separating_axes;  ///< of two polyhedra; half-spaces have closed forms
};

}  // namespace drawpoint::engine
