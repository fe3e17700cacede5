// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Cycles of a loading study set against each other, chosen by its logs: a typical good one and a typical bad one, each
/// to play, and the best and the worst tracked one of all runs (root mean square distance of the cutting edge from the
/// planned path, engine/loading/log/run_measures.hpp), each with its path. Good is the cycle of median production (with
/// the haul of the options) in a run that only a tenth of the runs exceed in production, bad the same from the other
/// end: the highest of all cycles is the luckiest. Of equal ones the first.

#include <drawpoint/studies/options.hpp>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace drawpoint::studies {

/// Panels of the report, in pairs; logs are named by their run, run_0012.h5. Empty with fewer than two cycles.
/// What a log lacks leaves its cycles out. Cost: each log is read once, and up to four twice. Throws
/// std::runtime_error if a log cannot be read.
nlohmann::json loading_contrasts(const std::vector<std::filesystem::path>& logs,
                                 const OptionValues& options = {});

}  // namespace drawpoint::studies
