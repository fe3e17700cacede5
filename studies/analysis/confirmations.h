// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which stored runs were predicted before they were made, and how that came out.

#include <drawpoint/studies/report/checked_runs.h>
#include <drawpoint/studies/store/store.h>
#include <drawpoint/doe/problem.hpp>

#include <cstdint>
#include <vector>

namespace drawpoint::studies {

/// The runs of a kind that ended and were predicted, from id `first` on.
CheckedRuns check_predictions(const std::vector<Run>& runs, const doe::Problem& problem, Kind kind,
                              std::int64_t first = 1);

}  // namespace drawpoint::studies
