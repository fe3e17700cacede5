// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <drawpoint/tests/validation/settings.hpp>
#include <numbers>

using namespace drawpoint;
using Eigen::Vector2d;
using Eigen::Vector3d;
using engine::World;
using validation::record;

namespace {

const validation::Problem sliding_rod{
    "sliding_rod", validation::Group::single_body, "Painlevé's sliding rod",
    "A rod of 2 m, tilted by 58.3°, slides at 2 m/s with its lower end ahead and friction 2, where no "
    "sliding motion solves the equations, so that it vaults over that end (0.5 ms, reference "
    "settings)."};

constexpr double g = 9.81, mu = 2, speed = 2, tilt = 58.3 * std::numbers::pi / 180, h = 5e-4;
const Vector3d half(1, 0.02, 0.02);

// The plane x-z; angles from x to z. Centre over the tip:
const Vector2d over(half.x() * std::cos(tilt) - half.z() * std::sin(tilt),
                    half.x() * std::sin(tilt) + half.z() * std::cos(tilt));

struct Rod {
  engine::RockBody body = support::box_body(half);
  double inertia = body.inertia.y(), about_tip = inertia + body.mass * over.squaredNorm();
};

World thrown() {
  const engine::WorldOptions options = validation::reference_settings(h);
  World world(options, support::one_material({mu, 0, 1e9, 0}));
  support::add_floor(world);
  Eigen::Isometry3d pose = support::at(0, 0, over.y());
  pose.linear() = Eigen::AngleAxisd(tilt, -Vector3d::UnitY()).toRotationMatrix();
  world.add_rock(Rod().body, pose, Vector3d(-speed, 0, 0));
  return world;
}

double energy(const World& world) {
  const auto& rock = world.rocks()[0];
  return world.kinetic_energy() + rock.body.mass * g * rock.pose.translation().z();
}

// Rate about the tip a time t after it has caught: angular momentum about it is kept by the jam, then gravity
// pulls, I ω' = −m g × (horizontal distance of the centre); t is short, so one middle value does.
double vaulting_rate(const Rod& rod, double t) {
  const double caught = rod.body.mass * over.y() * speed / rod.about_tip;
  const double middle = over.x() - caught * over.y() * t / 2;
  return caught - rod.body.mass * g * middle * t / rod.about_tip;
}

}  // namespace

TEST(SlidingRod, VaultsOverTheTip) {
  const Rod rod;
  // While it slides towards −x the tip's normal acceleration for a normal force 1 is p: the paradox is p < 0.
  const double p = 1 / rod.body.mass + over.x() * (over.x() - mu * over.y()) / rod.inertia;
  ASSERT_LT(p, 0);
  World world = thrown();
  constexpr int steps = 10;
  for (int n = 0; n < steps; ++n) world.step();
  const auto& rock = world.rocks()[0];
  const Vector3d arm = rock.pose.linear() * Vector3d(-half.x(), 0, -half.z());
  const Vector3d tip = rock.velocity + rock.angular_velocity.cross(arm);
  const double of_one_step = rod.body.mass * g * over.x() * h / rod.about_tip;
  record(
      sliding_rod,
      {.quantity = "rate after 5 ms",
       .unit = "rad/s",
       .expected = vaulting_rate(rod, steps * h),
       .source = "angular momentum about the tip",
       .measured = -rock.angular_velocity.y(),
       .budget = of_one_step,
       .budget_reason = "Rate: the jam takes a step, within which gravity changes the rate by m g x h/I."});
  record(sliding_rod, {.quantity = "speed of the tip along the floor after 5 ms",
                       .unit = "m/s",
                       .expected = 0,
                       .source = "the tip sticks",
                       .measured = tip.x(),
                       .budget = g * h,
                       .budget_reason = "Tip: one step of gravity, g h."});
}

TEST(SlidingRod, GainsNothingAndComesToRest) {
  World world = thrown();
  const double start = energy(world);
  double gain = 0;
  while (world.time() < 2) {
    world.step();
    gain = std::max(gain, energy(world) / start - 1);
    ASSERT_TRUE(std::isfinite(gain));
  }
  const auto& rock = world.rocks()[0];
  record(sliding_rod, {.quantity = "largest relative gain of energy in 2 s",
                       .expected = 0,
                       .source = "friction and plastic impacts only lose",
                       .measured = gain,
                       .budget = 1e-12,
                       .budget_reason = "Energy: round-off."});
  record(sliding_rod, {.quantity = "height of the centre at the end",
                       .unit = "m",
                       .expected = half.z() - rock.body.mass * g / 1e9,
                       .source = "flat on the floor at the overlap m g/k",
                       .measured = rock.pose.translation().z(),
                       .budget = 1e-9,
                       .budget_reason = "Height: a hundredth of the resting overlap m g/k."});
}
