// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/scene.h>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <vector>

/// The bodies of a step's problem: the world, then the rocks, and what pairs ask of them, kept in a few
/// lines of memory.
namespace drawpoint::engine::detail {

class StepBodies {
 public:
  StepBodies(const WorldOptions& options, const Scene& scene) : options_(options), scene_(scene) {}

  /// Writes the bodies of problem.
  void fill(const ThreadPool& pool, ContactProblem& problem);

  /// Returns where the surface's body stands in the problem.
  int index(const Surface& surface) const {
    if (surface.owner == Owner::part) return machine_part(surface.index);
    return surface.owner == Owner::rock ? body_of_rock_[static_cast<std::size_t>(surface.index)] : world;
  }
  RigidMotion motion(const Surface& surface) const {
    const int body = index(surface);
    return body >= 0 ? motions_[static_cast<std::size_t>(body)] : scene_.motion_of(surface);
  }
  Eigen::Vector3d origin(const Surface& surface) const {
    const int body = index(surface);
    return body > world ? motions_[static_cast<std::size_t>(body)].origin : scene_.origin_of(surface);
  }

 private:
  static constexpr int world = 0;  // never moves

  const WorldOptions& options_;
  const Scene& scene_;
  std::vector<int> body_of_rock_;
  std::vector<RigidMotion> motions_;  // by body of the problem
};

}  // namespace drawpoint::engine::detail
