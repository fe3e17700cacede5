// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/inner_edges.h>
#include <drawpoint/engine/world/joining_points.h>
#include <drawpoint/engine/world/pair_memory.h>
#include <drawpoint/engine/world/scene.h>
#include <drawpoint/engine/world/step_bodies.h>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <memory>
#include <vector>

/// From manifolds to the contact problem of a step, and from its impulses to what the next step starts from.
///
/// Points that may come to bear within the step join the problem (joining_points.h), but for those on edges between
/// surfaces that go on into each other (inner_edges.h). Owns the problem and the memory of pairs.
namespace drawpoint::engine::detail {

class ContactAssembly {
 public:
  /// The scene must outlive it.
  ContactAssembly(const WorldOptions& options, const Scene& scene, std::shared_ptr<const ThreadPool> pool);

  /// For a step of h [s] after one of `last` [s], 0 before the first.
  void begin_step(double h, double last);
  /// Makes problem() but for its machine: bodies are the world, then the rocks.
  void fill(const std::vector<Manifold>& manifolds);
  /// Takes over the impulses of the solved problem.
  void keep_impulses();
  /// What a machine that contacts do not move feels in the solved problem.
  SuperBodySolution felt_by_prescribed() const;
  /// Deepest overlap of a rock with anything, at the start of the step [m].
  double deepest_overlap() const { return joining_.deepest_overlap(); }

  ContactProblem& problem() { return problem_; }
  const ContactProblem& problem() const { return problem_; }
  PairMemory& memory() { return memory_; }
  const PairMemory& memory() const { return memory_; }

 private:
  // Where the next pair, point and such body go in the problem; at first, how many a block of manifolds has.
  struct ContactPlace {
    int pair = 0, point = 0, prescribed = 0;  // the last: bodies of a machine that contacts do not move
  };

  void fill_contacts(int count);            // of so many manifolds
  void count_joining(int first, int last);  // of these manifolds, one block
  void fill_pairs(int first, int last);
  void fill_pair(int manifold, ContactPlace place);
  bool has_prescribed(const Manifold& m) const;  // as a side
  void fill_prescribed(const ContactPair& pair, int body);

  const WorldOptions& options_;
  const Scene& scene_;
  std::shared_ptr<const ThreadPool> pool_;
  double start_share_ = 1;  // of the remembered impulses, to start from
  StepBodies bodies_;
  JoiningPoints joining_;
  InnerEdges inner_edges_;
  std::vector<ContactPlace> places_;  // by block of manifolds
  ContactProblem problem_;
  std::vector<int> slots_;    // by pair of the problem
  int first_prescribed_ = 0;  // body of the problem
  PairMemory memory_;
};

}  // namespace drawpoint::engine::detail
