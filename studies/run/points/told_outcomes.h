// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What came out of runs that were made elsewhere, as a table says it.
///
/// One row per run: its number in the column "run", the responses and, if they are there, "status" (done or
/// failed; any other row is left alone), "reason" and "seconds". Variables that the table holds have to be
/// those of the run, so that a table of another study is not taken for this one's.

#include <drawpoint/studies/run/store/store.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// `y` is empty where the run failed.
struct ToldOutcome {
  std::int64_t run = 0;
  bool replaces = false;  ///< what is stored of a run that has ended
  Eigen::VectorXd y = {};
  std::string reason = {};
  double seconds = 0.0;
};

struct Told {
  std::vector<ToldOutcome> outcomes = {};  ///< of planned runs, in the order of the table
  int left_alone = 0;                      ///< rows that say neither done nor failed
};

/// Runs that have ended as the table says are left out.
/// Throws UsageError that names file, line and column for a number that is no run, a run told twice, one that
/// has ended otherwise unless `replace` is set, and values that cannot be.
Told told_outcomes(const std::filesystem::path& file, const doe::Problem& problem,
                   const std::vector<Run>& runs, bool replace = false);

}  // namespace drawpoint::studies
