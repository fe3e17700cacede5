// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/drive_line.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::loading {
namespace {

constexpr double least_share = 1e-3;  // of the torque near standstill

void require_drive(bool good, const char* name, double value, const char* allowed) {
  if (!good)
    throw std::invalid_argument("loading::DriveLine: " + std::string(name) + " is " + std::to_string(value) +
                                "; give " + allowed);
}

}  // namespace

double wheel_torque_limit(const DriveLine& line, double near_stall, double wheel_speeds, double arm_power) {
  if (std::isinf(line.engine_power) || !(wheel_speeds > 0)) return near_stall;
  const double at_wheels =
      line.wheel_efficiency * (line.engine_power - std::max(arm_power, 0.0) / line.pump_efficiency);
  return std::clamp(at_wheels / wheel_speeds, least_share * near_stall, near_stall);
}

void check(const DriveLine& line) {
  require_drive(line.engine_power > 0, "engine_power [W]", line.engine_power,
                "a value above 0; infinity for no limit");
  const auto share = [](double value) { return value > 0 && value <= 1; };
  require_drive(share(line.wheel_efficiency), "wheel_efficiency [1]", line.wheel_efficiency,
                "above 0, up to 1");
  require_drive(share(line.pump_efficiency), "pump_efficiency [1]", line.pump_efficiency, "above 0, up to 1");
}

}  // namespace drawpoint::engine::loading
