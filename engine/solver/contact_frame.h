// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_law_scalar.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <drawpoint/engine/solver/contact_problem.hpp>

/// The frame (n, t1, t2) of a contact, a function of the normal alone, and what a solve starts from in it.
namespace drawpoint::engine {

/// Rows n, t1, t2: right-handed, orthonormal.
inline Eigen::Matrix3d contact_frame(const Eigen::Vector3d& n) {
  assert(std::abs(n.squaredNorm() - 1) < 1e-6 && "the normal has length 1");
  const Eigen::Vector3d helper = std::abs(n.z()) < 0.7 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d t1 = helper.cross(n).normalized();
  Eigen::Matrix3d frame;
  frame << n.transpose(), t1.transpose(), n.cross(t1).transpose();
  return frame;
}

/// A point's start impulse of one of S substeps in its frame, made admissible for the pair's friction.
inline Eigen::Vector3d start_impulse(const ContactPoint& point, const Eigen::Matrix3d& frame, double friction,
                                     int substeps) {
  Eigen::Vector3d impulse = frame * point.start / substeps;
  impulse[0] = std::max(0.0, impulse[0]);
  impulse.tail<2>() *= detail::law::disc_factor(impulse.tail<2>().squaredNorm(), friction * impulse[0]);
  return impulse;
}

}  // namespace drawpoint::engine
