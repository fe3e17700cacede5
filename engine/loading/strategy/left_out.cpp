// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/strategy/left_out.hpp>

namespace drawpoint::engine::loading {

LeftOut approach(double distance, const SpeedPreset& speeds) {
  const double most = std::min(speeds.drive_in, speeds.limits.drive), a = speeds.limits.drive_acceleration;
  if (!(distance > 0)) return {};
  if (std::isinf(a)) return {distance / most, most};
  const double arrival = std::min(most, std::sqrt(2 * a * distance));
  return {arrival / a + (distance - arrival * arrival / (2 * a)) / arrival, arrival};
}

LeftOut way_back(double whole, double done, double speed, double elapsed, const ExecutorOptions& options) {
  constexpr double dt = 0.001;
  const SpeedPreset& speeds = options.speeds;
  const double first = std::min(speeds.back_out, speeds.limits.drive),
               limit = speeds.stage_limit[static_cast<std::size_t>(Stage::back_out) - 1];
  LeftOut left{.time = 0, .speed = speed};
  while (!goal_reached(done / whole, options.progress) && elapsed + left.time < limit) {
    speed = std::min(first * translation_factor(done / whole, options.progress),
                     speed + speeds.limits.drive_acceleration * dt);
    done += speed * dt;
    left.time += dt;
    left.speed = std::max(left.speed, speed);
  }
  return left;
}

}  // namespace drawpoint::engine::loading
