// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/collision/fcl_axis.h>
#include <drawpoint/engine/collision/finder_items.h>
#include <drawpoint/engine/collision/pair_cache.h>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/collision/collider.hpp>
#include <drawpoint/engine/collision/contact_finder_options.hpp>
#include <drawpoint/engine/collision/manifold.hpp>
#include <memory>
#include <vector>

/// From pairs to manifolds: decides for each pair whether what is remembered still holds, computes what does
/// not, and carries contacts along to the present poses.
///
/// A pair is asked at three levels, each only when the one before does not settle it: have both shapes
/// motion_bound too little to matter (two numbers); for shapes apart, does last time's separating plane still
/// separate (one support point), and for shapes in contact, do they stand against each other as before (two
/// poses); the full search. Pairs are worked on in blocks of fixed size by as many threads as asked for; each
/// pair is on its own, so the result depends neither on blocks nor on threads. Cost: see
/// contact_finder.hpp.
namespace drawpoint::engine::detail {

class NarrowPhase {
 public:
  /// `fcl` knows the colliders, if the options ask for FCL.
  NarrowPhase(const ContactFinderOptions& options, int threads, const FclAxes& fcl);
  ~NarrowPhase();

  /// Updates the pairs and replaces `manifolds` by their contacts, in the order of the pairs. Returns how
  /// many pairs were computed.
  int run(const Items& items, PairCache& pairs, std::vector<Manifold>& manifolds, const ThreadPool& pool);
  /// How many answers of FCL were not used in the last run().
  int refused() const;

 private:
  struct Worker;
  void run_alone(const Items& items, PairCache& pairs, std::vector<Manifold>& manifolds);
  void run_in_blocks(const Items& items, PairCache& pairs, std::vector<Manifold>& manifolds,
                     const ThreadPool& pool);

  std::vector<std::unique_ptr<Worker>> workers_;  // one per thread
  std::vector<std::vector<Manifold>> found_;      // by block
  std::vector<std::size_t> starts_;               // first manifold of each block
};

}  // namespace drawpoint::engine::detail
