// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/collision_hull.h>
#include <drawpoint/engine/geometry/plane_contact.h>
#include <Eigen/Dense>
#include <drawpoint/engine/collision/collider.hpp>
#include <drawpoint/engine/collision/contact_finder_options.hpp>
#include <drawpoint/engine/collision/manifold.hpp>
#include <map>
#include <memory>
#include <vector>

/// Colliders as the finder keeps them, apart by how often they are read: motion bounds for every pair at
/// every step, placements for every contact, the rest now and then.
namespace drawpoint::engine::detail {

/// Where a collider is and what it looks like; two cache lines.
struct Placement {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();   ///< axes of the shape in the world, as columns
  Eigen::Vector3d p = Eigen::Vector3d::Zero();       ///< origin of the shape in the world
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the hull, in the world
  const CollisionHull* hull = nullptr;               ///< none for a half-space

  Eigen::Vector3d at(const Eigen::Vector3d& local) const { return R * local + p; }
};

/// X_AB of two shapes.
inline Eigen::Isometry3d pose_against(const Placement& a, const Placement& b) {
  Eigen::Isometry3d X_AB;
  X_AB.linear() = a.R.transpose() * b.R;
  X_AB.translation() = a.R.transpose() * (b.p - a.p);
  X_AB.makeAffine();
  return X_AB;
}

struct Traits {
  int body = -1, family = 0;
  bool moves = false, alive = false;
  double inverse_radius = 0;  ///< of the equivalent sphere [1/m]; 0 for a half-space
};

struct Item {
  Collider collider;
  std::shared_ptr<const CollisionHull> hull;
  const Cylinder* cylinder = nullptr;  ///< set for cylinders, beside the hull
  const HalfSpace* plane = nullptr;    ///< set for half-spaces
  double boxed_at = 0;                 ///< motion bound from which the slack of its box counts [m]
  bool dirty = false;                  ///< has left that box
};

struct Items {
  std::vector<Item> item;
  std::vector<Placement> placed;
  std::vector<Traits> traits;
  /// Bound on the way of every point of a shape so far: Σ |Δcentre| + ‖ΔR‖ radius [m].
  std::vector<double> motion_bound;
  std::vector<double> speculative_margin;  ///< beyond the margin [m]

  int size() const { return static_cast<int>(item.size()); }
  void add(Item item, const Eigen::Isometry3d& X_WB);
  void remove(int id);
  void place(int id, const Eigen::Isometry3d& X_WB);
  /// Sets the speculative margin. Its change counts as motion: it brings others nearer, or makes the box too
  /// large, by as much.
  void extend(int id, double to);
  Eigen::AlignedBox3d box(int id) const;  ///< tight, in the world
  Plane plane(int id) const;              ///< in the world
  bool may_touch(int a, int b) const {
    const Traits &ta = traits[a], &tb = traits[b];
    return ta.body != tb.body && (ta.moves || tb.moves) && (ta.family <= 0 || ta.family != tb.family);
  }
};

/// Makes items; colliders with one shape share one hull.
class HullLibrary {
 public:
  /// Throws std::invalid_argument for a missing shape or impossible sizes.
  Item make_item(const Collider& collider);

 private:
  std::shared_ptr<const CollisionHull> hull_of(const Shape& shape);

  std::map<const Shape*, std::weak_ptr<const CollisionHull>> hulls_;
  std::size_t sweep_at_ = 64;  // that many: those that nobody has any more go
};

}  // namespace drawpoint::engine::detail
