// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <drawpoint/tests/support/scenes.hpp>
#include <vector>

/// Cut blocks as rocks: any convex polyhedron placed where it was drawn, and the voussoirs of a masonry arch.
///
/// A rock's frame has its origin at the centre of mass and the principal axes as its axes; placed() finds
/// both and returns the pose that puts the polyhedron back where it was given. World frame, SI units.
namespace drawpoint::support {

struct PlacedBlock {
  engine::RockBody body;
  Eigen::Isometry3d pose;
};

inline PlacedBlock placed(const engine::ConvexPolyhedron& polyhedron, double density = 2500) {
  const auto properties = engine::mass_properties(polyhedron, density);
  Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(properties.inertia).eigenvectors();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  PlacedBlock block;
  block.pose = Eigen::Translation3d(properties.centre) * Eigen::AngleAxisd(Eigen::Quaterniond(axes));
  const auto shape = polyhedron.transformed(block.pose.inverse());
  const auto principal = engine::mass_properties(shape, density);
  block.body = {shared(shape), principal.mass, principal.inertia.diagonal(), 0};
  return block;
}

/// A semicircular arch in the plane y = 0 on the floor z = 0, centred at the origin: `count` equal voussoirs
/// with radial joints, of mean radius `radius`, thickness `thickness` and depth `depth` along y [m], from -x
/// to +x. Joints are planes; the curved sides are the chords of the joints' ends.
inline std::vector<PlacedBlock> semicircular_arch(int count, double radius, double thickness, double depth) {
  std::vector<PlacedBlock> arch;
  for (int k = 0; k < count; ++k) {
    std::vector<Vector3d> corners;
    for (int joint : {k, k + 1})
      for (double r : {radius - thickness / 2, radius + thickness / 2})
        for (double y : {-depth / 2, depth / 2}) {
          const double angle = M_PI * (1 - static_cast<double>(joint) / count);
          corners.emplace_back(r * std::cos(angle), y, r * std::sin(angle));
        }
    arch.push_back(placed(engine::ConvexPolyhedron::hull_of(corners)));
  }
  return arch;
}

}  // namespace drawpoint::support
