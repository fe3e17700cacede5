// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/tests/support/contact_pairs.hpp>
#include <drawpoint/tests/support/exact_contact.hpp>

/// Random pairs of rocks that touch, nearly touch or just miss each other.
namespace drawpoint::support {

inline const ConvexPolyhedron& rock(int shape) {
  return engine::granular::rock_shapes()[static_cast<std::size_t>(shape % 6)];
}

struct RockPair {
  ConvexPolyhedron a, b;  // in the world
  Placed placed_a, placed_b;
};

// Two rocks of 0.3 to 0.8 m, their extents along a random line overlapping by up to 60 mm or apart by up to
// 12 mm.
inline RockPair random_rock_pair(std::mt19937& rng) {
  std::uniform_real_distribution<double> size(0.3, 0.8), gap(-0.06, 0.012);
  std::normal_distribution<double> normal;
  const ConvexPolyhedron a = rock(static_cast<int>(rng() % 6)).scaled(size(rng));
  const ConvexPolyhedron b = rock(static_cast<int>(rng() % 6)).scaled(size(rng));
  const Vector3d line = Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
  const Eigen::Isometry3d X_WA = pose_at({1, 2, 3}, random_rotation(rng));
  Eigen::Isometry3d X_WB = pose_at({1, 2, 3}, random_rotation(rng));
  X_WB.translation() += (gap(rng) - separation_along(a.transformed(X_WA), b.transformed(X_WB), line)) * line;
  return {a.transformed(X_WA), b.transformed(X_WB), {share(a), X_WA}, {share(b), X_WB}};
}

}  // namespace drawpoint::support
