// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

/// Runs stages of independent blocks on a few threads, one stage after another.
///
/// A solve has hundreds of short stages (the zones of a sweep take some hundred microseconds), too short to
/// fork and join for each. The team forks once and its helpers wait at the end of a stage for the next one.
/// Of T threads the k-th begins with the blocks from k/T to (k+1)/T of the stage, so that in stage after
/// stage it works on the same part of the data, which stays in its core's cache; then it does what others
/// have not begun. The calling thread can do all the work alone, so a helper that the system does not run
/// delays nothing but its own share. Who does a block is thus left to chance, which is why the blocks of a
/// stage must be independent: then the result does not depend on it.
namespace drawpoint::engine::contact::detail {

class StageTeam {
 public:
  /// `threads` ≥ 1, the caller among them.
  explicit StageTeam(int threads);
  ~StageTeam();
  StageTeam(const StageTeam&) = delete;
  StageTeam& operator=(const StageTeam&) = delete;

  /// Calls work(block) for every block in 0 .. blocks-1 and returns when all are done. `work` must not throw.
  void run(int blocks, const std::function<void(int)>& work);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace drawpoint::engine::contact::detail
