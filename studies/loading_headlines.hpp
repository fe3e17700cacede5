// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the loading study says first: does the bucket fill, do drive-ins stall, how noisy are the responses.

#include <drawpoint/studies/headline.hpp>

#include <filesystem>
#include <vector>

namespace drawpoint::studies {

/// From the run logs: fill factor and share of stalled drive-ins, means over all cycles, and the noise of
/// each response. Noise is the standard deviation that a run repeated with other random rocks would have:
/// from the scatter s of a response over the n cycles of a run, s/√n for a mean over cycles and s·√n for a
/// sum, pooled over the runs. It counts a trend over the cycles as noise, so it is at most that; runs of one
/// cycle tell none. Throws std::runtime_error if a log cannot be read.
std::vector<Headline> loading_headlines(const std::vector<std::filesystem::path>& logs);

}  // namespace drawpoint::studies
