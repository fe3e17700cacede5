// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Contact solving alone, without Simbody: a cube falls on the ground and comes to rest on it.

#include <cmath>
#include <cstdio>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <memory>

using namespace drawpoint::engine;

int main() {
  // Of 1 m³ and 1000 kg; a spring of 1e9 N/m gives by 1e-5 m under its weight.
  const auto cube = std::make_shared<const Shape>(box({0.5, 0.5, 0.5}));
  MaterialTable materials(1);
  Material rock;
  rock.friction = 0.5;
  rock.stiffness = 1e9;
  materials.set(0, 0, rock);

  World world(WorldOptions{}, materials);
  world.add_static(std::make_shared<const Shape>(HalfSpace{Eigen::Vector3d::UnitZ(), 0.0}),
                   Eigen::Isometry3d::Identity(), 0);
  RockBody body;
  body.shape = cube;
  body.mass = 1000;
  body.inertia = 1000.0 / 6 * Eigen::Vector3d::Ones();
  world.add_rock(body, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.6)));
  for (int k = 0; k < 200; ++k) world.step();

  const double height = world.rocks().front().pose.translation().z();
  std::printf("cube: centre at %.6f m, expected 0.500000 m less 0.00001 m\n", height);
  return std::abs(height - 0.5) < 1e-4 && world.fastest_rock() < 1e-3 ? 0 : 1;
}
