// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

/// Independent blocks of work on a fixed number of threads.
///
/// Which thread does a block is left to chance, so blocks must not depend on each other; then the result does
/// not depend on the number of threads. With one thread blocks run in their order on the caller.
namespace drawpoint::engine::contact::detail {

class Parallel {
 public:
  explicit Parallel(int threads);
  ~Parallel();
  Parallel(Parallel&&) noexcept;
  Parallel& operator=(Parallel&&) noexcept;

  int threads() const { return threads_; }

  /// Calls work(begin, end) for blocks of at most `block` numbers out of 0 .. count-1.
  void blocks(int count, int block, const std::function<void(int, int)>& work) const;

 private:
  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;  // none with one thread
};

}  // namespace drawpoint::engine::contact::detail
