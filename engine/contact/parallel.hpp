// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

/// Independent blocks of work on a fixed number of threads.
///
/// Which thread does a block is left to chance, so blocks must not depend on each other; then the result does
/// not depend on the number of threads. With one thread, or one block, the caller does all of them in order.
/// There are as many threads as asked for, on machines with fewer cores as well.
namespace drawpoint::engine::contact::detail {

class Parallel {
 public:
  explicit Parallel(int threads);
  ~Parallel();
  Parallel(Parallel&&) noexcept;
  Parallel& operator=(Parallel&&) noexcept;

  int threads() const { return threads_; }

  /// Calls work(begin, end) for blocks of at most `block` numbers out of 0 .. count-1. What a block throws
  /// comes out here.
  void blocks(int count, int block, const std::function<void(int, int)>& work) const;
  /// The same with the number of the thread, 0 .. threads()-1, for buffers that a thread keeps to itself.
  void blocks_by_thread(int count, int block, const std::function<void(int, int, int)>& work) const;

 private:
  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;  // none with one thread
};

}  // namespace drawpoint::engine::contact::detail
