// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <drawpoint/tests/validation/settings.hpp>
#include <numbers>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;
using validation::record;

namespace {

const validation::Problem spinning{
    "spinning", validation::Group::single_body, "Spinning to rest on the spot",
    "A disc (radius 0.5 m) and a square block (0.8 m) spin flat at 5 rad/s on four contact points (5 "
    "ms, reference settings), so that the disc's friction moment is μ m g R, not 2/3 of it."};

constexpr double g = 9.81, rate = 5, stiffness = 1e8;

struct Case {
  std::string name;
  engine::RockBody body;
  Eigen::Matrix3d upright;
  double height, inertia;  // of the centre [m]; about the vertical [kg m²]
};

Case disc() {
  constexpr double R = 0.5, half = 0.1, mass = 300;
  const double across = mass * (R * R / 4 + half * half / 3), along = mass * R * R / 2;
  const Eigen::Matrix3d upright =
      Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX()).toRotationMatrix();
  return {"disc",
          {support::shared(engine::Cylinder{R, half}), mass, Vector3d(across, along, across), 0},
          upright,
          half,
          along};
}

Case block() {
  const auto body = support::box_body({0.4, 0.4, 0.1});
  return {"block", body, Eigen::Matrix3d::Identity(), 0.1, body.inertia.z()};
}

struct Stop {
  double angle = 0, time = 0, substep = 0;
};

Stop spin(const Case& c, const engine::Material& material) {
  const engine::WorldOptions options = validation::reference_settings();
  World world(options, support::one_material(material));
  support::add_floor(world);
  Eigen::Isometry3d pose = support::at(0, 0, c.height - c.body.mass * g / stiffness);
  pose.linear() = c.upright;
  world.add_rock(c.body, pose, Vector3d::Zero(), Vector3d(0, 0, rate));
  const auto& rock = world.rocks()[0];
  Stop stop{0, 0, options.step / options.solver.substeps};
  Eigen::Matrix3d before = c.upright;
  while (world.time() < 3) {
    world.step();
    stop.angle += Eigen::AngleAxisd(rock.pose.linear() * before.transpose()).angle();
    before = rock.pose.linear();
    if (rock.angular_velocity.z() > 1e-6 * rate) stop.time = world.time();
  }
  return stop;
}

// Under a constant moment M the stepper's rates ω − n s M/I are exact (s the substep) and the angle is their
// sum: ω² I/(2M) − ω s/2, and up to M s²/(8 I) for the last, broken substep.
void compare(const Case& c, const engine::Material& material, double moment, const std::string& by,
             const std::string& moment_is) {
  const Stop stop = spin(c, material);
  const double braking = moment / c.inertia;
  record(spinning,
         {.quantity = c.name + " turns until " + by + " stops it",
          .unit = "rad",
          .expected = rate * rate / (2 * braking),
          .source = "ω² I/(2M), " + moment_is,
          .measured = stop.angle,
          .budget = rate * stop.substep / 2 + braking * stop.substep * stop.substep / 8 +
                    1e-4 * rate * rate / (2 * braking),
          .budget_reason =
              "Angle: the sum of the rates at the ends of the substeps s is ω s/2 short; 1e-4 of it "
              "for the load's evening out over the four points."});
  record(spinning, {.quantity = c.name + ": time until " + by + " stops it",
                    .unit = "s",
                    .expected = rate / braking,
                    .source = "ω I/M, " + moment_is,
                    .measured = stop.time,
                    .budget = 0.005 + 1e-4 * rate / braking,
                    .budget_reason = "Time: seen at whole steps of 5 ms."});
}

}  // namespace

TEST(Spinning, FrictionStopsADisc) {
  const Case c = disc();
  compare(c, {0.3, 0, stiffness, 0}, 0.3 * c.body.mass * g * 0.5, "friction 0.3", "M = μ m g R");
}

TEST(Spinning, FrictionStopsABlock) {
  const Case c = block();
  compare(c, {0.3, 0, stiffness, 0}, 0.3 * c.body.mass * g * 0.4 * std::numbers::sqrt2, "friction 0.3",
          "M = μ m g r, r to a corner");
}

TEST(Spinning, SpinningResistanceStopsADiscWithoutFriction) {
  const Case c = disc();
  engine::Material material{0, 0, stiffness, 0};
  material.spinning = 0.2;
  const double volume = std::numbers::pi * 0.5 * 0.5 * 0.2;
  const double R_star = std::cbrt(3 * volume / (4 * std::numbers::pi));
  compare(c, material, 0.2 * R_star * c.body.mass * g, "spinning resistance 0.2", "M = μ_s R* m g");
}
