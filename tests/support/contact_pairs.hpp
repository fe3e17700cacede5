// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <drawpoint/engine/collision/contact_finder.hpp>
#include <limits>
#include <memory>

/// Small helpers to ask a contact finder about two shapes.
namespace drawpoint::support {

using SharedShape = std::shared_ptr<const engine::Shape>;

template <class T>
SharedShape share(T shape) {
  return std::make_shared<const engine::Shape>(std::move(shape));
}

inline engine::Collider collider_of(SharedShape shape, int body, bool moves = true) {
  engine::Collider collider;
  collider.shape = std::move(shape);
  collider.body = body;
  collider.moves = moves;
  return collider;
}

inline Eigen::Isometry3d pose_at(const Eigen::Vector3d& position,
                                 const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = turn.toRotationMatrix();
  X.translation() = position;
  return X;
}

struct Placed {
  SharedShape shape;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

/// The manifolds of two shapes with nothing remembered: none or one.
inline std::vector<engine::Manifold> contact_of(const Placed& a, const Placed& b,
                                                const engine::ContactFinderOptions& options = {}) {
  engine::ContactFinder finder(options);
  finder.set_pose(finder.add(collider_of(a.shape, 0)), a.pose);
  finder.set_pose(finder.add(collider_of(b.shape, 1)), b.pose);
  return finder.find();
}

inline double least_gap(const engine::Manifold& manifold) {
  double gap = std::numeric_limits<double>::infinity();
  for (int k = 0; k < manifold.count; ++k) gap = std::min(gap, manifold.points[k].gap);
  return gap;
}

}  // namespace drawpoint::support
