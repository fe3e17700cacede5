// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <drawpoint/benchmarks/micro/comparison.hpp>

namespace drawpoint::benchmarks {

std::string series_name(const Measured& row) { return row.method + ", S = " + std::to_string(row.substeps); }

std::vector<Best> best_within(const std::vector<Measured>& rows, const std::vector<double>& times) {
  std::vector<Best> all;
  for (const Measured& row : rows) {
    const std::string series = series_name(row);
    if (all.empty() || all.back().series != series)
      all.push_back({series, std::vector<const Measured*>(times.size(), nullptr)});
    for (std::size_t k = 0; k < times.size(); ++k) {
      const Measured*& best = all.back().within[k];
      const Evaluation& e = row.evaluation;
      if (e.milliseconds > times[k]) continue;
      if (!best || e.distance.velocities < best->evaluation.distance.velocities) best = &row;
    }
  }
  return all;
}

}  // namespace drawpoint::benchmarks
