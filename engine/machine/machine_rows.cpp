// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/machine/machine_rows.h>
#include <algorithm>
#include <limits>

namespace drawpoint::engine::machine {
namespace {

constexpr double recovery_steps = 5;  // over which an overrun is taken back
constexpr double out_of_reach = 1e6;  // [rad or m], of an end that is at infinity

}  // namespace

std::array<StopSide, 2> ends_of(const StopSpec& stop, double coordinate) {
  return {{{coordinate - stop.lower, 1.0}, {stop.upper - coordinate, -1.0}}};
}

engine::SuperBodyRow motor_row(const MotorSetting& motor, const Eigen::RowVectorXd& joints, double h,
                               double start) {
  engine::SuperBodyRow row;
  row.jacobian = joints.transpose();
  row.target = motor.speed;
  row.lower = -motor.reverse_limit * h;
  row.upper = motor.limit * h;
  row.start = start;
  return row;
}

engine::SuperBodyRow stop_row(const StopSpec& stop, const StopSide& side, const Eigen::RowVectorXd& joints,
                              double h, double start) {
  engine::SuperBodyRow row;
  row.kind = engine::SuperBodyRow::Kind::stop;
  row.jacobian = side.sign * joints.transpose();
  row.gap = static_cast<double>(stop.bodies.size()) * std::min(side.gap, out_of_reach);
  row.recovery = recovery_steps * h;
  row.upper = std::numeric_limits<double>::infinity();
  row.start = start;
  return row;
}

}  // namespace drawpoint::engine::machine
