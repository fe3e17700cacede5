// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_noise.h>
#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/engine/loading/log/responses.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace drawpoint::studies {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using engine::loading::LoadingLog;
using engine::loading::LogContent;

constexpr double most_degrees = 4;

/// What the logs read so far tell of the noise of one response.
struct RunsSoFar {
  CycleScatter scatter;
  VectorXd relative;  // variance of each run over that of a cycle; not a number where unknown

  KnownNoise noise() const {
    const auto known = relative.array().isFinite();
    const double cycle = scatter.variance(), runs = static_cast<double>(known.count());
    if (!(cycle > 0)) return {};
    const double mean = known.select(relative.array(), 0).sum() / runs;
    return {.variance = cycle * mean,
            .degrees = std::min(static_cast<double>(scatter.degrees()), most_degrees),
            .weights = known.select(relative.array() / mean, 1)};
  }
};

}  // namespace

std::array<ResponseCycles, 3> cycles_of(const LoadingLog& log, const OptionValues& options) {
  return {{{production_by_cycle(log, production_options(options))},
           {joint_damage_by_cycle(log, damage_options(options)), counted_cycles(log)},
           {rock_spill_by_cycle(log, spill_options(options))}}};
}

std::vector<int> cycle_numbers(const LoadingLog& log) {
  std::vector<int> numbers;
  for (const auto& cycle : log.cycles) numbers.push_back(cycle.number);
  return numbers;
}

std::array<KnownNoise, 3> noise_of_logs(const std::vector<std::filesystem::path>& logs,
                                        const OptionValues& options) {
  std::array<RunsSoFar, 3> runs;
  const auto n = static_cast<Index>(logs.size());
  for (RunsSoFar& response : runs) response.relative.setConstant(n, std::numeric_limits<double>::quiet_NaN());
  for (Index i = 0; i < n; ++i) {
    const std::filesystem::path& file = logs[static_cast<std::size_t>(i)];
    if (file.empty()) continue;
    try {
      const LoadingLog log = engine::loading::read_log(file, content_for(options));
      const std::array<ResponseCycles, 3> cycles = cycles_of(log, options);
      for (std::size_t r = 0; r < 3; ++r) {
        runs[r].scatter.add(cycle_numbers(log), cycles[r].by_cycle);
        runs[r].relative[i] = cycles[r].relative_variance();
      }
    } catch (const std::exception&) {  // F14 counts them, and says why
    }
  }
  return {runs[0].noise(), runs[1].noise(), runs[2].noise()};
}

}  // namespace drawpoint::studies
