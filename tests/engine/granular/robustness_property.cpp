// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Nothing breaks the engine: what is thrown, squeezed, born overlapping or very many gives a bounded result
// or a status, never a number that is not finite. Thin shapes: slivers_property.cpp; the loader against a
// wall: tests/engine/loading/wall_property.cpp.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <ctime>
#include <drawpoint/engine/world/state_hash.hpp>
#include <drawpoint/tests/support/blade_pile.hpp>

using namespace drawpoint::engine;
using namespace drawpoint::support;

namespace {

constexpr double g = 9.81;

/// Kinetic and potential energy of the rocks that are there, over z = 0 [J].
double energy(const World& world) {
  double sum = world.kinetic_energy();
  for (const Rock& rock : world.rocks())
    if (rock.present) sum += rock.body.mass * g * rock.pose.translation().z();
  return sum;
}

void expect_finite(const World& world) {
  for (const Rock& rock : world.rocks()) {
    ASSERT_TRUE(rock.pose.matrix().allFinite());
    ASSERT_TRUE(rock.velocity.allFinite() && rock.angular_velocity.allFinite());
  }
}

double farthest_x(const Rock& rock) {
  double x = -1e9;
  for (const Vector3d& v : std::get<ConvexPolyhedron>(*rock.body.shape).vertices())
    x = std::max(x, (rock.pose * v).x());
  return x;
}

MaterialTable stone() { return one_material({.friction = 0.6, .rolling = 0.05, .stiffness = 1e8}); }

struct Throw {
  double speed, step;
  int shape;
};

class Thrown : public testing::TestWithParam<Throw> {};

// A rock thrown at a plate 20 mm thick, up to 1 m per step, is stopped by it: a contact is searched as far as
// the rock may go in the step, and an open gap lets through no more than what closes it. The linearised gap
// sees the rock's turn during the step to first order, so corners may dip in for a step, but its centre never
// passes the face, and when it lies still nothing is left of it. Contacts with e = 0 take energy and
// gravity's discretisation gives none (q and v are advanced in the same order: an error of m g² h²/2 per step
// in free flight, of either sign: 50 steps of a 0.3 m rock of 50 kg, h = 0.01: below 12 J of 250 kJ).
TEST_P(Thrown, IsStoppedByAThinWall) {
  WorldOptions options;
  options.step = GetParam().step;
  World world(options, stone());
  add_floor(world);
  world.add_static(shared(box({0.01, 60, 60})), at(5.01, 0, 60), 0);  // its face at x = 5
  const auto body = rock_body(GetParam().shape, 0.4);
  world.add_rock(body, at(0, 0, 1.5), {GetParam().speed, 0, 0}, {3, 20, 5});
  const double start = energy(world), slack = 1e-3 * start;
  for (double t = 0; t < 8;
       t += options.step) {  // the wall's impact and the floor may throw it up once or twice
    world.step();
    expect_finite(world);
    ASSERT_LT(world.rocks()[0].pose.translation().x(), 5) << "at t = " << world.time();
    ASSERT_LT(energy(world), start + slack) << "at t = " << world.time();
  }
  EXPECT_LT(farthest_x(world.rocks()[0]), 5.001);
  EXPECT_LT(world.fastest_rock(), 5);
}

INSTANTIATE_TEST_SUITE_P(Speeds, Thrown,
                         testing::Values(Throw{100, 0.01, 0}, Throw{100, 0.005, 2}, Throw{100, 0.01, 4},
                                         Throw{30, 0.01, 1}, Throw{10, 0.01, 3}, Throw{500, 0.01, 5}));

// Thrown at a heap before a wall of the same plate: the energy of all never rises above what was there, and
// nothing gets through.
TEST(ThrownRock, IsCaughtByAPile) {
  World world({}, stone());
  add_floor(world);
  world.add_static(shared(box({0.01, 60, 60})), at(5.01, 0, 60), 0);
  CounterRandom turns(3);
  for (int k = 0; k < 24; ++k) {
    Eigen::Isometry3d pose(turns.rotation());
    pose.translation() = Vector3d(4.6 - 0.5 * (k % 2), -0.9 + 0.5 * (k / 2 % 4), 0.3 + 0.5 * (k / 8));
    world.add_rock(rock_body(k % 6, 0.4), pose);
  }
  for (int k = 0; k < 100; ++k) world.step();
  world.add_rock(rock_body(2, 0.6), at(0, 0, 0.8), {100, 0, 0});
  const double start = energy(world);
  for (int k = 0; k < 200; ++k) {
    world.step();
    expect_finite(world);
    ASSERT_LT(energy(world), start * (1 + 1e-3)) << "at t = " << world.time();
    for (const Rock& rock : world.rocks()) ASSERT_LT(rock.pose.translation().x(), 5) << world.time();
  }
}

// Two equal rocks born overlapping by half their size. A substep hs asks a point at overlap d for the
// separating speed Υ (u + 4 d/hs) with Υ = 1/(1 + 4τ/hs), τ ≥ 2h; u can so grow to no more than its fixed
// point 4 d/hs · Υ/(1 − Υ) = d/τ ≤ d/2h, d the overlap at birth. Impulses that push only, from rest, give the
// velocities of least kinetic energy that separate all points that fast; drawing the rocks apart without
// turning along the axis of least overlap is one way to do that and costs ½ (m/2) (d/2h)². One iteration a
// substep may overshoot where a manifold's points work against each other: 5 %.
TEST(OverlappingRocks, PartWithBoundedSpeed) {
  for (int shape = 0; shape < 6; ++shape) {
    WorldOptions options;
    options.gravity.setZero();
    World world(options, stone());
    const auto body = rock_body(shape, 0.4);
    world.add_rock(body, at(0, 0, 0));
    world.add_rock(body, at(0.2, 0, 0));
    const double depth = world.step().max_overlap;
    EXPECT_GT(depth, 0.05);
    const double fastest = depth / (2 * options.step), most = 0.25 * body.mass * fastest * fastest;
    for (int k = 0; k < 100; ++k) {
      ASSERT_LT(world.kinetic_energy(), 1.05 * most) << "shape " << shape << ", step " << k;
      world.step();
      expect_finite(world);
    }
    EXPECT_EQ(world.step().points, 0) << "shape " << shape << ": they must have parted";
  }
}

// Eight born in one place: there is no direction to part in, but there is a result. Two part with at most
// d/2h, see above, d at most their size of 0.5 m; along a chain of eight that adds up to seven times as much.
TEST(OverlappingRocks, BornInOnePlaceStayFinite) {
  World world({}, stone());
  add_floor(world);
  for (int k = 0; k < 8; ++k) world.add_rock(rock_body(k % 6, 0.5), at(0, 0, 0.5));
  for (int k = 0; k < 200; ++k) {
    world.step();
    expect_finite(world);
  }
  EXPECT_LT(world.fastest_rock(), 7 * 0.5 / (2 * world.options().step));
}

// A rock between a wall and a blade that a motor pushes at 0.6 m/s. The motor gives at most its limit,
// whatever stands in the way; with 20 kN the rock (1e8 N/m, at least 20e3/1e8 = 0.2 mm) holds the blade; with
// 1 GN, which would press it in by its own size, everything stays finite and no faster than parting allows.
class Squeezed : public testing::TestWithParam<double> {};

TEST_P(Squeezed, StaysBounded) {
  machine::Machine blade(blade_on_a_slider(GetParam()));
  World world({}, stone());
  add_floor(world);
  world.add_static(shared(box({0.2, 3, 3})), at(0.7, 0, 3), 0);  // its face at x = 0.5
  world.attach(&blade);
  world.add_part_shape(0, shared(box({0.05, 1.4, 0.4})), at(0, 0, 0), 0);
  world.add_rock(rock_body(1, 0.5), at(0, 0, 0.3));
  blade.set_motor(0, 0.6);
  for (int k = 0; k < 500; ++k) {
    world.step();
    expect_finite(world);
    ASSERT_LE(std::abs(blade.motor_force(0)), GetParam() * (1 + 1e-9));
    ASSERT_LT(world.fastest_rock(), 0.5 / (2 * world.options().step));
    ASSERT_LE(blade.speed(0), 0.6 * (1 + 1e-3));
  }
  if (GetParam() > 1e6) return;
  EXPECT_LT(world.fastest_rock(), 0.01);
  EXPECT_LT(blade.coordinate(0), 1.5 + 0.5);
  EXPECT_NEAR(blade.motor_force(0), GetParam(), 1e-3 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(Forces, Squeezed, testing::Values(20e3, 1e9));

TEST(Crowd, NoRocksAtAll) {
  World world({}, stone());
  const StepReport report = world.step();
  EXPECT_EQ(report.points, 0);
  EXPECT_EQ(report.max_overlap, 0);
  EXPECT_EQ(world.kinetic_energy(), 0);
  World(world.options(), stone()).restore(world.save());
}

// 20 000 rocks over a floor, the lowest layer touching it: two steps within a minute and 2 GB, both far above
// what is needed (some 0.2 s per step and 0.3 GB), so that only a cost that grows with the square fails.
TEST(Crowd, OfTwentyThousand) {
  const auto start = std::clock();
  World world({}, stone());
  add_floor(world);
  CounterRandom turns(5);
  const std::array<RockBody, 6> bodies{rock_body(0, 0.3), rock_body(1, 0.3), rock_body(2, 0.3),
                                       rock_body(3, 0.3), rock_body(4, 0.3), rock_body(5, 0.3)};
  for (int k = 0; k < 20000; ++k) {
    Eigen::Isometry3d pose(turns.rotation());
    pose.translation() = Vector3d(0.27 * (k % 50), 0.27 * (k / 50 % 40), 0.15 + 0.27 * (k / 2000));
    world.add_rock(bodies[static_cast<std::size_t>(k % 6)], pose);
  }
  for (int k = 0; k < 2; ++k) world.step();
  expect_finite(world);
  EXPECT_GT(world.problem().points.size(), 2000u) << "the lowest layer alone has 2000 rocks";
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 60);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 2'000'000);  // [kB]
}

}  // namespace
