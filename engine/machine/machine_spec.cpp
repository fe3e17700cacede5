// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/engine/base/checks.hpp>
#include <drawpoint/engine/machine/machine_spec.hpp>
#include <stdexcept>

namespace drawpoint::engine::machine {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("machine::MachineSpec: " + what);
}

void check_body(const BodySpec& body, int index) {
  const std::string name = "body \"" + body.name + "\": ";
  if (body.parent >= index)
    refuse(name + "its parent must stand before it; list bodies from the root outward");
  if (!(body.mass > 0)) refuse(name + "mass is " + std::to_string(body.mass) + " kg; give a positive mass");
  const Eigen::Vector3d I = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(body.inertia).eigenvalues();
  if (!(I[0] > 0) || I[0] + I[1] < I[2] * (1 - 1e-9))
    refuse(name +
           "no rigid body has this inertia; the principal moments must be positive and obey the triangle "
           "inequality");
  if (body.joint != JointKind::free && !detail::is_unit(body.joint_axis))
    refuse(name + "the joint axis has length " + std::to_string(body.joint_axis.norm()) +
           "; give a unit vector");
}

void check_joint_of(const MachineSpec& spec, int body, const std::string& who) {
  if (body < 0 || body >= static_cast<int>(spec.bodies.size()))
    refuse(who + ": there is no body " + std::to_string(body) + "; allowed: 0 to " +
           std::to_string(static_cast<int>(spec.bodies.size()) - 1));
  if (spec.bodies[body].joint == JointKind::free) refuse(who + ": a free joint has no single coordinate");
}

}  // namespace

void check(const MachineSpec& spec) {
  if (spec.bodies.empty()) refuse("no bodies; list at least one");
  for (std::size_t i = 0; i < spec.bodies.size(); ++i) check_body(spec.bodies[i], static_cast<int>(i));
  for (const auto& motor : spec.motors) {
    if (motor.bodies.empty())
      refuse("motor \"" + motor.name + "\": it drives no joint; name at least one body");
    for (int body : motor.bodies) check_joint_of(spec, body, "motor \"" + motor.name + "\"");
    if (!(motor.max_force >= 0)) refuse("motor \"" + motor.name + "\": the force limit must not be negative");
  }
  for (const auto& stop : spec.stops) {
    if (stop.bodies.empty()) refuse("stop \"" + stop.name + "\": it stops no joint; name at least one body");
    for (int body : stop.bodies) check_joint_of(spec, body, "stop \"" + stop.name + "\"");
    if (!(stop.lower < stop.upper))
      refuse("stop \"" + stop.name + "\": the lower limit is not below the upper one");
  }
}

}  // namespace drawpoint::engine::machine
