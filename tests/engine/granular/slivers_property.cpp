// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Thin as a sheet or a needle: such rocks turn, fall and heap up without gaining energy; what has no inside
// is refused.
#include <gtest/gtest.h>

#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/engine/geometry/mass_properties.hpp>
#include <drawpoint/tests/support/scenes.hpp>

using namespace drawpoint::engine;
using namespace drawpoint::support;

namespace {

double energy(const World& world) {
  double sum = world.kinetic_energy();
  for (const Rock& rock : world.rocks()) sum += rock.body.mass * 9.81 * rock.pose.translation().z();
  return sum;
}

void expect_finite(const World& world) {
  for (const Rock& rock : world.rocks()) {
    ASSERT_TRUE(rock.pose.matrix().allFinite());
    ASSERT_TRUE(rock.velocity.allFinite() && rock.angular_velocity.allFinite());
  }
}

MaterialTable stone() { return one_material({.friction = 0.6, .rolling = 0.05, .stiffness = 1e8}); }

/// A body of a shape moved to its centre of mass and principal axes.
RockBody body_of(const ConvexPolyhedron& shape) {
  const auto properties = mass_properties(shape, 2500);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(properties.inertia);
  Eigen::Matrix3d axes = eigen.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  Eigen::Isometry3d X(axes.transpose());
  X.translation() = -axes.transpose() * properties.centre;
  return {shared(shape.transformed(X)), properties.mass, eigen.eigenvalues(), 0};
}

std::vector<RockBody> slivers() {
  const std::vector<Vector3d> sliver{{0, 0, 0}, {0.4, 0, 0}, {0.2, 0.3, 0}, {0.2, 0.1, 1e-3}};
  return {body_of(box({0.3, 0.3, 5e-5})), body_of(box({0.4, 1e-3, 1e-3})), body_of(prism(0.3, 1e-4, 24)),
          body_of(ConvexPolyhedron::hull_of(sliver)), body_of(box({0.4, 1e-4, 1e-4}))};
}

// Sheets, needles and slivers, as thin as 2e-4 of their width or 1/4000 of their length, in free flight at 3
// to 60 rad/s: the turn keeps angular momentum, and of the energy all but a swing. The flows that it is split
// into are exact for a body with two equal moments; for the sliver the swing is below (hω)²/8, and ω·h is
// 0.03 to 0.6. A direction of L that is off by ε would cost a needle ε² 1e7 of its energy.
TEST(Slivers, TurnFreelyWithoutGain) {
  for (const RockBody& body : slivers())
    for (const double rate : {3.0, 20.0, 60.0}) {
      WorldOptions options;
      options.gravity.setZero();
      World world(options, stone());
      world.add_rock(body, at(0, 0, 0), {0, 0, 0}, rate * Vector3d(0.02, 1, 0.3).normalized());
      const double start = world.kinetic_energy(), swing = 1e-6 + std::pow(rate * options.step, 2) / 8;
      for (int k = 0; k < 1000; ++k) {
        world.step();
        ASSERT_NEAR(world.kinetic_energy(), start, swing * start) << rate << " rad/s, step " << k;
      }
    }
}

// One at a time, thrown spinning on the floor: none breaks the solution, none ends above the energy that it
// came with (contacts with e = 0 take; 1e-3 of it for gravity's discretisation), all lie still or roll
// slowly after four seconds; the needle of 0.08 g is the last.
TEST(Slivers, FallWithoutGain) {
  for (const RockBody& body : slivers()) {
    World world({}, stone());
    add_floor(world);
    world.add_rock(body, at(0, 0, 0.5), {0, 0, 0}, {3, 20, 5});
    const double start = energy(world);
    for (int k = 0; k < 400; ++k) {
      world.step();
      expect_finite(world);
      ASSERT_LT(energy(world), start * (1 + 1e-3)) << "step " << k;
    }
    EXPECT_GT(world.rocks()[0].pose.translation().z(), -0.01);
    EXPECT_LT(world.fastest_rock(), 0.1);
  }
}

// Many in a heap: they stay finite and above the floor by their centres.
TEST(Slivers, HeapUpAndStayBounded) {
  const std::vector<RockBody> bodies = slivers();
  World world({}, stone());
  add_floor(world);
  CounterRandom turns(11);
  for (int k = 0; k < 12; ++k) {
    Eigen::Isometry3d pose(turns.rotation());
    pose.translation() = Vector3d(0.1 * (k % 3), 0.1 * (k / 3), 0.5 + 0.3 * k);
    world.add_rock(bodies[static_cast<std::size_t>(k % 4)], pose);
  }
  for (int k = 0; k < 200; ++k) {
    world.step();
    expect_finite(world);
  }
  for (const Rock& rock : world.rocks()) EXPECT_GT(rock.pose.translation().z(), -0.01);
}

TEST(Slivers, WithoutVolumeAreRefused) {
  const double nan = std::nan("");
  const std::vector<std::vector<Vector3d>> none{
      {},
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},
      {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-10}},
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, nan}},
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::numeric_limits<double>::infinity()}}};
  for (const auto& points : none) {
    try {
      ConvexPolyhedron::hull_of(points);
      ADD_FAILURE() << points.size() << " points without volume were taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("give at least four finite points"), std::string::npos);
    }
  }
}

}  // namespace
