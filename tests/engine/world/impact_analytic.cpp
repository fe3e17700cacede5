// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/base/constants.hpp>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/tests/support/rocks.hpp>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;
namespace constants = engine::constants;

namespace {

World free_space(engine::Method method = engine::Method::batched) {
  engine::WorldOptions options;
  options.gravity = Vector3d::Zero();
  options.solver.method = method;
  options.solver.iteration_budget = 0;
  if (method == engine::Method::sequential) options.solver.substeps = 1, options.solver.iterations = 25;
  return World(options, support::one_material({0.9, 0.5, 1e9, 0}));
}

Vector3d momentum(const World& world) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& rock : world.rocks()) sum += rock.body.mass * rock.velocity;
  return sum;
}

// About the world's origin.
Vector3d angular_momentum(const World& world) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& rock : world.rocks()) {
    const Eigen::Matrix3d R = rock.pose.linear();
    sum += rock.body.mass * rock.pose.translation().cross(rock.velocity) +
           R * (rock.body.inertia.asDiagonal() * (R.transpose() * rock.angular_velocity));
  }
  return sum;
}

}  // namespace

// Every impulse acts on both rocks in opposite directions, so linear momentum is kept to round-off. In double
// precision: 1e-12 of the largest single momentum. In single precision an iteration rounds each velocity
// three times per point at 2⁻²⁴ of itself; 16 substeps of one iteration with at most four points over the at
// most 200 steps of contact: √(200 · 16 · 12) · 6e-8 = 1.2e-5 is expected of independent errors, and ten
// times that is allowed. Angular momentum about the origin: without substeps impulses act at one common point
// and free flight keeps r x p, so it is kept to round-off. In a substep impulses act at the arms of the
// step's start, while the rocks have since moved against each other by at most their approach speed times h:
// the impulses, at most the momentum exchanged, are off their common line by no more than that. Contact is
// inelastic with friction, so kinetic energy may only fall, but for the push that removes overlap: the
// elastic energy k δ²/2 stored in a penetration of at most v h; it is bounded here by 1 % of the energy of
// the impact.
class Impact : public testing::TestWithParam<engine::Method> {};

TEST_P(Impact, TwoRocksKeepMomentumAndGainNoEnergy) {
  const bool single = GetParam() == engine::Method::batched;
  const double linear = single ? 1.2e-4 : 1e-12;
  engine::CounterRandom random(3);
  for (int trial = 0; trial < 40; ++trial) {
    World world = free_space(GetParam());
    Eigen::Isometry3d a(random.rotation()), b(random.rotation());
    a.translation() = Vector3d(-0.5, 0.1 * random.uniform(), 0.1 * random.uniform());
    b.translation() = Vector3d(0.5, 0, 0);
    const double speed = 1 + 4 * random.uniform();
    world.add_rock(support::rock_body(trial % 6, 0.6), a, Vector3d(speed, 0, 0),
                   Vector3d(0, 2 * random.uniform(), 0));
    world.add_rock(support::rock_body((trial + 1) % 6, 0.4), b, Vector3d(-1, 0, 0));
    const Vector3d p = momentum(world), L = angular_momentum(world);
    const double energy = world.kinetic_energy(), scale = world.rocks()[0].body.mass * speed;
    double highest = 0;
    for (int k = 0; k < 200; ++k) {
      world.step();
      highest = std::max(highest, world.kinetic_energy());
    }
    EXPECT_LT((momentum(world) - p).norm(), linear * scale);
    const double off_line = single ? (speed + 1) * world.options().step : 1e-10;  // [m]
    EXPECT_LT((angular_momentum(world) - L).norm(), off_line * scale);
    EXPECT_LE(highest, 1.01 * energy) << "trial " << trial;
    EXPECT_LT(world.kinetic_energy(), 0.999 * energy) << "the rocks never met in trial " << trial;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Impact,
                         testing::Values(engine::Method::sequential, engine::Method::batched));

// Torque-free rotation keeps angular momentum to round-off over 20 000 turns-steps, whatever the shape.
TEST(FreeRotation, KeepsAngularMomentum) {
  World world = free_space();
  world.add_rock(support::rock_body(2, 0.5), Eigen::Isometry3d::Identity(), Vector3d::Zero(),
                 Vector3d(1, 5, 0.3));
  const Vector3d L = angular_momentum(world);
  for (int k = 0; k < 20000; ++k) world.step();
  EXPECT_LT((angular_momentum(world) - L).norm(), 20000 * 1e-15 * 10 * L.norm());
}

// Two equal cubes that are put 0.2 m into each other part at no more than push_out_speed, each at half of it, by
// symmetry; the solver leaves 1e-5 of the load, single precision 1e-7. At first they are pushed at just that speed.
TEST_P(Impact, OverlappingCubesPartSlowly) {
  engine::WorldOptions options;
  options.gravity = Vector3d::Zero();
  options.solver.method = GetParam();
  World world(options, support::one_material({0.9, 0.5, 1e9, 0}));
  constexpr double side = 0.5, depth = 0.2, bound = constants::push_out_speed / 2;
  for (const double z : {0.0, side - depth})
    world.add_rock(support::box_body(Vector3d::Constant(side / 2)), support::at(0, 0, z));
  double fastest = 0;
  while (world.rocks()[1].pose.translation().z() - world.rocks()[0].pose.translation().z() < side) {
    world.step();
    for (const auto& rock : world.rocks()) fastest = std::max(fastest, rock.velocity.norm());
    ASSERT_LT(world.time(), 1);  // 0.18 m at 1 m/s, the last 20 mm slower and slower
  }
  EXPECT_NEAR(fastest, bound, 1e-3 * bound);
}

// With restitution 1 and without friction a box that falls flat bounces for ever: it flies parabolas, and an impact
// turns its velocity round where it is. Only a step in which the floor pushes beside, because four corners touch one
// after the other, may cost or give: g h² / 2 of height at most, each of 120 s / 2 s bounces.
TEST_P(Impact, ABoxBouncesForEver) {
  for (const double h : {0.002, 0.01, 0.02}) {
    engine::WorldOptions options;
    options.solver.method = GetParam();
    options.step = h;
    World world(options, support::one_material({.friction = 0, .stiffness = 1e9, .restitution = 1}));
    world.add_static(support::shared(engine::HalfSpace{Vector3d::UnitZ(), 0}), Eigen::Isometry3d::Identity(),
                     0);
    world.add_rock(support::box_body(Vector3d::Constant(0.2)), support::at(0, 0, 2));
    const double g = options.gravity.norm(), mass = world.rock(0).body.mass;
    const auto energy = [&] {
      return world.kinetic_energy() / mass + g * (world.rock(0).pose.translation().z() - 0.2);
    };
    const double first = energy();
    while (world.time() < 120) world.step();
    EXPECT_NEAR(energy(), first, 120 / 1.2 * g * g * h * h / 2) << "h " << h;
  }
}

// Two rocks of any shape, spin and friction that strike each other: restitution gives back no more than it took, also
// where Newton's law would (Kane's paradox; solver.restitution_property has the impact alone). Bound: single precision
// over the steps of contact, as above, and the push that removes an overlap: turning by 8.7 rad/s for 1 ms brings a
// corner 0.35 m out 1.3e-5 m farther than its velocity says, two of them go out at 4/9 of 2.6e-5 m in a substep, 0.19
// m/s: 0.018 J/kg of 4.5.
TEST_P(Impact, RestitutionMakesNoEnergy) {
  engine::CounterRandom random(5);
  int rebounds = 0;
  for (int trial = 0; trial < 300; ++trial) {
    engine::WorldOptions options;
    options.gravity = Vector3d::Zero();
    options.solver.method = GetParam();
    const double e = trial % 3 == 0 ? 1 : random.uniform();
    World world(options, support::one_material(
                             {.friction = 2 * random.uniform(), .stiffness = 1e9, .restitution = e}));
    Eigen::Isometry3d a(random.rotation()), b(random.rotation());
    a.translation() = Vector3d(-0.5, 0.2 * random.uniform() - 0.1, 0.2 * random.uniform() - 0.1);
    b.translation() = Vector3d(0.5, 0, 0);
    const auto any = [&](double size) -> Vector3d {
      return size * (2 * Vector3d(random.uniform(), random.uniform(), random.uniform()) - Vector3d::Ones());
    };
    world.add_rock(support::rock_body(trial % 6, 0.6), a, Vector3d(3, 0, 0) + any(2), any(5));
    world.add_rock(support::rock_body((trial + 1) % 6, 0.4), b, Vector3d(-1, 0, 0) + any(1), any(5));
    double before = world.kinetic_energy();
    for (int k = 0; k < 400; ++k) {
      world.step(1e-3);
      const double now = world.kinetic_energy();
      ASSERT_LE(now, before * (1 + 4e-3)) << "trial " << trial << ", step " << k << ", e " << e;
      rebounds += now < before * (1 - 1e-3);
      before = now;
    }
  }
  EXPECT_GT(rebounds, 100) << "the rocks hardly met";
}
