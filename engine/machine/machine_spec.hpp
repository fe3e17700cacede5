// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <string>
#include <vector>

/// An articulated machine as plain data: a tree of rigid bodies, the pins that close its loops, motors and
/// stops.
///
/// Everything is given once, in the *machine frame* at the *reference pose*, where every joint coordinate is
/// zero. A body's own frame has its origin at the centre of mass and the axes of the machine frame at the
/// reference pose. Hinge coordinates are angles about `axis` (right hand) [rad], slider coordinates lengths
/// along it [m].
///
/// A loop pin lets a point of one body move only on the pin's axis fixed in the other: two equations, the
/// planar-reduced hinge. In a planar linkage a second full hinge would add three redundant equations whose
/// reactions are indeterminate; leaving them out puts all lateral load on the tree's hinges, as the clearance
/// of real pins and the spherical bearings of real cylinder ends do.
namespace drawpoint::engine::machine {

enum class JointKind { free, hinge, slider };

struct BodySpec {
  std::string name;
  int parent = -1;  ///< index of an earlier body, -1: the ground
  JointKind joint = JointKind::free;
  Eigen::Vector3d joint_point = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d joint_axis = Eigen::Vector3d::UnitY();  ///< unit vector
  double mass = 0;                                        ///< [kg], > 0
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();       ///< centre of mass [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();      ///< about the centre of mass [kg m²]
};

struct LoopPinSpec {
  std::string name;
  int line_body = 0;   ///< carries the pin axis
  int point_body = 0;  ///< carries the point that stays on the axis
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
};

/// Drives the joints of `bodies` to a set mean speed with one bounded force on each: −max_reverse_force ≤ F ≤
/// max_force [N] or [N m], positive along the joint. Several joints are cylinders fed in parallel: the same
/// pressure, so the same force, in all.
struct MotorSpec {
  std::string name;
  std::vector<int> bodies;
  double max_force = 0;
  double max_reverse_force = max_force;
};

/// Keeps the joint coordinates of `bodies` within [lower, upper], [rad] or [m]. Several joints are ones that
/// the linkage moves alike, as two cylinders side by side: their ends share the load, the same force on each.
struct StopSpec {
  std::string name;
  std::vector<int> bodies;
  double lower = 0, upper = 0;
};

struct MachineSpec {
  std::vector<BodySpec> bodies;
  std::vector<LoopPinSpec> loops;
  std::vector<MotorSpec> motors;
  std::vector<StopSpec> stops;
};

/// Throws std::invalid_argument naming the place, the value and what is allowed. Loops need no check of their
/// own that they are closed at the reference pose: their point is one for both bodies.
void check(const MachineSpec& spec);
/// As check(), for a body that is to have one joint coordinate; `who` begins the message.
void check_joint(const MachineSpec& spec, int body, const std::string& who);

}  // namespace drawpoint::engine::machine
