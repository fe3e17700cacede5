// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/calibration/rock_sample.hpp>

/// Bulk density and porosity of rock that was filled into a box with rough walls, choked.
///
/// ρ_b = ρ V_s / V and n = 1 − V_s / V, with V_s the volume of rock inside V, cut exactly where a rock
/// reaches out (heap_surface.hpp, solid_volume). The core keeps one largest rock from walls and floor, where
/// rocks cannot lie as close, and half a rock from the surface's deepest place: its figures are the rock's
/// own. Those of the whole box, up to the mean surface, differ by what walls do, as they do in a bucket.
/// Swell is V / V_s − 1 = n / (1 − n): the volume of broken rock over that of the solid it came from. Nothing
/// is compacted, so the density is the loose one. Cost: 600 rocks in the default box, some 900 steps.
namespace drawpoint::engine::granular {

struct BulkDensityOptions : RunOptions {
  double side = 6, height = 6;  ///< of the box, and to which it is filled, about [largest rocks]
};

struct BulkDensity {
  RunStatus status = RunStatus::completed;
  double density = 0;         ///< of the core [kg/m³]
  double porosity = 0;        ///< of the core
  double swell = 0;           ///< of the core
  double porosity_whole = 0;  ///< of all below the mean surface
  int rocks = 0;
};

/// Throws std::invalid_argument where nothing would be left of the core: for a side or height of less than
/// 3 largest rocks, and for a bed that has a place over the core of no more than 1.5 largest rocks.
BulkDensity bulk_density(const RockSample& sample, const BulkDensityOptions& options = {});

}  // namespace drawpoint::engine::granular
