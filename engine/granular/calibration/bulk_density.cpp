// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/calibration/bulk_density.hpp>

#include <drawpoint/engine/granular/calibration/test_run.h>

#include <algorithm>
#include <drawpoint/engine/granular/heap_surface.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::granular {
namespace {

// Half a rock below the surface's lowest place over the core.
double checked_top(const engine::World& world, const Area& core, double L, const BulkDensityOptions& o,
                   double spacing) {
  const auto surface = surface_heights(world, core, spacing);
  const double lowest = *std::min_element(surface.begin(), surface.end());
  if (!(lowest > 1.5 * L))
    throw std::invalid_argument("granular::bulk_density: the core's lowest place is " +
                                std::to_string(lowest) + " m high; a core that begins at " +
                                std::to_string(L) + " m takes more than " + std::to_string(1.5 * L) +
                                " m; fill the box higher than " + std::to_string(o.height) +
                                " largest rocks");
  return lowest - 0.5 * L;
}

}  // namespace

BulkDensity bulk_density(const RockSample& sample, const BulkDensityOptions& o) {
  if (!(all_finite({o.side, o.height}) && std::min(o.side, o.height) >= 3))
    throw std::invalid_argument("granular::bulk_density: a box of side " + std::to_string(o.side) +
                                " and height " + std::to_string(o.height) +
                                " largest rocks has no core; give at least 3 each");
  const double L = largest(sample.sizes), half = 0.5 * o.side * L, spacing = mean_length(sample.sizes) / 12;
  engine::World world(o.world, calibration_materials(sample.contact));
  add_open_box(world, half, rough);
  TestRun run(world, o);
  run.pour(sample, over_box(0, {half, half}, L),
           loose_solid_share * sample.density * 4 * half * half * o.height * L);
  if (run.stopped()) return {.status = RunStatus::stopped};
  const Area all{-half, half, -half, half}, core{L - half, half - L, L - half, half - L};
  const double top = checked_top(world, core, L, o, spacing);
  const double volume = (core.x1 - core.x0) * (core.y1 - core.y0) * (top - L);
  const double solid = solid_volume(world, core, L, top, spacing) / volume;
  const double whole =
      present_mass(world) / sample.density / (4 * half * half * mean_height(world, all, spacing));
  return {.status = run.status(),
          .density = sample.density * solid,
          .porosity = 1 - solid,
          .swell = 1 / solid - 1,
          .porosity_whole = 1 - whole,
          .rocks = static_cast<int>(world.rocks().size())};
}

}  // namespace drawpoint::engine::granular
