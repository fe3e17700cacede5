// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/engine/base/checks.hpp>
#include <drawpoint/engine/machine/machine_spec.hpp>
#include <stdexcept>

namespace drawpoint::engine::machine {
namespace {

constexpr const char* place = "machine::MachineSpec: ";

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(place + what); }

void check_finite(const std::string& name, const Eigen::Vector3d& point) {
  if (!point.allFinite()) refuse(name + " is " + engine::detail::text(point) + " m; give finite numbers");
}

void check_body(const BodySpec& body, int index) {
  const std::string name = "body \"" + body.name + "\": ";
  if (body.parent >= index)
    refuse(name + "its parent must stand before it; list bodies from the root outward");
  if (!(body.mass > 0)) refuse(name + "mass is " + std::to_string(body.mass) + " kg; give a positive mass");
  if (!std::isfinite(body.mass)) refuse(name + "mass is infinite; give a finite mass");
  check_finite(name + "the centre of mass", body.centre);
  check_finite(name + "the joint point", body.joint_point);
  const Eigen::Vector3d I = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(body.inertia).eigenvalues();
  if (!(I[0] > 0) || I[0] + I[1] < I[2] * (1 - 1e-9))
    refuse(name +
           "no rigid body has this inertia; the principal moments must be positive and obey the triangle "
           "inequality");
  if (body.joint != JointKind::free && !detail::is_unit(body.joint_axis))
    refuse(name + "the joint axis has length " + std::to_string(body.joint_axis.norm()) +
           "; give a unit vector");
}

void check_body_of(const MachineSpec& spec, int body, const std::string& who) {
  if (body < 0 || body >= static_cast<int>(spec.bodies.size()))
    throw std::invalid_argument(who + ": there is no body " + std::to_string(body) + "; allowed: 0 to " +
                                std::to_string(static_cast<int>(spec.bodies.size()) - 1));
}

void check_loop(const MachineSpec& spec, const LoopPinSpec& loop) {
  const std::string name = "loop \"" + loop.name + "\"";
  for (const int body : {loop.line_body, loop.point_body}) check_body_of(spec, body, place + name);
  if (loop.line_body == loop.point_body)
    refuse(name + ": it pins \"" + spec.bodies[loop.line_body].name + "\" to itself; name two bodies");
  check_finite(name + ": the point", loop.point);
  if (!detail::is_unit(loop.axis))
    refuse(name + ": the axis has length " + detail::text(loop.axis.norm()) + "; give a unit vector");
}

}  // namespace

void check_joint(const MachineSpec& spec, int body, const std::string& who) {
  check_body_of(spec, body, who);
  if (spec.bodies[body].joint == JointKind::free)
    throw std::invalid_argument(who + ": the joint of \"" + spec.bodies[body].name +
                                "\" is free and has no single coordinate; name a hinge or a slider");
}

void check(const MachineSpec& spec) {
  if (spec.bodies.empty()) refuse("no bodies; list at least one");
  for (std::size_t i = 0; i < spec.bodies.size(); ++i) check_body(spec.bodies[i], static_cast<int>(i));
  for (const LoopPinSpec& loop : spec.loops) check_loop(spec, loop);
  for (const auto& motor : spec.motors) {
    if (motor.bodies.empty())
      refuse("motor \"" + motor.name + "\": it drives no joint; name at least one body");
    for (int body : motor.bodies) check_joint(spec, body, place + ("motor \"" + motor.name + "\""));
    if (!(motor.max_force >= 0 && motor.max_reverse_force >= 0))
      refuse("motor \"" + motor.name + "\": the force limit must not be negative");
  }
  for (const auto& stop : spec.stops) {
    if (stop.bodies.empty()) refuse("stop \"" + stop.name + "\": it stops no joint; name at least one body");
    for (int body : stop.bodies) check_joint(spec, body, place + ("stop \"" + stop.name + "\""));
    if (!(stop.lower < stop.upper))
      refuse("stop \"" + stop.name + "\": the lower limit is not below the upper one");
  }
}

}  // namespace drawpoint::engine::machine
