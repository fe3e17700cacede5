// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The wall time that a command may take, from when it began: no run is begun behind its end, nor one that, by
/// the mean of the runs that ended before, would end behind it. Runs that are being made end.

#include <chrono>
#include <string>

namespace drawpoint::studies {

/// "90s", "30min", "2h" or "1.5d" [s]. Throws UsageError for what is no time above 0 or has no unit.
double budget_seconds(const std::string& text);

class Budget {
 public:
  Budget() = default;  ///< no end
  /// From now on; `text` as for budget_seconds, empty: no end.
  explicit Budget(const std::string& text);

  void run_ended(double seconds);
  double mean_seconds() const;  ///< of the runs that ended; 0 where none has
  int runs() const { return runs_; }
  double seconds_left() const;  ///< 0 or less: spent
  bool has_room() const;        ///< for one more run
  const std::string& text() const { return text_; }

 private:
  std::string text_ = {};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double seconds_in_runs_ = 0.0;
  int runs_ = 0;
};

}  // namespace drawpoint::studies
