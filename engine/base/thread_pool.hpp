// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

/// Loops over independent blocks on a fixed number of threads, one loop after another.
///
/// A step has hundreds of short loops: the subdomains of an iteration take some hundred microseconds, the
/// bodies of a substep ten. To wake a thread for each takes as long. During a Region the workers stay awake
/// and wait at the end of a loop for the next one; a loop outside a region is a region of its own. Of T
/// threads the k-th begins with the blocks from k/T to (k+1)/T of a loop, so that in loop after loop it works
/// on the same part of the data, which stays in its core's cache; then it does what others have not begun.
/// Who does a block is thus left to chance, which is why the blocks of a loop must be independent: then the
/// result does not depend on it.
///
/// With one thread, or one block, the caller does all of them in order. A pool has as many threads as asked for,
/// on machines with fewer cores as well; they are its own, so it limits nobody else in the process. Outside
/// regions its workers sleep. In a region they spin while they wait, then yield: a region occupies its cores.
/// A worker that the system does not run delays its own block. Not for concurrent use.
namespace drawpoint::engine {

class ThreadPool {
 public:
  /// The caller is one of the threads. Throws std::invalid_argument unless 1 to 256.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return threads_; }

  /// Keeps the workers awake while it lives; one within another does nothing.
  class Region {
   public:
    explicit Region(const ThreadPool& pool);
    ~Region();
    Region(const Region&) = delete;
    Region& operator=(const Region&) = delete;

   private:
    const ThreadPool& pool_;
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
  struct Workers;
  int threads_;
  std::unique_ptr<Workers> workers_;  // none with one thread
};

}  // namespace drawpoint::engine
