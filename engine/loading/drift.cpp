// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/engine/loading/drift.hpp>
#include <drawpoint/engine/loading/mine_materials.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::loading {
namespace {

using Eigen::Vector3d;
using engine::ConvexPolyhedron;
using engine::HalfSpace;
using engine::Shape;

constexpr int terrain = static_cast<int>(SurfaceKind::terrain);
constexpr double slab = 0.5;  // thickness of the roof [m]
// The ring covers the corners of the roof's square opening, at 1.41 of its radius.
constexpr double ring_share = 0.45;

void require_dimension(bool fine, const char* name, double value, const char* allowed) {
  if (!fine)
    throw std::invalid_argument("loading::Drift: " + std::string(name) + " is " + std::to_string(value) +
                                " m; allowed: " + allowed);
}

void add(engine::World& world, Shape shape) {
  world.add_static(std::make_shared<const Shape>(std::move(shape)), Eigen::Isometry3d::Identity(), terrain);
}

void add_block(engine::World& world, const Vector3d& low, const Vector3d& high) {
  std::vector<Vector3d> points;
  for (int c = 0; c < 8; ++c)
    points.emplace_back(c & 1 ? high.x() : low.x(), c & 2 ? high.y() : low.y(), c & 4 ? high.z() : low.z());
  add(world, ConvexPolyhedron::hull_of(points));
}

void add_roof(engine::World& world, const Drift& d) {
  const double front = d.raise_axis().x() - d.raise_radius, side = d.raise_radius, far = d.length + slab;
  add_block(world, {-10, -d.width, d.height}, {front, d.width, d.height + slab});
  add_block(world, {front, side, d.height}, {far, d.width, d.height + slab});
  add_block(world, {front, -d.width, d.height}, {far, -side, d.height + slab});
  add_block(world, {d.raise_axis().x() + d.raise_radius, -side, d.height}, {far, side, d.height + slab});
}

// Eight plates, flat inside, that overlap at the corners so that the ring is closed.
void add_raise(engine::World& world, const Drift& d) {
  constexpr int sides = 8;
  const double rise = d.raise_height - d.height;
  for (int k = 0; k < sides; ++k) {
    std::vector<Vector3d> points;
    for (double angle : {k - 0.5, k + 0.5}) {
      const double phi = 2 * M_PI * angle / sides, corner = 1 / std::cos(M_PI / sides);
      for (double z : {0.0, rise}) {
        const double inner = (d.raise_radius + d.raise_widening * z) * corner;
        for (double r : {inner, inner + ring_share * inner})
          points.emplace_back(d.raise_axis().x() + r * std::cos(phi), r * std::sin(phi), d.height + z);
      }
    }
    add(world, ConvexPolyhedron::hull_of(points));
  }
}

void add_back_wall(engine::World& world, const Drift& d) {
  add(world, HalfSpace{-Vector3d::UnitX(), -d.length});
  if (d.wall_roughness <= 0) return;
  const auto& shapes = granular::rock_shapes();
  const double pitch = 0.9 * d.wall_roughness;
  CounterRandom random(0x77a11);  // the wall is part of the drift: the same in every run
  for (double z = pitch / 2; z < d.height; z += pitch) {
    for (double y = -d.width / 2 + pitch / 2; y < d.width / 2; y += pitch) {
      Eigen::Isometry3d pose(random.rotation());
      pose.translation() = Vector3d(d.length - 0.1 * d.wall_roughness * random.uniform(), y, z);
      const auto rock = shapes[random.index(shapes.size())].scaled(d.wall_roughness);
      world.add_static(std::make_shared<const Shape>(rock), pose, static_cast<int>(SurfaceKind::rock));
    }
  }
}

}  // namespace

void check(const Drift& d) {
  require_dimension(d.length >= 10 && d.length <= 200, "length", d.length, "10 to 200 m");
  require_dimension(d.width >= 3.6 && d.width <= 20, "width", d.width,
                    "3.6 m (bucket and clearance) to 20 m");
  require_dimension(d.height >= 3.5 && d.height <= 20, "height", d.height,
                    "3.5 m (the machine is 3 m high) to 20 m");
  require_dimension(d.raise_radius >= 1 && 2 * d.raise_radius < d.width, "raise radius", d.raise_radius,
                    "1 m to half the drift's width");
  require_dimension(d.raise_widening >= 0 && d.raise_widening <= 1, "raise widening (m per m)",
                    d.raise_widening, "0 to 1");
  require_dimension(d.wall_roughness == 0 || (d.wall_roughness >= 0.2 && d.wall_roughness <= 2),
                    "wall roughness", d.wall_roughness, "0 (smooth) or 0.2 to 2 m");
  require_dimension(d.raise_height > d.height + 1, "raise height", d.raise_height,
                    "more than a metre above the roof");
}

void add_drift(engine::World& world, const Drift& drift) {
  check(drift);
  add(world, HalfSpace{Vector3d::UnitZ(), 0});
  add(world, HalfSpace{Vector3d::UnitY(), -drift.width / 2});
  add(world, HalfSpace{-Vector3d::UnitY(), -drift.width / 2});
  add_back_wall(world, drift);
  add_roof(world, drift);
  add_raise(world, drift);
}

granular::EmitterOptions emitter_of(const Drift& d) {
  constexpr double rock = 0.46;  // radius of the sphere about the largest [m]
  const double z = d.raise_height - 0.6;
  // Within the opening, and clear of the back wall, whose rocks stand out by up to 0.6 of their size.
  const double radius = d.raise_radius - rock - std::max(0.0, 0.6 * d.wall_roughness - 0.3);
  return {.top = {d.raise_axis().x(), d.raise_axis().y(), z}, .radius = radius};
}

}  // namespace drawpoint::engine::loading
