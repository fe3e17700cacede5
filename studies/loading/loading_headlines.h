// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the loading study says first: does the bucket fill, do drive-ins stall, how noisy are the responses;
/// then how the pile lies and what a cycle costs.

#include <drawpoint/studies/headline.hpp>
#include <drawpoint/studies/options.hpp>

#include <filesystem>
#include <vector>

namespace drawpoint::studies {

/// From the run logs: fill factor and share of stalled drive-ins, means over all cycles; the noise of each
/// response; the angle at which the pile lies at the start; and the measures of run_measures.hpp, means over
/// the runs, unknown where a log lacks what they take. Noise is by the scatter s of the n cycles within a
/// run, the mean effect of their number taken out (cycle_scatter.h): s/√n for a mean over the cycles, s·√n for a
/// sum, pooled over the runs. That is the noise of a run if its cycles are independent draws. They are not quite:
/// spilled rock stays (less scatter). Without two runs of two cycles none is known. Damage is over
/// the yield torque of the options (loading_scenario.h). Throws std::runtime_error if a log cannot be read.
std::vector<Headline> loading_headlines(const std::vector<std::filesystem::path>& logs,
                                        const OptionValues& options = {});

}  // namespace drawpoint::studies
