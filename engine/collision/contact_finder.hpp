// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/collision/collider.hpp>
#include <drawpoint/engine/collision/contact_finder_options.hpp>
#include <drawpoint/engine/collision/first_touch.hpp>
#include <drawpoint/engine/collision/manifold.hpp>
#include <drawpoint/engine/collision/rigid_motion.hpp>
#include <memory>
#include <span>
#include <vector>

/// Finds all contacts of a scene, step after step.
///
/// Broad phase: FCL's dynamic box trees over boxes with some slack; only colliders that have left their box
/// are looked up again. Narrow phase of two polyhedra: the axis of least overlap (all face normals and the
/// edge pairs that can matter, exact), the facing polygons clipped to a manifold. Shapes apart by less than
/// `margin` give points with positive gaps; the least of them is no less than the separation along the
/// normal, but may exceed the distance of two shapes that do not face each other squarely. On request FCL's
/// narrow phase gives the axis (ContactFinderOptions::narrow): it is checked, and several times slower
/// (docs/decisions/0007). Half-spaces have closed forms. A cylinder's round side meets polyhedra exactly
/// (round_contact.h); its flat ends, and another cylinder, as an inscribed 48-sided prism, of which at most
/// R(1 − cos(π/48)) = 0.0021 R is missing.
///
/// Pairs that have hardly moved against each other reuse their manifold, carried along rigidly. A point's gap
/// then changes with the motion, |Δgap| ≤ m, and so does the true overlap: the deepest reported gap is off by
/// at most 2m, m = reuse_distance + reuse_angle · (radius of the smaller shape). Two colliders that do not
/// move are no pair and cost nothing.
///
/// Same calls, same bits, on any number of threads and any x86-64 machine. save() and restore() carry over
/// all that later results depend on. Not for concurrent use. World frame, SI units. Cost in a pile of rocks:
/// about 0.02 µs per pair at rest and 1 µs per pair computed (benchmarks/micro/collision, find_in_pile).
namespace drawpoint::engine {

class ThreadPool;

/// Times and counts of the last find().
struct FinderTimes {
  double broad = 0, narrow = 0;  ///< [s]
  int pairs = 0;                 ///< pairs with overlapping boxes
  int computed = 0;              ///< of these, not answered from the cache
  int refused = 0;  ///< of the computed, answers of FCL that were wrong; 0 with NarrowMethod::separating_axes
};

class ContactFinder {
 public:
  /// On the threads of `pool`, which it may share with a solver, one of them at a time; without one, on the
  /// caller's.
  explicit ContactFinder(const ContactFinderOptions& options = {},
                         std::shared_ptr<const ThreadPool> pool = nullptr);
  ~ContactFinder();
  ContactFinder(ContactFinder&&) noexcept;
  ContactFinder& operator=(ContactFinder&&) noexcept;

  /// Returns the number of the collider: 0, 1, 2, ... in the order of the calls, never used again after
  /// remove(). Its body stands at X_WB. Throws std::invalid_argument for a missing or impossible shape, and as
  /// set_pose() does.
  int add(const Collider& collider, const Eigen::Isometry3d& X_WB = Eigen::Isometry3d::Identity());
  void remove(int collider);
  const Collider& collider(int collider) const;

  /// Throws std::invalid_argument for a pose that is not finite or whose axes are not orthonormal within
  /// 1e-6.
  void set_pose(int collider, const Eigen::Isometry3d& X_WB);
  /// X_WS of the collider's shape.
  Eigen::Isometry3d shape_pose(int collider) const;
  /// How much farther than the margin the collider looks [m], ≥ 0 and 0 until set: a pair is searched as far
  /// as the margin and both speculative margins. For what moves fast: the way that it may go in the coming step.
  void set_speculative_margin(int collider, double distance);
  /// Both for many colliders, on all threads; each collider at most once. Throws as those
  /// do, and then has moved nothing.
  void move(std::span<const ColliderMove> moves);

  /// All manifolds with at least one point, ordered by (collider_a, collider_b). They stay as they are until
  /// the next find(), whatever is added, moved or removed before; the end of the finder, or another one moved
  /// into its place, ends them.
  const std::vector<Manifold>& find();
  const FinderTimes& times() const;

  /// Finds where two shapes touch first within a time h > 0 [s] as their bodies move; returns false when they
  /// do not. The manifold is one of the last find(), of polyhedra or cylinders that are apart. Several threads
  /// may call it at once, each with its own number, 0 .. threads-1 of the pool.
  bool first_touch(const Manifold& manifold, const RigidMotion& a, const RigidMotion& b, double h, int thread,
                   FirstTouch& touch) const;
  /// Returns whether a point of such a manifold meets the face that gave its normal, when b moves against a by
  /// `shift` [m] there and both turn. The manifold is then that of the first touch, at less cost.
  bool meets_face(const Manifold& manifold, const RigidMotion& a, const RigidMotion& b, double h, int point,
                  const Eigen::Vector3d& shift) const;
  /// Whether one of its shapes is a half-space, whose normal is the same wherever the other goes.
  bool with_half_space(const Manifold& manifold) const;

  /// Each contact has a slot of its own as long as it lasts, below slots(), which its manifolds name; -1 for a pair
  /// without a contact or with a removed collider. restore() gives slots anew.
  int slots() const;
  int slot_of(int collider_a, int collider_b) const;

  /// Drops everything remembered between calls (manifolds, axes, boxes).
  void forget();

  /// The state as bytes: poses, boxes, motion bounds, pairs and their contacts, in this machine's
  /// number format. A finder with the same options and colliders that restores it goes on with the same bits.
  std::vector<std::byte> save() const;
  /// Takes over a state. Throws std::runtime_error, and leaves the finder as it was, when the bytes are not
  /// the state of a finder with these options and colliders: what is wrong, where, and what was expected.
  void restore(std::span<const std::byte> bytes);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace drawpoint::engine
