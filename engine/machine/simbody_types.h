// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Simbody.h>

#include <drawpoint/engine/machine/machine.hpp>

/// Vectors, matrices, poses, wrenches and mass properties, from Eigen to Simbody and back.
///
/// Copies, number by number; view() alone looks at Simbody's own numbers and lasts as long as they do.
/// Spatial vectors are (moment; force) on both sides. Internal: part of the .cpp files of this folder, which
/// are compiled as Simbody needs it (CMakeLists.txt), C++17.
namespace drawpoint::engine::machine {

using BodyForces = SimTK::Vector_<SimTK::SpatialVec>;  ///< one per mobilised body of Simbody, ground first

inline SimTK::Vec3 to_simbody(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline SimTK::SpatialVec to_simbody(const Wrench& w) { return {to_simbody(w.moment), to_simbody(w.force)}; }
inline SimTK::Vector to_simbody(const Eigen::VectorXd& v) {
  return SimTK::Vector(static_cast<int>(v.size()), v.data());
}
inline SimTK::Transform to_simbody(const Eigen::Isometry3d& X) {
  SimTK::Mat33 R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R(i, j) = X.linear()(i, j);
  return {SimTK::Rotation(R), to_simbody(Eigen::Vector3d(X.translation()))};
}
inline SimTK::MassProperties mass_properties(const BodySpec& body) {
  const Eigen::Matrix3d& I = body.inertia;
  return {body.mass, SimTK::Vec3(0), SimTK::Inertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2))};
}

inline Eigen::Vector3d to_eigen(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }
inline Eigen::Map<const Eigen::VectorXd> view(const SimTK::Vector& v) {
  return {v.size() ? &v[0] : nullptr, v.size()};
}
inline Eigen::MatrixXd to_eigen(const SimTK::Matrix& m) {
  Eigen::MatrixXd out(m.nrow(), m.ncol());
  for (int j = 0; j < m.ncol(); ++j)
    for (int i = 0; i < m.nrow(); ++i) out(i, j) = m(i, j);
  return out;
}
inline Eigen::Matrix3d to_eigen(const SimTK::Rotation& R) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out(i, j) = R[i][j];
  return out;
}
inline Eigen::Isometry3d to_eigen(const SimTK::Transform& X) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = to_eigen(X.R());
  out.translation() = to_eigen(X.p());
  return out;
}

}  // namespace drawpoint::engine::machine
