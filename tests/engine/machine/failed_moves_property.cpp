// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What a machine refuses leaves it as it was, number by number, and free to move afterwards.
#include <gtest/gtest.h>

#include <drawpoint/tests/support/machine_steps.hpp>
#include <drawpoint/tests/support/machines.hpp>
#include <drawpoint/tests/support/told.hpp>
#include <functional>
#include <limits>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::machine::Machine;
using engine::machine::MachineSpec;
using support::expect_told;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Vector3d gravity(0, 0, -9.81);

// Crank and coupler of 1 m, a rocker of √3.25 = 1.80 m whose ground hinge is 2.5 m from the crank's. The
// crank stands upright; its end must stay within 2.80 m of the rocker's hinge, so it cannot turn away from it
// (positive) by more than asin((2.80² - 7.25)/5) = 0.12 rad.
MachineSpec rocker() {
  MachineSpec spec;
  const Vector3d pin(1, 0, 1), hinge(2.5, 0, 0);
  spec.bodies = {support::rod("crank", -1, {0, 0, 0}, {0, 0, 1}, 1.0),
                 support::rod("coupler", 0, {0, 0, 1}, pin, 1.0),
                 support::rod("rocker", -1, hinge, pin, 1.0)};
  spec.loops = {{"pin", 1, 2, pin, Vector3d::UnitY()}};
  spec.motors = {{"drive", {0}, 100.0}};
  return spec;
}

}  // namespace

// Speeds that carry the joints farther in a step than the loops' projection may take back, and ones beyond the
// machine's limit of 1e5. All that state() holds counts: set speeds, motor forces, row starts, added forces, joint
// forces.
TEST(Machine, IsAsBeforeWhenItsStepFails) {
  int failed = 0;
  for (double rate = 10; rate < 3e5; rate *= 1.1) {
    Machine machine(rocker());
    machine.set_motor(0, 0.3);
    support::step_alone(machine, 1e-3, gravity);
    machine.add_force(2, {Vector3d(1, 2, 3), Vector3d(4, 5, 6)});
    const std::vector<double> before = machine.state();
    auto solution = support::free_solution(machine.linearise(1e-2, gravity));
    solution.velocity *= rate;
    solution.mean_velocity = Eigen::VectorXd::Constant(solution.velocity.size(), rate);
    solution.row_impulses[0] = solution.row_starts[0] = 7;
    try {
      machine.advance(solution);
    } catch (const std::runtime_error&) {
      ++failed;
      EXPECT_EQ(machine.state(), before) << "rate " << rate;
    }
  }
  EXPECT_GT(failed, 0) << "no step failed: the test shows nothing";
}

// The crank cannot reach 1 rad. Afterwards it must follow the rocker again.
TEST(Machine, IsAsBeforeAndFreeWhenACoordinateIsOutOfReach) {
  Machine machine(rocker()), untouched(rocker());
  const std::vector<double> before = machine.state();
  EXPECT_THROW(machine.set_coordinate(0, 1.0), std::runtime_error);
  EXPECT_EQ(machine.state(), before);
  for (Machine* m : {&machine, &untouched}) m->set_coordinate(2, 0.05);
  EXPECT_EQ(machine.state(), untouched.state());
  EXPECT_LT(machine.loop_error(), 1e-9);
}

TEST(Machine, RefusesCoordinatesThatCannotBe) {
  Machine machine(rocker());
  const std::vector<double> before = machine.state();
  for (double value : {nan, std::numeric_limits<double>::infinity(), 1e9})
    expect_told([&] { machine.set_coordinate(0, value); }, {"set_coordinate", "crank", "-10000 to 10000"});
  for (int body : {-1, 3})
    expect_told([&] { machine.set_coordinate(body, 0.1); }, {"there is no body", "0 to 2"});
  EXPECT_EQ(machine.state(), before);
}

TEST(MachineSpec, RefusesLoopsThatCannotBe) {
  const auto refused = [](const std::function<void(MachineSpec&)>& spoil,
                          const std::vector<std::string>& words) {
    MachineSpec spec = rocker();
    spoil(spec);
    expect_told([&] { check(spec); }, words);
  };
  refused([](MachineSpec& s) { s.loops[0].line_body = -1; }, {"loop \"pin\"", "no body -1", "0 to 2"});
  refused([](MachineSpec& s) { s.loops[0].point_body = 3; }, {"loop \"pin\"", "no body 3", "0 to 2"});
  refused([](MachineSpec& s) { s.loops[0].point_body = 1; }, {"loop \"pin\"", "\"coupler\"", "itself"});
  refused([](MachineSpec& s) { s.loops[0].point.x() = nan; }, {"loop \"pin\"", "point", "finite"});
  refused([](MachineSpec& s) { s.loops[0].axis *= 2; }, {"loop \"pin\"", "axis has length 2", "unit vector"});
  refused([](MachineSpec& s) { s.loops[0].axis.z() = nan; }, {"loop \"pin\"", "axis", "unit vector"});
}

TEST(MachineSpec, RefusesBodiesThatAreNotFinite) {
  const auto refused = [](const std::function<void(MachineSpec&)>& spoil, const std::string& word) {
    MachineSpec spec = rocker();
    spoil(spec);
    expect_told([&] { check(spec); }, {"body \"coupler\"", word, "finite"});
  };
  refused([](MachineSpec& s) { s.bodies[1].centre.y() = nan; }, "centre of mass");
  refused([](MachineSpec& s) { s.bodies[1].joint_point.y() = nan; }, "joint point");
  refused([](MachineSpec& s) { s.bodies[1].mass = std::numeric_limits<double>::infinity(); }, "mass");
}

// A machine that is put elsewhere in motion: every point moves by the vector, the base goes at its velocity without
// turning, the joint at its speed; what makes no sense changes nothing.
TEST(Machine, IsPutElsewhereAndInMotion) {
  MachineSpec spec = rocker();
  engine::machine::BodySpec base;
  base.name = "base";
  base.mass = 5;
  base.inertia = Eigen::Matrix3d::Identity();
  base.centre = {0, 0, -1};
  spec.bodies.insert(spec.bodies.begin(), base);
  for (std::size_t k = 1; k < spec.bodies.size(); ++k) ++spec.bodies[k].parent;
  spec.bodies[3].parent = 0;
  spec.loops[0].point_body = 2;
  spec.loops[0].line_body = 3;
  spec.motors[0].bodies = {1};
  Machine machine(spec);
  const Vector3d by(3, -2, 0.5), velocity(1.5, 0, 0), tip(1, 0, 1), before = machine.point(2, tip);
  machine.translate(by);
  EXPECT_LT((machine.point(2, tip) - before - by).norm(), 1e-12);
  machine.set_velocity(velocity, {});
  EXPECT_LT((machine.point_velocity(0, {0, 4, 0}) - velocity).norm(), 1e-12);
  EXPECT_LT((machine.point_velocity(2, tip) - velocity).norm(), 1e-12);
  machine.set_velocity(velocity, {{1, 0.4}});
  EXPECT_DOUBLE_EQ(machine.speed(1), 0.4);
  const std::vector<double> state = machine.state();
  EXPECT_THROW(machine.translate({nan, 0, 0}), std::invalid_argument);
  EXPECT_THROW(machine.set_velocity({2e3, 0, 0}, {}), std::invalid_argument);
  EXPECT_THROW(machine.set_velocity(velocity, {{0, 1}}), std::invalid_argument);
  EXPECT_EQ(machine.state(), state);
}
