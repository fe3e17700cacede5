// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/granular/calibration/direct_shear.hpp>
#include <drawpoint/engine/granular/calibration/plate_penetration.hpp>
#include <drawpoint/tests/support/scenes.hpp>

using namespace drawpoint;
using namespace drawpoint::engine::granular;
using support::at;

namespace {

constexpr double g = 9.81;

ShearOptions small_box() {
  ShearOptions o;
  o.box = {.length = 4, .width = 3, .height = 4};
  o.stress = 20e3;
  o.speed = 0.1;
  return o;
}

RockSample sample_of(double friction) {
  RockSample sample;
  sample.contact = {.friction = friction, .stiffness = 1e10};
  sample.sizes = single_size(0.5);
  return sample;
}

// A block that fills the lower half of the box, and one that lies on it.
void add_blocks(ShearBox& box) {
  const Eigen::Vector3d half(box.length() / 2 - 0.002, box.width() / 2 - 0.002, box.height() / 4);
  for (const double z : {1.0, 3.0}) box.world().add_rock(support::box_body(half), at(0, 0, z * half.z()));
}

}  // namespace

// One block slides on another: T = μ N exactly, φ = atan μ. The push of the rear wall and the friction under
// the block are a couple, which the contacts' springs answer by a tilt: with N = 130 kN on k = 1e10 N/m over a
// length of 2 m, at most 2 (N/k)/(1 m) = 3e-5 rad or 0.0015°, and T/N = tan(φ − tilt). Impulses pass through
// single precision and the iterations end at 1e-5 of the load: 2e-5 of T/N, 0.001°. Ten times the sum is
// allowed, for the swinging of a block that starts to slide. N is the weight of plate and block: 1e-4 of it
// for the same reason. (With 1e8 N/m the tilt shows: 0.04° to 0.08°.)
TEST(DirectShear, OneBlockOnAnotherGivesItsCoefficient) {
  for (const double friction : {0.3, 0.6, 0.9}) {
    const ShearOptions o = small_box();
    ShearBox box(sample_of(friction), o);
    add_blocks(box);
    box.load(o.stress);
    for (int k = 0; k < 100; ++k) box.world().step();
    const ShearResult result = shear(box, o);
    ASSERT_EQ(result.status, RunStatus::completed);
    EXPECT_NEAR(result.large, std::atan(friction) * 180 / M_PI, 0.025) << friction;
    const double area = box.length() * box.width(),
                 expected = o.stress + box.world().rock(1).body.mass * g / area;
    EXPECT_NEAR(result.normal_stress, expected, 1e-4 * expected) << friction;
    EXPECT_NEAR(result.dilation, 0, 0.02) << friction;
  }
}

TEST(DirectShear, RefusesABoxWithoutRoomAndAnEmptyOne) {
  ShearOptions o = small_box();
  o.box.width = 1;
  EXPECT_THROW(ShearBox(sample_of(0.5), o), std::invalid_argument);
  ShearBox empty(sample_of(0.5), small_box());
  EXPECT_THROW(empty.load(1e3), std::invalid_argument);
}

// A block between a floor and a plate: two contacts of k = 1e8 N/m in series. From touching, a way of δ takes
// F = k δ/2, up to the damping of SPOOK that acts while the plate moves (τ = 2 h: k τ v/2 at a speed v, and
// the same for both contacts), so F(δ) = k (δ + τ v)/2 + what the block weighs at the floor. The work is the integral of what the
// plate feels. At v = 1 mm/s and δ = 2 mm the damping is 1e-3 · 0.02 / 2e-3 = 1 %, which is the budget; the
// block's weight, 2.5 kN of 100 kN, is on the floor already and shared by no spring of the plate.
TEST(PlatePenetration, WorkIsTheIntegralOfForceAndForceThatOfTheSprings) {
  constexpr double k = 1e8, way = 2e-3;
  engine::World world({}, support::one_material({.friction = 0.5, .stiffness = k}));
  support::add_floor(world);
  world.add_rock(support::box_body({0.25, 0.25, 0.25}), at(0, 0, 0.25));
  engine::KinematicBody plate(at(0, 0, 0.5));
  world.attach(&plate);
  world.add_part_shape(0, support::shared(engine::box({0.1, 0.1, 0.5})), at(0, 0, 0.5), 0);
  for (int step = 0; step < 50; ++step) world.step();
  PenetrationOptions o;
  o.speed = 1e-3;
  o.parts = 20;
  const PenetrationResult result = push_down(world, plate, way, o);
  ASSERT_EQ(result.curve.size(), 20u);
  double integral = 0;
  for (const PenetrationPoint& p : result.curve) integral += p.force * way / 20;
  EXPECT_NEAR(result.work, integral, 1e-9 * integral);  // the same sum in another order
  const double middle_of_last = way * (1 - 0.5 / 20);
  EXPECT_NEAR(result.curve.back().force, k * middle_of_last / 2, 0.02 * k * way / 2);
  EXPECT_NEAR(result.work, k * way * way / 4, 0.03 * k * way * way / 4);
}

TEST(PlatePenetration, RefusesAPlateNearTheWalls) {
  PenetrationOptions o;
  o.width = o.side;
  EXPECT_THROW(plate_penetration(sample_of(0.5), o), std::invalid_argument);
}
