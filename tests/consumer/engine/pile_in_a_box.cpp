// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// A pile in a box: rocks of one's own shape fall into a bin, come to rest, are weighed by the floor, looked at by a
// ray, saved and taken back. docs/tutorials/first-pile.md, part 1.

#include <cmath>
#include <cstdio>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/engine/world/state_hash.hpp>
#include <drawpoint/engine/world/world.hpp>

using namespace drawpoint::engine;
using Eigen::Vector3d;

namespace {

constexpr int rocks = 60;
constexpr double density = 2700;  // [kg/m³]

// One kind of surface everywhere. Friction has no default: what a pile does depends on it first of all.
//! [pile]
MaterialTable rock_on_rock() {
  MaterialTable table(1);
  table.set(0, 0, {.friction = 0.7, .rolling = 0.1, .stiffness = 1e8});
  return table;
}

// An open box of 1.2 m x 1.2 m: the ground and four walls, each the half-space beyond its plane.
void add_box(World& world) {
  for (const Vector3d& inward :
       {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, -1, 0)}) {
    const double offset = inward.z() > 0 ? 0.0 : -0.6;
    world.add_static(std::make_shared<const Shape>(HalfSpace{inward, offset}), Eigen::Isometry3d::Identity(),
                     0);
  }
}

// The hull of twelve random points in a block of 0.4 x 0.3 x 0.3 m.
RockBody random_rock(CounterRandom& random) {
  std::vector<Vector3d> points;
  for (int k = 0; k < 12; ++k)
    points.emplace_back(0.4 * random.uniform(), 0.3 * random.uniform(), 0.3 * random.uniform());
  return RockBody::from_hull(points, density);
}

void add_rocks(World& world) {
  CounterRandom random(7);
  for (int k = 0; k < rocks; ++k) {
    Eigen::Isometry3d pose(random.rotation());
    pose.translation() = Vector3d(0.4 * (k % 3) - 0.4, 0.4 * (k / 3 % 3) - 0.4, 0.3 + 0.45 * (k / 9));
    world.add_rock(random_rock(random), pose);
  }
}

World pile() {
  World world({}, rock_on_rock());
  add_box(world);
  add_rocks(world);
  return world;
}
//! [pile]

double weight_of(const World& world) {
  double mass = 0;
  for (const Rock& rock : world.rocks()) mass += rock.body.mass;
  return mass * world.options().gravity.norm();
}

// What the ground carries: the vertical force of each pair between the ground, fixed surface 0, and a rock.
double force_on_ground(const World& world) {
  const SurfaceOwner ground{Owner::fixed, 0};
  double force = 0;
  for (const PairForce& pair : world.pair_forces()) {
    if (pair.a == ground) force += pair.force.z();
    if (pair.b == ground) force -= pair.force.z();
  }
  return force;
}

bool expect(bool holds, const char* what) {
  if (!holds) std::printf("WRONG: %s\n", what);
  return holds;
}

}  // namespace

int main() {
  World world = pile();
  while (world.time() < 6 || (world.fastest_rock() > 0.005 && world.time() < 30)) world.step();
  std::printf("fastest rock after %.1f s: %.4f m/s\n", world.time(), world.fastest_rock());

  // Walls carry a share of the weight by friction, or keep the pile down where rocks wedge; with the ground they carry
  // all.
  double held = 0;
  for (const PairForce& pair : world.pair_forces())
    held += (pair.a.owner == Owner::fixed) * pair.force.z() - (pair.b.owner == Owner::fixed) * pair.force.z();
  const double weight = weight_of(world);
  std::printf("weight %.0f N, carried by ground and walls %.0f N, by the ground alone %.0f N\n", weight, held,
              force_on_ground(world));
  bool good = expect(std::abs(held - weight) < 0.02 * weight, "the pile at rest is carried");

  // One rock: in balance with its weight.
  const Rock& first = world.rock(0);
  const Wrench on_first = world.rock_wrench(0);
  std::printf("rock 0 at (%.3f, %.3f, %.3f) m weighs %.1f N, its contacts lift it by %.1f N\n",
              first.pose.translation().x(), first.pose.translation().y(), first.pose.translation().z(),
              9.81 * first.body.mass, on_first.force.z());
  good &= expect(std::abs(on_first.force.z() - 9.81 * first.body.mass) < 0.3 * 9.81 * first.body.mass,
                 "rock 0 is in balance");

  // How high does the pile lie in the middle?
  const auto hit = world.cast_ray({Vector3d(0, 0, 10), -Vector3d::UnitZ()});
  if (hit)
    std::printf("height in the middle %.3f m, on %s %d\n", hit->position.z(),
                hit->surface.owner == Owner::rock ? "rock" : "fixed surface", hit->surface.index);
  good &= expect(hit && hit->position.z() > 0 && hit->position.z() < 2,
                 "a ray from above meets the pile or the ground");

  // Saved, and taken back by a world that was built by the same calls: from here on the same bits.
  const std::vector<std::byte> saved = world.save();
  World again = pile();
  again.restore(saved);
  for (int k = 0; k < 50; ++k) {
    world.step();
    again.step();
  }
  good &= expect(state_hash(world) == state_hash(again), "the restored pile goes on with the same bits");

  // A step of another length, to end at a wanted time.
  world.step(0.0025);
  return good ? 0 : 1;
}
