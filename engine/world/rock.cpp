// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/engine/world/rock.hpp>

#include <drawpoint/engine/geometry/mass_properties.hpp>

namespace drawpoint::engine {

RockBody RockBody::from_hull(std::span<const Eigen::Vector3d> points, double density, int material) {
  return place_hull(points, density, material).body;
}

PlacedHull place_hull(std::span<const Eigen::Vector3d> points, double density, int material) {
  const ConvexPolyhedron hull = ConvexPolyhedron::hull_of(points);
  const Eigen::Isometry3d frame = principal_frame(mass_properties(hull, density));
  const ConvexPolyhedron centred = hull.transformed(frame.inverse());
  const MassProperties properties = mass_properties(centred, density);
  return {{std::make_shared<const Shape>(centred), properties.mass, properties.inertia.diagonal(), material},
          frame};
}

}  // namespace drawpoint::engine
