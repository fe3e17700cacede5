// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Adaptive sampling of a study: batches of runs where the runs before them show that they teach most.
///
/// A batch is chosen by all that has ended, failed runs included, and planned whole: what is stored decides,
/// so that a study that was killed goes on with the same points. Each point is planned with what the models
/// of that moment say of it.

#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/run/store/store.h>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// Places where runs fail (failures.h) are not chosen: the models learn nothing there and would ask for them
/// for ever. Elsewhere a place counts as much as a run there is likely to succeed.
enum class BatchStatus {
  planned,
  complete,    ///< all points that are wanted are there
  target_met,  ///< the models are good enough already, by Sampling::target or ::until
  exhausted,   ///< no place is left: whole variables with few values, all around failed, or none to repeat
  no_models    ///< the runs do not allow models to go by
};

struct Batch {
  BatchStatus status = BatchStatus::complete;
  std::vector<Run> runs = {};  ///< none but where planned
  int repeats = 0;             ///< the last so many of them are at points of earlier runs
  std::string message = {};    ///< what the models are worth, or why there are none; empty when complete
  StopNote stopped = {};       ///< why no run is planned though more are wanted; empty where there is one
};

/// Requires that no run is planned or running. Throws UsageError for criteria that there are not,
/// std::invalid_argument for those that the problem does not allow (improvement without an objective).
Batch next_batch(const Identity& identity, const Sampling& sampling, const std::vector<Run>& runs);

/// Whether the error of the mean of every response but standard errors, over its range, is at most the target. False
/// without a target or without validation runs (no errors).
bool target_met(const Sampling& sampling, const doe::Problem& problem,
                const std::vector<kriging::MeanError>& errors);

}  // namespace drawpoint::studies
