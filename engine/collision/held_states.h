// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/convex_contact.h>
#include <Eigen/Dense>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

/// The contacts of the pairs that touch, each in a slot that is its pair's own as long as it touches.
///
/// Several threads take and give back slots while others work in theirs: nothing moves. Which pair has which slot
/// depends on the threads, what is in it does not. Memory is reused, not returned.
namespace drawpoint::engine::detail {

struct alignas(64) PairState {
  ConvexContact contact;
  double margin = 0;                                 ///< that the contact was searched with [m]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the smaller shape, in the frame of the larger
  Eigen::Matrix3d orientation =
      Eigen::Matrix3d::Zero();  ///< of the smaller shape, in the frame of the larger
};

class HeldStates {
 public:
  PairState& operator[](int slot) { return chunks_[slot / chunk_size][slot % chunk_size]; }
  const PairState& operator[](int slot) const { return chunks_[slot / chunk_size][slot % chunk_size]; }
  int slots() const { return slots_; }

  /// Before take(): room for the addresses of this many states; the states themselves come as they are taken.
  void expect(std::size_t most) {
    if (chunks_.size() * chunk_size < most + chunk_size) chunks_.resize(most / chunk_size + 2);
  }
  int take() {
    const std::lock_guard lock(mutex_);
    if (!free_.empty()) {
      const int slot = free_.back();
      free_.pop_back();
      return slot;
    }
    if (slots_ % chunk_size == 0) chunks_[slots_ / chunk_size] = std::make_unique<PairState[]>(chunk_size);
    return slots_++;
  }
  void give_back(int slot) {
    const std::lock_guard lock(mutex_);
    free_.push_back(slot);
  }
  void clear() {
    chunks_.clear();
    free_.clear();
    slots_ = 0;
  }

 private:
  static constexpr int chunk_size = 1024;

  std::vector<std::unique_ptr<PairState[]>> chunks_;
  std::vector<int> free_;
  int slots_ = 0;
  std::mutex mutex_;
};

}  // namespace drawpoint::engine::detail
