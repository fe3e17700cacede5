// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// A blade through a pile: a body that moves as it is told, the force that it feels and the work that it does.
// docs/tutorials/first-pile.md, part 2.

#include <cmath>
#include <cstdio>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/engine/world/kinematic_body.hpp>
#include <drawpoint/engine/world/world.hpp>

using namespace drawpoint::engine;
using Eigen::Vector3d;

namespace {

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

// Two kinds of surface: 0 is rock and ground, 1 is steel. Every pair that can touch says its friction.
MaterialTable rock_and_steel() {
  MaterialTable table(2);
  table.set(0, 0, {.friction = 0.7, .stiffness = 1e8});
  table.set(0, 1, {.friction = 0.4, .stiffness = 1e8});
  table.set(1, 1, {.friction = 0.3, .stiffness = 1e9});
  return table;
}

// Six rows of rocks of 0.3 m on the ground, each of one of the six shapes of broken rock.
void add_rocks(World& world) {
  for (int k = 0; k < 48; ++k) {
    const ConvexPolyhedron hull = granular::rock_shapes()[static_cast<std::size_t>(k % 6)].scaled(0.3);
    world.add_rock(RockBody::from_hull(hull.vertices(), 2700),
                   at(0.35 * (k % 6), 0.35 * (k / 6 % 4) - 0.5, 0.2 + 0.3 * (k / 24)));
  }
}

}  // namespace

int main() {
  World world({}, rock_and_steel());
  world.add_static(std::make_shared<const Shape>(HalfSpace{Vector3d::UnitZ(), 0.0}),
                   Eigen::Isometry3d::Identity(), 0);
  add_rocks(world);

  //! [blade]
  KinematicBody blade(at(-0.6, 0, 0.35));
  world.attach(&blade);
  world.add_part_shape(0, std::make_shared<const Shape>(box({0.05, 1.0, 0.3})), Eigen::Isometry3d::Identity(),
                       1);

  while (world.time() < 2) world.step();  // the rocks settle
  blade.set_velocity({0.5, 0, 0});
  //! [blade]

  double sum = 0, most = 0;
  int steps = 0;
  while (blade.pose().translation().x() < 1.4) {
    world.step();
    const double drag = -blade.contact_wrench().force.x();
    sum += drag;
    most = std::max(most, drag);
    ++steps;
  }
  const double way = 0.5 * steps * world.options().step;
  std::printf("drag over %.2f m: mean %.0f N, at most %.0f N; work %.0f J\n", way, sum / steps, most,
              blade.work());

  // Work is mean force times way; and the blade's force is what the rocks report of their pairs with it.
  const Wrench asked = world.part_wrench(0);
  const bool work_agrees = std::abs(blade.work() - sum / steps * way) < 1e-6 * std::abs(blade.work());
  const bool force_agrees =
      (asked.force - blade.contact_wrench().force).norm() <= 1e-3 * (1 + asked.force.norm());
  std::printf("force by pairs %.1f N, felt by the blade %.1f N\n", asked.force.x(),
              blade.contact_wrench().force.x());

  // Sliding 48 rocks over the ground takes at least half their weight times friction, and the pile does not explode.
  double weight = 0;
  for (const Rock& rock : world.rocks()) weight += 9.81 * rock.body.mass;
  const bool plausible = sum / steps > 0.1 * weight && most < 50 * weight;
  return work_agrees && force_agrees && plausible ? 0 : 1;
}
