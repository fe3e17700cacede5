// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/world/kinematic_body.hpp>
#include <drawpoint/engine/world/state_hash.hpp>
#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/support/told.hpp>

using namespace drawpoint::engine;
using drawpoint::support::at;
using drawpoint::support::box_body;
using drawpoint::support::one_material;
using drawpoint::support::shared;
using drawpoint::support::told;
using Eigen::Vector3d;

namespace {

constexpr double g = 9.81;

// A plate whose upper side is at z = 0, with a block of 0.4 m on it.
struct Carried {
  explicit Carried(const WorldOptions& options)
      : world(options, one_material({.friction = 0.5, .stiffness = 1e8})) {
    world.attach(&plate);
    world.add_part_shape(0, shared(box({20, 1, 0.25})), at(0, 0, 0), 0);
    world.add_rock(box_body({0.2, 0.2, 0.2}), at(0, 0, 0.2));
  }
  double mass() const { return world.rock(0).body.mass; }

  KinematicBody plate{at(0, 0, -0.25)};
  World world;
};
}  // namespace

// A steady twist for n steps: p = v n h and a turn of ω n h, but for n roundings of 1e-16 of numbers of size 1.
TEST(KinematicBody, GoesWhereItIsTold) {
  World world({}, one_material({.friction = 0.5}));
  KinematicBody body(at(0, 0, 1));
  world.attach(&body);
  const Vector3d velocity(0.3, -0.2, 0.1), spin(0.2, 0.5, -0.4);
  body.set_velocity(velocity, spin);
  for (int k = 0; k < 300; ++k) world.step();
  const double t = 3;
  EXPECT_LT((body.pose().translation() - Vector3d(0, 0, 1) - t * velocity).norm(), 1e-13);
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(t * spin.norm(), spin.normalized()).toRotationMatrix();
  EXPECT_LT((body.pose().linear() - turned).norm(), 1e-13);
}

// A block on the plate at rest presses on it by its weight (stack_analytic.cpp has the budget of 1e-3); about the
// plate's origin, 0.25 m below the contact and at the block's x, without a moment: four corners that share the load
// unequally move its centre by less than a thousandth of the block.
TEST(KinematicBody, FeelsAWeight) {
  Carried scene({});
  for (int k = 0; k < 200; ++k) scene.world.step();
  const double weight = g * scene.mass();
  const Wrench& felt = scene.plate.contact_wrench();
  EXPECT_LT((felt.force + weight * Vector3d::UnitZ()).norm(), 1e-3 * weight);
  EXPECT_LT(felt.moment.norm(), 1e-3 * weight * 0.4);
  EXPECT_EQ(scene.plate.work(), 0);
  EXPECT_EQ(scene.plate.pose().translation(), Vector3d(0, 0, -0.25));
}

// Set moving at V, the plate drags the block along: friction works on the way V t, t = V/(μ g), so m V² in
// all, half of it kinetic, half lost. The end of the slip falls between two steps: an error of at most one
// step's work, μ m g V h.
TEST(KinematicBody, WorksOnWhatItDrags) {
  WorldOptions options;
  options.step = 1e-3;
  Carried scene(options);
  for (int k = 0; k < 500; ++k) scene.world.step();
  const double V = 1, exact = scene.mass() * V * V;
  scene.plate.set_velocity({V, 0, 0});
  for (int k = 0; k < 500; ++k) scene.world.step();
  EXPECT_NEAR(scene.plate.work(), exact, 0.5 * scene.mass() * g * V * options.step + 1e-3 * exact);
  EXPECT_NEAR(scene.world.kinetic_energy(), 0.5 * exact, 1e-2 * exact);
}

// A box that friction must hold for ever on a turntable: ω² r / (μ g) = 0.51. What the contact's point and
// the box do in a step differ in the third order, (ω h)³ r/24 = 3e-7 m at 10 ms, 3e-4 m in 10 s in one
// direction at most.
TEST(KinematicBody, HoldsABoxOnATurntable) {
  for (const double h : {0.01, 0.005}) {
    WorldOptions options;
    options.step = h;
    World world(options, one_material({.friction = 0.8, .stiffness = 1e8}));
    KinematicBody table(at(0, 0, -0.25));
    world.attach(&table);
    world.add_part_shape(0, shared(box({3, 3, 0.25})), at(0, 0, 0), 0);
    const double spin = 2;
    world.add_rock(box_body({0.1, 0.1, 0.05}), at(1, 0, 0.05), Vector3d(0, spin, 0), Vector3d(0, 0, spin));
    table.set_velocity(Vector3d::Zero(), {0, 0, spin});
    for (int k = 0; k < 10 / h; ++k) world.step();
    const Vector3d p = table.pose().linear().transpose() * world.rock(0).pose.translation();
    EXPECT_LT((p.head<2>() - Eigen::Vector2d(1, 0)).norm(), 1e-3) << p.transpose();
  }
}

// A truck bed that pulls away at 4 m/s² of the 7.8 that friction gives takes its load along. The load has the
// bed's speed in the middle of a substep, a h/(2 S) = 1.25 mm/s less than at the end of a step; it slips
// while the start is taken up, one substep, by less than 1e-5 m.
TEST(KinematicBody, CarriesALoadAlongWhenItSpeedsUp) {
  World world({}, one_material({.friction = 0.8, .stiffness = 1e8}));
  KinematicBody bed(at(0, 0, -0.25));
  world.attach(&bed);
  world.add_part_shape(0, shared(box({30, 3, 0.25})), at(0, 0, 0), 0);
  world.add_rock(box_body({0.4, 0.4, 0.1}), at(0, 0, 0.1));
  for (int k = 0; k < 20; ++k) world.step();
  bed.set_acceleration({4, 0, 0});
  for (int k = 0; k < 100; ++k) world.step();
  EXPECT_NEAR(bed.velocity().x(), 4, 1e-12);
  EXPECT_NEAR(bed.pose().translation().x(), 2, 1e-12);
  EXPECT_NEAR(world.rock(0).velocity.x(), 4 - 1.25e-3, 1e-4);
  EXPECT_NEAR(world.rock(0).pose.translation().x(), 2, 1e-4);
}

// A paddle at 60 rad/s, half a turn in five steps, does not pass a rock that lies in its way: it throws it.
TEST(KinematicBody, AFastPaddleDoesNotPassARock) {
  for (int start = 0; start < 20; ++start) {
    WorldOptions options;
    options.gravity = Vector3d::Zero();
    World world(options, one_material({.friction = 0.3, .stiffness = 1e8}));
    KinematicBody paddle(at(0, 0, 0));
    world.attach(&paddle);
    world.add_part_shape(0, shared(box({1, 0.02, 0.5})), at(0, 0, 0), 0);
    const double angle = 0.4 + 0.1 * start;
    world.add_rock(box_body({0.1, 0.1, 0.1}), at(0.6 * std::cos(angle), 0.6 * std::sin(angle), 0));
    paddle.set_velocity(Vector3d::Zero(), {0, 0, 60});
    for (int k = 0; k < 8; ++k) world.step();
    EXPECT_GT(world.rock(0).velocity.norm(), 20) << angle;
  }
}

// Nor does a blade that is sped up from rest: 200 m/s² are 10 mm in the first step, 2000 m/s² are 100 mm.
TEST(KinematicBody, ABladeThatIsSpedUpDoesNotEnterARock) {
  for (const double acceleration : {50.0, 200.0, 2000.0})
    for (const double gap : {0.0015, 0.002, 0.006}) {
      WorldOptions options;
      options.gravity = Vector3d::Zero();
      World world(options, one_material({.friction = 0.3, .stiffness = 1e9}));
      KinematicBody blade(at(-0.01 - gap, 0, 0));
      world.attach(&blade);
      world.add_part_shape(0, shared(box({0.01, 1, 1})), at(0, 0, 0), 0);
      world.add_rock(box_body({0.1, 0.1, 0.1}), at(0.1, 0, 0));
      blade.set_acceleration({acceleration, 0, 0});
      for (int k = 0; k < 3; ++k) {
        world.step();
        EXPECT_GT(world.rock(0).pose.translation().x() - 0.1, blade.pose().translation().x() + 0.01 - 1e-3)
            << acceleration << " m/s2, gap " << gap << " m, step " << k;
      }
    }
}

TEST(KinematicBody, GoesOnWithTheSameBitsAfterARestore) {
  Carried first({}), second({});
  first.plate.set_velocity({0.5, 0, 0}, {0, 0, 0.1});
  for (int k = 0; k < 30; ++k) first.world.step();
  second.world.restore(first.world.save());
  EXPECT_EQ(second.plate.velocity(), first.plate.velocity());
  for (int k = 0; k < 30; ++k) {
    first.world.step();
    second.world.step();
  }
  EXPECT_EQ(state_hash(first.world), state_hash(second.world));
  EXPECT_EQ(first.plate.work(), second.plate.work());
}

TEST(KinematicBody, RefusesWhatCannotBe) {
  KinematicBody body(at(0, 0, 0));
  EXPECT_NE(told([&] { body.set_velocity({1001, 0, 0}); }).find("0 to 1000 m/s"), std::string::npos);
  EXPECT_NE(told([&] {
              body.set_velocity({0, std::nan(""), 0});
            }).find("KinematicBody::set_velocity"),
            std::string::npos);
  EXPECT_NE(told([&] {
              body.set_acceleration({0, 0, 1e7});
            }).find("KinematicBody::set_acceleration"),
            std::string::npos);
  EXPECT_NE(told<std::runtime_error>([&] {
              body.set_state({1, 2, 3});
            }).find("3 numbers that are not the state"),
            std::string::npos);
  EXPECT_EQ(body.velocity(), Vector3d(0, 0, 0));
}
