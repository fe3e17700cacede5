// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What an evaluation can be told, and what it tells while it runs.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <stop_token>

#include <drawpoint/doe/evaluations.hpp>

namespace drawpoint::doe {

struct EvaluateProgress {
  std::int64_t done = 0;    ///< runs that have ended, those remembered from a journal included
  std::int64_t failed = 0;  ///< of these
  std::int64_t total = 0;
  double seconds = 0;       ///< wall time since the call [s]
  double seconds_left = 0;  ///< at the rate so far [s]
};

struct EvaluateOptions {
  Seed seed = 1;       ///< the study's
  int threads = 1;     ///< runs at once, 0: all cores; a batch function ignores it
  int replicates = 1;  ///< runs a design point, 1 or more, each with its own seed
  /// Called as each run ends, one call at a time, in order of ending; not for remembered runs.
  std::function<void(const Evaluation&)> on_result = {};
  std::int64_t first_run = 0;  ///< number of the first row, 0 or more: to go on with a study
  /// Replicate k has the same seed at every point: differences between points then lose the noise that they
  /// share. Off by default, because surrogates take the noise of different points as independent.
  bool common_random_numbers = false;
  std::optional<int> batch_size = {};  ///< rows per call of a batch function, 1 or more; empty: all in one
  /// Wall time of a run [s], above 0. A run that takes longer becomes a failure, once it has returned: a
  /// function of the form f(x, seed, stop) is asked to at the limit, others end when they end. For a limit
  /// that kills, run processes. Does not apply to batch functions, which see to their own time.
  double time_limit = std::numeric_limits<double>::infinity();
  /// Requested: no run is begun any more, those in flight end (or are asked to), and the table has the rows
  /// that were done.
  std::stop_token stop = {};
  /// Called after on_result, under the same lock.
  std::function<void(const EvaluateProgress&)> progress = {};
  /// Where each run is kept as it ends (run_journal.hpp); runs that are there already are not made again.
  /// Empty: nowhere.
  std::filesystem::path journal = {};
};

}  // namespace drawpoint::doe
