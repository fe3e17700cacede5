// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/calibration/edge_penetration.hpp>

#include <drawpoint/engine/granular/calibration/test_run.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/granular/heap_surface.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::granular {
namespace {

using Eigen::Vector3d;

constexpr double usual_slope = 0.84;  // tan 40°, for the size of a fill

double base_of(double height) { return height / usual_slope; }

void check_edge(const EdgeOptions& o) {
  if (all_finite({o.width, o.height, o.edge_width, o.edge_thickness, o.depth, o.speed, o.edge_friction}) &&
      o.edge_friction >= 0 && std::min({o.edge_width, o.edge_thickness, o.depth, o.speed}) > 0 &&
      o.parts >= 2 && o.height >= 3 && o.edge_width <= o.width - 1 && o.depth <= base_of(o.height) - 2)
    return;
  throw std::invalid_argument(
      "granular::edge_penetration: an edge of " + std::to_string(o.edge_width) + " x " +
      std::to_string(o.edge_thickness) + " and friction " + std::to_string(o.edge_friction) + " goes " +
      std::to_string(o.depth) + " deep into a bank of " + std::to_string(o.width) + " x " +
      std::to_string(o.height) + " largest rocks at " + std::to_string(o.speed) + " m/s in " +
      std::to_string(o.parts) +
      " parts; keep half a rock to the side walls and two to the back wall (a bank is 1.19 times as long as "
      "high), a height of 3 at least, friction 0 or more, the others above 0, at least 2 parts");
}

constexpr int steel = 2;  // a third kind of surface

engine::MaterialTable bank_materials(const engine::Material& rock, double edge_friction) {
  engine::MaterialTable table(3);
  const engine::MaterialTable walls = calibration_materials(rock);
  table.set(rough, rough, rock);
  for (int kind = rough; kind <= steel; ++kind) table.set(smooth, kind, walls.of(smooth, smooth));
  engine::Material on_steel = rock;
  on_steel.friction = edge_friction;
  table.set(rough, steel, on_steel);
  return table;
}

// Its back wall at x = 0, sides at ± half the width.
engine::World walled(const RockSample& sample, const EdgeOptions& o, double half_width) {
  engine::World world(o.world, bank_materials(sample.contact, o.edge_friction));
  const int walls = o.rough_walls ? rough : smooth;
  add_wall(world, Vector3d::UnitZ(), 0, rough);
  add_wall(world, -Vector3d::UnitX(), 0, walls);
  for (double side : {-1.0, 1.0}) add_wall(world, side * Vector3d::UnitY(), half_width, walls);
  return world;
}

// Least x of a centre of mass.
double first_rock(const engine::World& world) {
  double x = 0;
  for (const auto& rock : world.rocks()) x = std::min(x, rock.pose.translation().x());
  return x;
}

struct Bank {
  double foot, slope;  // [m] before the back wall, [deg]
};

Bank bank_of(const engine::World& world, const Area& area, double size) {
  const double spacing = size / 12;
  const auto heights = surface_heights(world, area, spacing);
  const double crest = mean_height(world, {-size, 0, area.y0, area.y1}, spacing);
  return {area_above(heights, spacing, size / 2) / (area.y1 - area.y0),
          angle_of_bank(world, area, size, crest, spacing)};
}

}  // namespace

EdgeResult edge_penetration(const RockSample& sample, const EdgeOptions& o) {
  check_edge(o);
  const double L = largest(sample.sizes), size = mean_length(sample.sizes), half_width = 0.5 * o.width * L,
               height = o.height * L, base = base_of(height);
  engine::World world = walled(sample, o, half_width);
  TestRun run(world, o);
  run.pour(sample, over_box(-L, {L, half_width}, L),
           loose_solid_share * sample.density * half_width * height * base);
  const Bank bank = bank_of(world, {-2 * base, 0, -half_width, half_width}, size);
  const Vector3d half(base, 0.5 * o.edge_width * L, 0.5 * o.edge_thickness * L);
  const double clearance = 0.01 * L, start = first_rock(world) - L, approach = 5 * o.speed;
  engine::KinematicBody edge(Eigen::Isometry3d(Eigen::Translation3d(start, 0, clearance)));
  world.attach(&edge);
  world.add_part_shape(0, shape_of(engine::box(half)),
                       Eigen::Isometry3d(Eigen::Translation3d(-half.x(), 0, half.z())), steel);
  edge.set_velocity({approach, 0, 0});
  run.go_on("approach", (-bank.foot - start) / approach);
  EdgeResult result{push_in(world, edge, o.depth * L * Vector3d::UnitX(), o), bank.slope};
  if (result.status == RunStatus::completed) result.status = run.status();
  result.pressure = result.mean_force / (4 * half.y() * half.z());
  result.line_force = result.mean_force / (2 * half.y());
  result.rocks = static_cast<int>(world.rocks().size());
  return result;
}

}  // namespace drawpoint::engine::granular
