// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdio>
#include <drawpoint/engine/world/world.hpp>
#include <nlohmann/json.hpp>

/// Sums up where the steps of a scenario spend their time and prints it in milliseconds per step.
namespace drawpoint::benchmarks {

class StepTimes {
 public:
  void add(const engine::StepReport& r) {
    ++steps_;
    broad_ += r.broad_s;
    narrow_ += r.narrow_s;
    machine_ += r.machine_s;
    solver_ += r.solver_s;
    rest_ += r.rest_s;
    points_ = std::max(points_, r.points);
    overlap_ = std::max(overlap_, r.max_overlap);
  }

  void print(const char* what, double simulated_s) const {
    const double total = broad_ + narrow_ + machine_ + solver_ + rest_,
                 ms = 1e3 / static_cast<double>(std::max(1L, steps_));
    std::printf("%s: %ld steps, %.2f s simulated, %.2f s wall, real-time factor %.3f\n", what, steps_,
                simulated_s, total, total > 0 ? simulated_s / total : 0.0);
    std::printf(
        "  ms per step: total %.3f = broad %.3f + narrow %.3f + machine %.3f + solver %.3f + rest %.3f\n",
        total * ms, broad_ * ms, narrow_ * ms, machine_ * ms, solver_ * ms, rest_ * ms);
    std::printf("  accuracy: most contact points %d, largest overlap of a rock %.2f mm\n", points_,
                overlap_ * 1e3);
  }

  /// Milliseconds per step, by part, and the accuracy.
  nlohmann::json per_step() const {
    const double ms = 1e3 / static_cast<double>(std::max(1L, steps_));
    return {{"ms_step", ms * (broad_ + narrow_ + machine_ + solver_ + rest_)},
            {"ms_broad", ms * broad_},
            {"ms_narrow", ms * narrow_},
            {"ms_machine", ms * machine_},
            {"ms_solver", ms * solver_},
            {"ms_rest", ms * rest_},
            {"largest_overlap_mm", 1e3 * overlap_}};
  }

 private:
  long steps_ = 0;
  double broad_ = 0, narrow_ = 0, machine_ = 0, solver_ = 0, rest_ = 0, overlap_ = 0;
  int points_ = 0;
};

}  // namespace drawpoint::benchmarks
