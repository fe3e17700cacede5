// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/tests/support/rock_pairs.hpp>
#include <memory>
#include <random>
#include <vector>

/// A loose heap of rocks over the ground that can be shaken, most of them touching others, and the comparison
/// of two answers bit by bit.
namespace drawpoint::support {

inline Eigen::Isometry3d moved(const Eigen::Isometry3d& X, std::mt19937& rng, double distance, double angle) {
  std::normal_distribution<double> normal;
  Eigen::Isometry3d result = X;
  result.translation() += distance * Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
  const Vector3d axis = Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
  result.linear() = (Eigen::AngleAxisd(angle, axis) * X.linear()).eval();
  return result;
}

class RockHeap {
 public:
  RockHeap(int count, unsigned seed, const engine::ContactFinderOptions& options = {}, int threads = 1)
      : rng_(seed), finder_(options, std::make_shared<const engine::ThreadPool>(threads)) {
    finder_.add(collider_of(share(engine::HalfSpace{Vector3d::UnitZ(), 0}), -1, false));
    for (int k = 0; k < count; ++k) {
      shapes_.push_back(share(rock(k).scaled(k % 2 == 0 ? 0.4 : 0.5)));
      poses_.push_back(pose_at(Vector3d(0.36 * (k % 4), 0.36 * (k / 4 % 4), 0.2 + 0.36 * (k / 16)),
                               random_rotation(rng_)));
      add(k);
    }
  }
  void add(int k) {
    const int id = finder_.add(collider_of(shapes_[k], k));
    finder_.set_pose(id, poses_[k]);
    ids_.push_back(id);
  }
  void shake(double distance, double angle) {
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      if (ids_[k] < 0) continue;
      poses_[k] = moved(poses_[k], rng_, distance, angle);
      finder_.set_pose(ids_[k], poses_[k]);
    }
  }
  /// The rock was removed from the finder.
  void drop(int k) { ids_[k] = -1; }
  /// Goes on from where another heap is; its finder is left alone.
  void follow(const RockHeap& other) { poses_ = other.poses_, rng_ = other.rng_; }
  engine::ContactFinder& finder() { return finder_; }
  const std::vector<SharedShape>& shapes() const { return shapes_; }
  const std::vector<Eigen::Isometry3d>& poses() const { return poses_; }

 private:
  std::mt19937 rng_;
  engine::ContactFinder finder_;
  std::vector<SharedShape> shapes_;
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<int> ids_;
};

inline bool same_bits(const std::vector<engine::Manifold>& x, const std::vector<engine::Manifold>& y) {
  if (x.size() != y.size()) return false;
  for (std::size_t m = 0; m < x.size(); ++m) {
    bool same = x[m].collider_a == y[m].collider_a && x[m].collider_b == y[m].collider_b &&
                x[m].count == y[m].count && x[m].normal == y[m].normal;
    for (int k = 0; same && k < x[m].count; ++k)
      same = x[m].points[k].position == y[m].points[k].position && x[m].points[k].gap == y[m].points[k].gap &&
             x[m].points[k].feature == y[m].points[k].feature;
    if (!same) return false;
  }
  return true;
}

}  // namespace drawpoint::support
