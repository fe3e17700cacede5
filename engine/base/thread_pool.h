// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

/// Loops over independent blocks on a fixed number of threads, one loop after another.
///
/// A step has hundreds of short loops: the zones of a sweep take some hundred microseconds, the bodies of a
/// substep ten. To wake a thread for each takes as long. During a Shift the helpers stay awake and wait at
/// the end of a loop for the next one; a loop outside a shift is a shift of its own. Of T threads the k-th
/// begins with the blocks from k/T to (k+1)/T of a loop, so that in loop after loop it works on the same part
/// of the data, which stays in its core's cache; then it does what others have not begun. Who does a block is
/// thus left to chance, which is why the blocks of a loop must be independent: then the result does not
/// depend on it.
///
/// With one thread, or one block, the caller does all of them in order. A team has as many threads as asked
/// for, on machines with fewer cores as well; where several teams are on shift at a time, some may find no
/// helpers, and their callers do the work alone. Helpers that wait spin, then yield: a shift occupies its
/// cores. A helper that the system does not run delays its own block and the end of the shift. Not for
/// concurrent use.
namespace drawpoint::engine::detail {

class Parallel {
 public:
  explicit Parallel(int threads);  ///< ≥ 1, the caller among them
  ~Parallel();
  Parallel(const Parallel&) = delete;
  Parallel& operator=(const Parallel&) = delete;

  int threads() const { return threads_; }

  /// Keeps the helpers awake while it lives; one within another does nothing.
  class Shift {
   public:
    explicit Shift(const Parallel& parallel);
    ~Shift();
    Shift(const Shift&) = delete;
    Shift& operator=(const Shift&) = delete;

   private:
    const Parallel& parallel_;
  };

  /// Calls work(block) for every block in 0 .. blocks-1 on at most so many threads, ≥ 1, and returns when all
  /// are done. Of what blocks throw, that of the first one comes out here.
  void run(int blocks, int threads, const std::function<void(int)>& work) const;
  /// Calls work(begin, end) for blocks of `block` numbers, ≥ 1, out of 0 .. count-1; with one thread, for all
  /// of them.
  void blocks(int count, int block, const std::function<void(int, int)>& work) const;
  /// The same with the number of the thread, 0 .. threads()-1, for buffers that a thread keeps to itself.
  void blocks_by_thread(int count, int block, const std::function<void(int, int, int)>& work) const;

 private:
  struct Team;
  int threads_;
  std::unique_ptr<Team> team_;  // none with one thread
};

}  // namespace drawpoint::engine::detail
