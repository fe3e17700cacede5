// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Noise of the three responses of loading runs, by the scatter of the cycles within runs (cycle_scatter.h).
///
/// A response is a factor times the mean of its cycles' values: 1, or the number of cycles where it is a sum.
/// With cycles independent its variance is factor²/n_i times that of a cycle. They are not quite independent
/// (engine/loading/log/responses.hpp), so that the variance is off by a factor of two as likely as not;
/// `known_noise` gives it the weight of four degrees of freedom, an error of √(2/4) in its logarithm, at most.

#include <drawpoint/studies/loading/statistics/cycle_scatter.h>
#include <drawpoint/studies/loading/statistics/mean_draws.h>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/studies/options.hpp>

#include <array>
#include <filesystem>
#include <vector>

namespace drawpoint::studies {

/// A response of one run.
struct ResponseCycles {
  std::vector<double> by_cycle;
  double factor = 1;

  /// Variance of the response over that of a cycle.
  double relative_variance() const { return factor * factor / static_cast<double>(by_cycle.size()); }
};

/// Production, joint damage and rock spill. Throws as engine/loading/log/responses.hpp.
std::array<ResponseCycles, 3> cycles_of(const engine::loading::LoadingLog& log, const OptionValues& options);

std::vector<int> cycle_numbers(const engine::loading::LoadingLog& log);

/// Noise of each response over runs with these logs, one each. A run whose path is empty, or whose log cannot be read
/// or used, has the mean variance of the others. Nothing is known where no two runs have two cycles.
std::array<KnownNoise, 3> noise_of_logs(const std::vector<std::filesystem::path>& logs,
                                        const OptionValues& options);

}  // namespace drawpoint::studies
