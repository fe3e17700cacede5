// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/calibration/plate_penetration.hpp>

#include <drawpoint/engine/granular/calibration/test_run.h>

#include <algorithm>
#include <drawpoint/engine/granular/heap_surface.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::granular {
namespace {

using Eigen::Vector3d;

void check_penetration(const PenetrationOptions& o) {
  if (all_finite({o.side, o.height, o.width, o.thickness, o.depth, o.speed}) &&
      std::min({o.width, o.thickness, o.depth, o.speed}) > 0 && o.parts >= 2 && o.width <= o.side - 2 &&
      o.thickness <= o.side - 2 && o.depth <= o.height - 2)
    return;
  throw std::invalid_argument(
      "granular::plate_penetration: a plate of " + std::to_string(o.width) + " x " +
      std::to_string(o.thickness) + " goes " + std::to_string(o.depth) + " deep into a bed of " +
      std::to_string(o.side) + " x " + std::to_string(o.side) + " x " + std::to_string(o.height) +
      " largest rocks at " + std::to_string(o.speed) + " m/s in " + std::to_string(o.parts) +
      " parts; keep two rocks to walls and floor, all above 0, at least 2 parts");
}

Eigen::Isometry3d upright(double z) { return Eigen::Isometry3d(Eigen::Translation3d(0, 0, z)); }

}  // namespace

PenetrationResult push_in(engine::World& world, engine::KinematicBody& plate, const Vector3d& way,
                          const PushOptions& o) {
  const double depth = way.norm();
  const Vector3d direction = way / depth;
  TestRun run(world, o);
  PenetrationResult result;
  const double start = plate.work(), part = depth / o.parts / o.speed;
  plate.set_velocity(o.speed * direction);
  for (int k = 1; k <= o.parts && !run.stopped(); ++k) {
    double force = 0;
    int steps = 0;
    run.go_on("push", part, [&] {
      force -= plate.contact_wrench().force.dot(direction);
      ++steps;
    });
    result.curve.push_back({k * depth / o.parts, force / std::max(1, steps)});
    const int early = o.parts / 2;
    (k > early ? result.mean_force : result.early_force) +=
        result.curve.back().force / (k > early ? o.parts - early : early);
  }
  result.work = plate.work() - start;
  result.status = run.status();
  return result;
}

PenetrationResult plate_penetration(const RockSample& sample, const PenetrationOptions& o) {
  check_penetration(o);
  const double L = largest(sample.sizes), half = 0.5 * o.side * L, height = o.height * L;
  const Vector3d size(0.5 * o.thickness * L, 0.5 * o.width * L, height);
  engine::World world(o.world, calibration_materials(sample.contact));
  add_open_box(world, half, smooth);
  TestRun run(world, o);
  run.pour(sample, over_box(0, {half, half}, L),
           loose_solid_share * sample.density * 4 * half * half * height);
  const Area under{-size.x() - 0.5 * L, size.x() + 0.5 * L, -size.y(), size.y()};
  const double spacing = mean_length(sample.sizes) / 12;
  const auto heights = surface_heights(world, under, spacing);
  const double top = *std::max_element(heights.begin(), heights.end()),
               mean = mean_height(world, under, spacing);
  engine::KinematicBody plate(upright(top));
  world.attach(&plate);
  world.add_part_shape(0, shape_of(engine::box(size)), upright(size.z()), rough);
  plate.set_velocity({0, 0, -o.speed});
  run.go_on("lower", (top - mean) / o.speed);
  PenetrationResult result = push_in(world, plate, -o.depth * L * Vector3d::UnitZ(), o);
  if (result.status == RunStatus::completed) result.status = run.status();
  result.pressure = result.mean_force / (4 * size.x() * size.y());
  result.rocks = static_cast<int>(world.rocks().size());
  return result;
}

}  // namespace drawpoint::engine::granular
