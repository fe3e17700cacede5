// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/convex_polyhedron.hpp>
#include <drawpoint/engine/geometry/mass_properties.hpp>
#include <drawpoint/engine/world/world.hpp>

/// Contact scenes with known answers, shared by tests and benchmarks.
namespace drawpoint::support {

using Eigen::Vector3d;

/// One kind of surface everywhere.
inline engine::MaterialTable one_material(const engine::Material& m) {
  engine::MaterialTable table(1);
  table.set(0, 0, m);
  return table;
}

inline std::shared_ptr<const engine::Shape> shared(engine::Shape shape) {
  return std::make_shared<const engine::Shape>(std::move(shape));
}

/// A box of the given half extents and density as a rock.
inline engine::RockBody box_body(const Vector3d& half, double density = 2500) {
  const auto shape = engine::box(half);
  const auto properties = engine::mass_properties(shape, density);
  return {shared(shape), properties.mass, properties.inertia.diagonal(), 0};
}

inline void add_floor(engine::World& world) {
  world.add_static(shared(engine::HalfSpace{Vector3d::UnitZ(), 0}), Eigen::Isometry3d::Identity(), 0);
}

inline Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// A slope is the floor under tilted gravity: sliding is along +x.
inline Vector3d tilted_gravity(double angle) { return 9.81 * Vector3d(std::sin(angle), 0, -std::cos(angle)); }

}  // namespace drawpoint::support
