// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/mass_properties.hpp>

#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

namespace drawpoint::engine {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Moments {
  double volume = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();

  void add_tetrahedron(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const double d = a.dot(b.cross(c));
    const Vector3d sum = a + b + c;
    volume += d / 6;
    first += d / 24 * sum;
    second += d / 120 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
};

}  // namespace

MassProperties mass_properties(const ConvexPolyhedron& shape, double density) {
  if (!(density > 0) || !std::isfinite(density))
    throw std::invalid_argument("engine::mass_properties: density " + std::to_string(density) +
                                " kg/m3 is not a positive finite number; rock has 2000 to 5000 kg/m3");
  // The apex near the solid keeps the sums free of cancellation however far the frame's origin is.
  const Vector3d apex = shape.vertices()[0];
  Moments moments;
  for (const auto& face : shape.faces())
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      moments.add_tetrahedron(shape.vertices()[face[0]] - apex, shape.vertices()[face[k]] - apex,
                              shape.vertices()[face[k + 1]] - apex);
  assert(moments.volume > 0 && "faces are counter-clockwise seen from outside");
  const Vector3d centre = moments.first / moments.volume;
  const Matrix3d central = moments.second - moments.volume * centre * centre.transpose();
  const Matrix3d inertia = density * (central.trace() * Matrix3d::Identity() - central);
  return {density * moments.volume, apex + centre, 0.5 * (inertia + inertia.transpose())};
}

Eigen::Isometry3d principal_frame(const MassProperties& properties) {
  Eigen::Isometry3d frame(Eigen::Translation3d(properties.centre));
  const Matrix3d products = properties.inertia - Matrix3d(properties.inertia.diagonal().asDiagonal());
  if (products.cwiseAbs().maxCoeff() <= 1e-9 * properties.inertia.trace()) return frame;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(properties.inertia);
  frame.linear() = eigen.eigenvectors();
  for (int k : {0, 1}) {
    Eigen::Index largest;
    frame.linear().col(k).cwiseAbs().maxCoeff(&largest);
    if (frame.linear()(largest, k) < 0) frame.linear().col(k) *= -1;
  }
  frame.linear().col(2) = frame.linear().col(0).cross(frame.linear().col(1));
  return frame;
}

}  // namespace drawpoint::engine
