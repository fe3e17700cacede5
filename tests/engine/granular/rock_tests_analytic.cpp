// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/granular/calibration/direct_shear.hpp>
#include <drawpoint/engine/granular/calibration/edge_penetration.hpp>
#include <drawpoint/engine/granular/calibration/plate_penetration.hpp>
#include <drawpoint/engine/granular/calibration/tilting_box.hpp>
#include <drawpoint/tests/support/scenes.hpp>
#include <limits>
#include <stdexcept>

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
// the block are a couple, which the contacts' springs answer by a tilt: with N = 130 kN on k = 1e10 N/m over
// a length of 2 m, at most 2 (N/k)/(1 m) = 3e-5 rad or 0.0015°, and T/N = tan(φ − tilt). Impulses pass
// through single precision and the iterations end at 1e-5 of the load: 2e-5 of T/N, 0.001°. Ten times the sum
// is allowed, for the swinging of a block that starts to slide. N is the weight of plate and block: 1e-4 of
// it for the same reason. The plate's middle rises or sinks by no more than the tilt times half a block's
// length, 3e-5 m, and what the contacts are pressed in by: 2.1e-5 m at the floor (207 kN), 1.3e-5 m between
// the blocks, 0.6e-5 m under the plate. These 7e-5 m over 0.29 m, the middle of the last part of the way, are
// 0.014°. (With 1e8 N/m the tilt shows: 0.04° to 0.08°.)
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
    EXPECT_NEAR(result.dilation, 0, 0.014) << friction;
  }
}

TEST(DirectShear, RefusesABoxWithoutRoomAndAnEmptyOne) {
  ShearOptions o = small_box();
  o.box.width = 1;
  EXPECT_THROW(ShearBox(sample_of(0.5), o), std::invalid_argument);
  ShearBox empty(sample_of(0.5), small_box());
  try {
    empty.load(1e3);
    FAIL() << "loaded an empty box";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "granular::direct_shear: rock stands 0.000000 m high in a box of 2.000000 m; fill it between "
        "1.200000 and 3.800000 m");
  }
}

TEST(DirectShear, RefusesWhatIsNoNumber) {
  ShearOptions o = small_box();
  o.box.height = std::nan("");
  try {
    ShearBox box(sample_of(0.5), o);
    FAIL() << "took a height of NaN";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "granular::direct_shear: a box of 4.000000 x 3.000000 x nan largest rocks; give at least 2 each "
        "way");
  }
  o = small_box();
  o.stress = std::numeric_limits<double>::infinity();
  EXPECT_THROW(ShearBox(sample_of(0.5), o), std::invalid_argument);
}

// A block of weight w between a floor and a plate: two contacts of k = 1e8 N/m. The block stands w/k deep in
// the floor, so the plate, which starts where the block's top was, meets it after δ_0 = w/k = 3.07e-5 m. From
// there the plate is pressed in by F/k and the floor by F/k more than before, and both take the damping of
// SPOOK, k τ v/2 with τ = 2 h = 20 ms, as the block goes at v/2: F = k (δ − δ_0 + τ v)/2, and W = ∫ F dδ from
// δ_0 on. The law acts in 16 substeps, over the overlap at either end of one: F is off by at most k (h
// v/16)/2 = 31 N of 97 kN, and W by that over the way, 0.063 J. The damping sets in with a whole step, so W
// is off by another (k τ v/2) h v = 0.01 J of 99 J. The solver's end, 1e-5 of the load, is 1 N and 1 mJ.
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
  const PenetrationResult result = push_in(world, plate, -way * Eigen::Vector3d::UnitZ(), o);
  ASSERT_EQ(result.curve.size(), 20u);
  double integral = 0;
  for (const PenetrationPoint& p : result.curve) integral += p.force * way / 20;
  EXPECT_NEAR(result.work, integral, 1e-9 * integral);  // the same sum in another order
  const double h = world.options().step, first = world.rock(0).body.mass * g / k, damping = 2 * h * o.speed;
  const auto& solver = world.options().solver;
  const double middle_of_last = way * (1 - 0.5 / 20), off = 0.5 * k * h * o.speed / solver.substeps;
  EXPECT_NEAR(result.curve.back().force, 0.5 * k * (middle_of_last - first + damping), off + 1);
  const double pressed = way - first, work = 0.5 * k * (0.5 * pressed * pressed + damping * pressed);
  EXPECT_NEAR(result.work, work, off * way + 0.5 * k * damping * h * o.speed + 1e-3);
}

// A smooth plate pushes a block along the floor at a steady speed, against its friction alone: F = μ m g,
// since what is smooth carries none of the weight. Jolt and tilt of the start die out with the contacts'
// damping, 20 ms, long before the second half of the way, 0.4 s after they have met. Impulses pass through
// single precision and the iterations end at 1e-5 of the load: 2e-5 of F. Ten times that is allowed. The
// block's face goes with the plate, which is pressed in by F/k = 3e-5 m at most.
TEST(EdgePenetration, PushesABlockAgainstItsFriction) {
  for (const double friction : {0.3, 0.6}) {
    engine::MaterialTable materials(2);
    materials.set(0, 0, {.friction = friction, .stiffness = 1e8});
    materials.set(0, 1, {.friction = 0, .stiffness = 1e8});
    engine::World world({}, materials);
    support::add_floor(world);
    world.add_rock(support::box_body({0.25, 0.25, 0.25}), at(0, 0, 0.25));
    engine::KinematicBody edge(at(-0.26, 0, 0.25));
    world.attach(&edge);
    world.add_part_shape(0, support::shared(engine::box({0.5, 0.5, 0.05})), at(-0.5, 0, 0), 1);
    for (int step = 0; step < 50; ++step) world.step();
    PushOptions o;
    o.parts = 2;
    const PenetrationResult result = push_in(world, edge, 0.1 * Eigen::Vector3d::UnitX(), o);
    const double expected = friction * world.rock(0).body.mass * g;
    EXPECT_NEAR(result.mean_force, expected, 2e-4 * expected) << friction;
    EXPECT_NEAR(world.rock(0).pose.translation().x(), 0.09, 3e-5) << friction;
  }
}

TEST(EdgePenetration, RefusesWhatHasNoRoomOrIsNoNumber) {
  EdgeOptions o;
  for (double* value : {&o.width, &o.height, &o.edge_width, &o.edge_thickness, &o.depth, &o.speed}) {
    SCOPED_TRACE(*value);
    for (const double wrong : {std::nan(""), 0.0, 1e3 * (value == &o.width || value == &o.height ? -1 : 1)}) {
      if (wrong == 1e3 && (value == &o.edge_thickness || value == &o.speed)) continue;  // thick and fast
      const double good = *value;
      *value = wrong;
      EXPECT_THROW(edge_penetration(sample_of(0.5), o), std::invalid_argument) << wrong;
      *value = good;
    }
  }
}

TEST(PlatePenetration, RefusesAPlateNearTheWalls) {
  PenetrationOptions o;
  o.width = o.side;
  EXPECT_THROW(plate_penetration(sample_of(0.5), o), std::invalid_argument);
}

TEST(PlatePenetration, RefusesWhatIsNoNumber) {
  PenetrationOptions o;
  for (double* value : {&o.side, &o.height, &o.depth, &o.speed}) {
    SCOPED_TRACE(*value);
    const double good = *value;
    *value = std::nan("");
    EXPECT_THROW(plate_penetration(sample_of(0.5), o), std::invalid_argument);
    *value = good;
  }
}

// A slab on the floor of the box: nothing moves up to φ = atan μ, and from there it gains g sin(θ − φ)/cos φ,
// so its way is g ω τ³/(6 cos φ) after τ = (θ − φ)/ω, to (ωτ)²/20 = 3e-4 of it. Half a mean length leaves the
// lower end 2 m away. The way is seen at the end of a step, θ = ω h late at most; semi-implicit steps are
// ahead by h/τ of the acceleration, 1 % of the way and so a third of it of τ. Contacts' springs: k = 1e10
// N/m, a tilt of some 1e-5 rad. What turning adds, the centrifugal acceleration ω² r and the Coriolis one 2 ω
// v on the floor's load, are at 2 deg/s 2e-4 and 4e-4 of g with opposite signs, 0.02° each and less together.
// So a step, ω h = 0.01° and 0.02°, twice for these, and 0.3 % of the 2° and 3° that it is late at 1 and 2
// deg/s.
TEST(TiltingBox, ASlabSlidesAtItsAngleOfFriction) {
  for (const double friction : {0.4, 0.8})
    for (const double rate : {1.0, 2.0}) {
      TiltingBoxOptions o;
      o.rate = rate;
      o.ribs = false;
      TiltingBox box(sample_of(friction), o);
      box.world().add_rock(support::box_body({0.4, 0.9, 0.1}), at(-box.length() / 2, 0, 0.1));
      for (int k = 0; k < 100; ++k) box.world().step();
      const TiltResult result = tilt(box, o);
      const double phi = std::atan(friction), omega = rate * M_PI / 180, way = 0.5 * box.mean_length();
      const double late = std::cbrt(6 * way * std::cos(phi) / (g * omega));
      EXPECT_NEAR(result.start, (phi + omega * late) * 180 / M_PI, 0.02 * rate + 0.003 * late * rate)
          << friction;
    }
}

TEST(TiltingBox, RefusesWhatIsNoNumberAndAnEmptyBox) {
  TiltingBoxOptions o;
  for (double* value : {&o.length, &o.width, &o.height, &o.rate}) {
    const double good = *value;
    *value = std::nan("");
    EXPECT_THROW(TiltingBox(sample_of(0.5), o), std::invalid_argument);
    *value = good;
  }
  TiltingBox empty(sample_of(0.5), o);
  EXPECT_THROW(tilt(empty, o), std::invalid_argument);
}
