// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Follows the store of a study that another process may be working on. It only reads: a look takes the
/// store's read lock for as long as its rows are read, which a writer waits for, and takes no lock of the
/// folder.

#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// A study as it was read.
struct Contents {
  Identity identity;
  Sampling sampling;
  std::vector<Run> runs;
  /// Places in `runs` of those that have ended, in the order in which their ends were seen: it only grows
  /// within an epoch. A new epoch begins where a run that had ended is planned again, and with each follower.
  std::vector<std::size_t> ended = {};
  std::uint64_t epoch = 0;
};

struct View {
  std::shared_ptr<const Contents> contents;  ///< of the last time that it could be read; empty: not yet
  std::string trouble;                       ///< why it could not be read now; empty: it could
  bool there = true;                         ///< whether there is a store
  std::optional<FolderHolder> holder;        ///< who works in the folder
};

/// May be asked by several threads.
class Follower {
 public:
  /// Throws as open_store does, but for a store that is not there or busy. `study` must outlive it. share: of
  /// the time, above 0, that reading may take; in between, what was read last stands.
  Follower(const Study& study, Folder folder, double share = 0.1);

  /// What the folder holds now; the store is read where its file has changed.
  View look();

 private:
  void read();

  const Study& study_;
  Folder folder_;
  double share_;
  std::mutex mutex_;
  View view_;
  std::string seen_;  ///< what the file was like when it was read; empty: to be read again
  std::chrono::steady_clock::time_point rests_until_ = {};
};

/// The next state of `ended` and `epoch`, which `now` gets: those of `before` where they go on.
void order_ends(Contents& now, const Contents* before);

}  // namespace drawpoint::studies
