// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which stored runs were predicted before they were made, and how that came out.

#include <drawpoint/studies/model/fronts/checked_runs.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/doe/problem.hpp>

#include <vector>

namespace drawpoint::studies {

/// The runs of a kind that ended and were predicted. Of the replicates of a point the first counts: they
/// share the error of the models. Which runs dominate is told of confirmations alone, whose `rounds` are in
/// rising order; points of one round are not compared with each other.
CheckedRuns check_predictions(const std::vector<Run>& runs, const doe::Problem& problem, Kind kind,
                              const std::vector<ConfirmationRound>& rounds = {});

}  // namespace drawpoint::studies
