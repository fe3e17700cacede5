// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/calibration/repose.hpp>

#include <drawpoint/engine/granular/calibration/test_run.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/granular/heap_surface.hpp>
#include <drawpoint/engine/world/kinematic_body.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::granular {
namespace {

using Eigen::Vector3d;

[[noreturn]] void refuse_repose(const std::string& what) { throw std::invalid_argument("granular::" + what); }

// The ledge ends at x = 0; its back wall and its smooth sides.
engine::World ledge(const RockSample& sample, const DrainedBankOptions& o, double L) {
  engine::World world(o.world, calibration_materials(sample.contact));
  const double length = o.length * L, width = o.width * L;
  add_block(world, {length / 2, width, 0.5}, {-length / 2, 0, -0.5}, rough);
  add_wall(world, Vector3d::UnitX(), length, smooth);
  for (double side : {-1.0, 1.0}) add_wall(world, side * Vector3d::UnitY(), width / 2, smooth);
  return world;
}

}  // namespace

PouredHeap poured_heap(const RockSample& sample, const PouredHeapOptions& o) {
  if (o.rocks < 20 || !(std::isfinite(o.radius) && o.radius > 0))
    refuse_repose("poured_heap: " + std::to_string(o.rocks) + " rocks over a radius of " +
                  std::to_string(o.radius) + " largest rocks; give at least 20 rocks and a positive radius");
  engine::World world(o.world, calibration_materials(sample.contact));
  add_wall(world, Vector3d::UnitZ(), 0, rough);
  TestRun run(world, o);
  const double L = largest(sample.sizes), spacing = 1.05 * L;
  run.pour(sample, {.top = {0, 0, 1e3}, .radius = o.radius * spacing, .spacing = spacing},
           o.rocks * mean_mass(sample));
  PouredHeap heap{.status = run.status(), .rocks = static_cast<int>(world.rocks().size())};
  const double size = mean_length(sample.sizes);
  heap.angle = angle_of_cone(world, size, size / 6);
  const auto heights = surface_heights(world, {-L, L, -L, L}, size / 6);
  heap.height = *std::max_element(heights.begin(), heights.end());
  return heap;
}

DrainedBank drained_bank(const RockSample& sample, const DrainedBankOptions& o) {
  if (!(all_finite({o.length, o.width, o.height}) && std::min({o.length, o.width, o.height}) >= 2))
    refuse_repose("drained_bank: a bin of " + std::to_string(o.length) + " x " + std::to_string(o.width) +
                  " x " + std::to_string(o.height) + " largest rocks; give at least 2 each way");
  if (!(std::isfinite(o.opening_speed) && o.opening_speed > 0))
    refuse_repose("drained_bank: the end opens at " + std::to_string(o.opening_speed) +
                  " m/s; give more than 0, 4 is usual");
  const double L = largest(sample.sizes), length = o.length * L, width = o.width * L, height = o.height * L;
  engine::World world = ledge(sample, o, L);
  engine::KinematicBody gate(Eigen::Isometry3d(Eigen::Translation3d(0.5 * L, 0, height)));
  world.attach(&gate);
  world.add_part_shape(0, shape_of(engine::box({0.5 * L, width / 2 - 0.01 * L, 1.2 * height})),
                       Eigen::Isometry3d::Identity(), smooth);
  TestRun run(world, o);
  run.pour(sample, over_box(-length / 2, {0.5 * length, 0.5 * width}, L),
           loose_solid_share * sample.density * length * width * height);
  DrainedBank bank{.status = {}, .rocks = static_cast<int>(world.rocks().size())};
  gate.set_velocity({o.opening_speed, 0, 0});
  run.go_on("open", 2.0, [&] { remove_fallen(world); });
  run.settle([&] { remove_fallen(world); });
  const double size = mean_length(sample.sizes);
  bank.crest = mean_height(world, {-length, -2 * length / 3, -width / 2, width / 2}, size / 6);
  bank.angle = angle_of_bank(world, {-length, L, -width / 2, width / 2}, size, bank.crest, size / 6);
  bank.status = run.status();
  return bank;
}

}  // namespace drawpoint::engine::granular
