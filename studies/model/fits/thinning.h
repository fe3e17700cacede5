// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fewer runs where there are more than models take: a fit needs n² numbers of memory and n³ operations.
///
/// Of more than 2000 runs 1000 stay: all that the study made itself, if they are half of that or fewer, the least and
/// the largest value of each response, and of the others every so many, in their order. Equal runs stay each time.

#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/doe/evaluations.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace drawpoint::studies {

inline constexpr std::size_t most_runs_of_models = 2000, runs_of_thinned = 1000;

/// `runs`: those of the rows, for their kinds.
void thin(doe::Evaluations& table, const std::vector<Run>& runs);

/// That of so many rows only these are used, in a sentence; empty: all are.
std::string thinned_text(std::size_t of, std::size_t kept, const std::string& what);

}  // namespace drawpoint::studies
