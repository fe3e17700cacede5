// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/scene.h>
#include <drawpoint/engine/world/step_bodies.h>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/collision/first_touch.hpp>
#include <vector>

/// Which points of the step's manifolds may come to bear, and join its problem.
///
/// What overlaps or is within 1 mm, what would close in at twice its present speed, and what an impact may
/// carry that far (extra_reach.h). The nearest features of now need not be those that meet, and a normal of
/// theirs would stop what passes by. So shapes that are apart and whose own motion closes the gap along the
/// normal are swept: if they meet, the points are those of their first touch; if they pass, the gaps become
/// what their motion closes, and only a push beyond it is stopped. A half-space has one normal. Cost: some
/// 2 µs for a pair that is swept, some ns for another.
namespace drawpoint::engine::detail {

class JoiningPoints {
 public:
  /// For a step of h [s]. The manifolds must outlive the results.
  void find(const std::vector<Manifold>& manifolds, const Scene& scene, const StepBodies& bodies, double h,
            const ThreadPool& pool);

  /// A bit for each point of manifold(k) that joins.
  unsigned points(int k) const { return joins_[static_cast<std::size_t>(k)]; }
  void leave_out(int k, unsigned points) { joins_[static_cast<std::size_t>(k)] &= ~points; }
  const Manifold& manifold(int k) const {
    const FirstTouch* touch = this->touch(k);
    return touch ? touch->manifold : (*manifolds_)[static_cast<std::size_t>(k)];
  }
  /// What the sweep of manifold k's pair gave; nullptr where it was not swept.
  const FirstTouch* touch(int k) const {
    const int place = touch_[static_cast<std::size_t>(k)];
    return place < 0 ? nullptr
                     : &touches_[static_cast<std::size_t>(k / block)][static_cast<std::size_t>(place)];
  }
  /// Deepest overlap of a rock with anything, at the start of the step [m].
  double deepest_overlap() const;

 private:
  static constexpr int block = 64;  // manifolds that a thread takes at a time

  // What a step's bodies do, as the solver moves them.
  struct Step {
    const Scene& scene;
    const StepBodies& bodies;
    double h;
    Eigen::Vector3d acceleration(const Surface& surface, const RigidMotion& motion,
                                 const Eigen::Vector3d& at) const;
  };
  void find_block(const Step& step, int first, int last, int thread);
  unsigned joining(const Step& step, const Manifold& m, double least, int thread,
                   std::vector<FirstTouch>& touches) const;

  const std::vector<Manifold>* manifolds_ = nullptr;
  std::vector<unsigned> joins_;                   // by manifold
  std::vector<int> touch_;                        // by manifold: place among the touches of its block, or -1
  std::vector<std::vector<FirstTouch>> touches_;  // by block of manifolds
  std::vector<double> deepest_;                   // overlap by block of manifolds [m]
};

}  // namespace drawpoint::engine::detail
