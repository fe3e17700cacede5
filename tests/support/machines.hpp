// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/machine/machine.hpp>

/// Small mechanisms with known answers, shared by tests and benchmarks. All move in the x-z plane about axes
/// along y.
namespace drawpoint::support {

inline Eigen::Matrix3d rod_inertia(double mass, double length, const Eigen::Vector3d& direction) {
  // A thin rod; 1e-6 of the transverse moment about its own axis keeps the inertia positive definite.
  const double I = mass * length * length / 12;
  const Eigen::Vector3d d = direction.normalized();
  return I * (Eigen::Matrix3d::Identity() - (1 - 1e-6) * d * d.transpose());
}

/// A thin rod from `from` to `to`, hinged at `from`.
inline engine::machine::BodySpec rod(const std::string& name, int parent, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& to, double mass) {
  engine::machine::BodySpec body;
  body.name = name;
  body.parent = parent;
  body.joint = engine::machine::JointKind::hinge;
  body.joint_point = from;
  body.joint_axis = -Eigen::Vector3d::UnitY();  // positive: nose up
  body.mass = mass;
  body.centre = 0.5 * (from + to);
  body.inertia = rod_inertia(mass, (to - from).norm(), to - from);
  return body;
}

/// A body that slides along x from the origin, where its centre is.
inline engine::machine::BodySpec slider(const std::string& name, double mass, double moment) {
  engine::machine::BodySpec body;
  body.name = name;
  body.joint = engine::machine::JointKind::slider;
  body.joint_axis = Eigen::Vector3d::UnitX();
  body.mass = mass;
  body.inertia = moment * Eigen::Matrix3d::Identity();
  return body;
}

/// A point mass (a 1 mm sphere's inertia) on a massless arm: the simple pendulum, hinged at the origin.
inline engine::machine::MachineSpec simple_pendulum(double length, double mass) {
  engine::machine::BodySpec bob = rod("bob", -1, Eigen::Vector3d::Zero(), {2 * length, 0, 0}, mass);
  bob.inertia = 0.4 * mass * 1e-6 * Eigen::Matrix3d::Identity();
  return {{bob}, {}, {}, {}};
}

/// A parallelogram of three 1 m rods of 1 kg on two ground hinges 1 m apart: crank and rocker hang (direction
/// -1) or stand (+1), the coupler joins their ends. The same as a single pendulum of known inertia, which
/// makes it an exact test of the loop.
inline engine::machine::MachineSpec parallelogram_four_bar(double direction) {
  const Eigen::Vector3d left(0, 0, direction), right(1, 0, direction);
  engine::machine::MachineSpec spec;
  spec.bodies = {rod("crank", -1, {0, 0, 0}, left, 1.0), rod("coupler", 0, left, right, 1.0),
                 rod("rocker", -1, {1, 0, 0}, right, 1.0)};
  spec.loops = {{"coupler-rocker", 1, 2, right, Eigen::Vector3d::UnitY()}};
  return spec;
}

}  // namespace drawpoint::support
