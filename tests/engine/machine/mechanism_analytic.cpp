// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/tests/support/machine_steps.hpp>
#include <drawpoint/tests/support/machines.hpp>
#include <functional>

using namespace drawpoint;
using engine::machine::Machine;

namespace {

const Eigen::Vector3d gravity(0, 0, -9.81);

// Steps a machine on its own: no contacts, no limits reached, so the free velocity is the solution and motor
// rows idle.
void step_alone(Machine& machine, double h) { support::step_alone(machine, h, gravity); }

// Time until the coordinate has crossed zero downwards `crossings` times, interpolated within the step.
double time_of_crossing(Machine& machine, double h, const std::function<double()>& signal, int crossings) {
  double before = signal();
  for (int k = 1; k < 1000000; ++k) {
    step_alone(machine, h);
    const double now = signal();
    if (before > 0 && now <= 0 && --crossings == 0) return h * (k - 1 + before / (before - now));
    before = now;
  }
  return NAN;
}

}  // namespace

// Released at rest from horizontal (90 deg from the lowest point) a simple pendulum has the period
// 4 K(sin 45 deg) sqrt(L/g), K(1/√2) = 1.8540746773013719. Semi-implicit Euler keeps a perturbed energy; its
// period error is O(h²ω²/24) plus O(h) of the phase, cancelled by measuring from crossing to crossing. The
// interpolation of the crossing costs at most h²·a/(8·v) ~ 1e-7 s. With h = 1 ms and ω ≈ 3.1: (3.1e-3)²/24 =
// 4e-7 relative; 1e-5 leaves a factor 25.
TEST(Pendulum, HasTheExactPeriodAtLargeAmplitude) {
  const double L = 1, period = 4 * 1.8540746773013719 * std::sqrt(L / 9.81);
  Machine machine(support::simple_pendulum(L, 1));
  const auto height = [&] {
    return machine.coordinate(0) + M_PI / 2;
  };  // zero at the lowest point, positive at the start
  const double first = time_of_crossing(machine, 1e-3, height, 1);
  Machine again(support::simple_pendulum(L, 1));
  const auto height_again = [&] { return again.coordinate(0) + M_PI / 2; };
  const double fifth = time_of_crossing(again, 1e-3, height_again, 5);
  EXPECT_NEAR((fifth - first) / 4, period, 1e-5 * period);
}

// At the lowest point the hinge carries m (g + v²/L) = 3 m g after a release from horizontal; a step's mean
// is off by O(h).
TEST(Pendulum, HingeForceAtTheLowestPointIsThreeTimesTheWeight) {
  Machine machine(support::simple_pendulum(1, 2));
  const double h = 1e-4;
  while (machine.coordinate(0) > -M_PI / 2) step_alone(machine, h);
  const Eigen::Vector3d force = machine.pose(0).linear() * machine.joint_wrench(0).force;
  // Error budget: speed error O(h g / v) = 2e-4 relative, direction O(h v / L) = 5e-4.
  EXPECT_NEAR(force.z(), 3 * 2 * 9.81, 3 * 2 * 9.81 * 2e-3);
  EXPECT_NEAR(force.x(), 0, 3 * 2 * 9.81 * 2e-3);
  EXPECT_NEAR(machine.joint_wrench(0).moment.norm(), 0,
              1e-4);  // the bob's own inertia: 0.4e-6·2·g/L ~ 8e-6 N m
}

// The parallelogram's coupler translates, so hanging at angle θ it obeys I θ̈ = -2 g sin θ with two rods of
// 1/3 kg m² about the ground and a coupler of m L² = 1: a pendulum of length (5/3)/2 = 5/6 m. From rest at 1
// rad its period is 4 K(sin 0.5) sqrt(5/(6 g)). Budget as for the simple pendulum.
TEST(FourBar, ClosedLoopSwingsLikeItsEquivalentPendulum) {
  const auto four_bar = support::parallelogram_four_bar(-1);
  Machine machine(four_bar), again(four_bar);
  machine.set_coordinate(0, 1.0);
  again.set_coordinate(0, 1.0);
  ASSERT_NEAR(machine.coordinate(0), 1.0, 1e-9);
  double worst_loop = machine.loop_error();
  const double first = time_of_crossing(
      machine, 1e-3, [&] { return machine.coordinate(0); }, 1);
  const double fourth = time_of_crossing(
      again, 1e-3,
      [&] {
        worst_loop = std::max(worst_loop, again.loop_error());
        return again.coordinate(0);
      },
      4);
  const double period = 4 * std::comp_ellint_1(std::sin(0.5)) * std::sqrt(5.0 / 6.0 / 9.81);
  EXPECT_NEAR((fourth - first) / 3, period, 1e-5 * period);
  EXPECT_LT(worst_loop, 1e-9);
}

// Statics of the same four-bar, tilted by 30 deg toward +x and held by a pure moment on the crank of 2 g sin
// 30 deg. The coupler pivots about the crank, so the pin carries half its weight: P_z = -g/2 on the rocker.
// The rocker's own moment balance, g/4 + P_x cos 30 - P_z sin 30 = 0, gives P_x = -g/(2 cos 30). The step
// solves a linear system: round-off only.
TEST(FourBar, LoopPinAndGroundHingesCarryTheStaticLoad) {
  Machine machine(support::parallelogram_four_bar(+1));
  machine.set_coordinate(0, -M_PI / 6);
  const double h = 1e-3, g = 9.81;
  const auto& super = machine.linearise(h, gravity);
  ASSERT_EQ(super.velocity.size(), 1);
  engine::SuperBodySolution solution;
  solution.velocity = solution.mean_velocity = Eigen::VectorXd::Zero(1);  // at rest, held by the moment below
  solution.part_impulses.assign(3, engine::SpatialVector::Zero());
  solution.part_impulses[0].head<3>() = Eigen::Vector3d(0, -2 * g * std::sin(M_PI / 6) * h, 0);
  machine.advance(solution);
  const double tolerance = 1e-8 * g;
  EXPECT_NEAR(machine.loop_force(0).z(), -g / 2, tolerance);
  EXPECT_NEAR(machine.loop_force(0).x(), -g / (2 * std::cos(M_PI / 6)), tolerance);
  const Eigen::Vector3d crank = machine.pose(0).linear() * machine.joint_wrench(0).force;
  const Eigen::Vector3d rocker = machine.pose(2).linear() * machine.joint_wrench(2).force;
  EXPECT_NEAR(crank.z() + rocker.z(), 3 * g, tolerance);
  EXPECT_NEAR(crank.x() + rocker.x(), 0, tolerance);
}

TEST(MachineSpec, RefusesABodyWithoutMass) {
  auto spec = support::simple_pendulum(1, 1);
  spec.bodies[0].mass = 0;
  try {
    Machine machine(spec);
    FAIL() << "a body without mass was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "machine::MachineSpec: body \"bob\": mass is 0.000000 kg; give a positive mass");
  }
}

// What a motor may give in a step of h: its force times h, against the joint's direction its own limit, and
// less where it is limited from outside.
TEST(Motor, HasALimitForEachDirection) {
  auto spec = support::simple_pendulum(1, 1);
  spec.motors = {{.name = "swing", .bodies = {0}, .max_force = 100, .max_reverse_force = 60}};
  Machine machine(spec);
  constexpr double h = 1e-2;
  const auto expect_limits = [&](double reverse, double forward) {
    const auto& row = machine.linearise(h, gravity).rows.front();
    EXPECT_DOUBLE_EQ(row.lower, -h * reverse);
    EXPECT_DOUBLE_EQ(row.upper, h * forward);
  };
  expect_limits(60, 100);
  machine.limit_motor(0, 80);
  expect_limits(60, 80);
  machine.limit_motor(0, 50);
  expect_limits(50, 50);
  EXPECT_THROW(machine.limit_motor(0, 101), std::invalid_argument);
  spec.motors.front().max_reverse_force = -1;
  EXPECT_THROW(Machine{spec}, std::invalid_argument);
  EXPECT_EQ(engine::machine::MotorSpec({.name = "both ways", .max_force = 7}).max_reverse_force, 7);
}
