// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/collision/broad_phase.h>
#include <drawpoint/engine/collision/finder_items.h>
#include <drawpoint/engine/collision/pair_cache.h>
#include <cstddef>
#include <span>
#include <vector>

/// The state of a contact finder as bytes.
///
/// Saved is all that later results depend on: options, poses, motion bounds and boxes of the colliders, what
/// has left its box, what the broad phase has yet to look up, and for each pair its contact, where the shapes
/// stood and until when that holds. Not saved, because results do not depend on it: the shape of the box
/// trees (the pairs are filtered by the exact boxes and sorted), the slots of the pairs (they are only
/// storage), buffers of the workers (cleared before use), pairs with a removed collider (the next look-up
/// drops them).
///
/// A checksum over all bytes finds flipped ones; counts, indices and numbers are checked one by one all the
/// same. Cost: 64 bytes per pair apart, 240 to 420 per contact.
namespace drawpoint::engine::detail {

struct ColliderState {
  Eigen::Matrix3d R;
  Eigen::Vector3d p, centre;
  double motion_bound, boxed_at, speculative_margin;
  Eigen::AlignedBox3d box;
  bool dirty;
};

struct FinderState {
  std::vector<ColliderState> colliders;  ///< of removed ones: not set
  std::vector<int> pending;              ///< colliders that the broad phase is to look up
  std::vector<PairEntry> entries;
  std::vector<NearState> near;  ///< in the order of the entries; their slots are places in `held`
  std::vector<PairState> held;
};

/// The parts of a finder.
struct FinderParts {
  const ContactFinderOptions& options;
  const Items& items;
  const BroadPhase& boxes;
  const PairCache& pairs;
};

std::vector<std::byte> save_state(const FinderParts& parts);

/// Throws std::runtime_error when the bytes are not a state of such a finder.
FinderState read_state(const FinderParts& parts, std::span<const std::byte> bytes);

}  // namespace drawpoint::engine::detail
