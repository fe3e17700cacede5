// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Progress of a number of runs, or of other things: on a terminal one line that is rewritten, elsewhere a plain line
/// now and then. The time left assumes that the runs to come take as long as those of this session.

#include <chrono>
#include <string>

namespace drawpoint::studies {

/// "40 s", "12 min", "3.5 h", "2.1 d"
std::string duration_text(double seconds);

/// "12/50 runs, 1 failed, 3.2 per minute, 12 min left"
struct ProgressState {
  int done = 0;  ///< finished, failed ones among them, earlier sessions included
  int failed = 0;
  int total = 0;
  int session = 0;  ///< finished since `seconds` ago
  double seconds = 0.0;
  std::string things = "runs";  ///< what is counted
  std::string standing = {};    ///< of the tasks of a cluster, "2 at work, 40 waiting (Resources)"
};
std::string progress_text(const ProgressState& state);
/// Runs per second; 0 while none of this session has ended.
double rate_of(const ProgressState& state);
/// Until all are made, at this rate; requires one.
double seconds_left(const ProgressState& state);

class Progress {
 public:
  /// Writes to file descriptor `descriptor` (1 or 2).
  Progress(int descriptor, ProgressState start);
  ~Progress();  ///< leaves the cursor on a fresh line

  void finished_one(bool failed);
  void tick(const std::string& standing);  ///< call a few times per second

 private:
  void show(bool last);

  int descriptor_;
  bool live_;
  bool line_open_ = false;
  ProgressState state_;
  std::chrono::steady_clock::time_point start_, shown_;
};

}  // namespace drawpoint::studies
