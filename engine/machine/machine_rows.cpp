// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/machine/machine_rows.hpp>
#include <limits>

namespace drawpoint::engine::machine {
namespace {

constexpr double overrun_share = 0.2;  // of an overrun, taken back a step

}  // namespace

StopSide nearer_stop(const StopSpec& stop, double coordinate) {
  const double low = coordinate - stop.lower, high = stop.upper - coordinate;
  return low < high ? StopSide{low, 1.0} : StopSide{high, -1.0};
}

contact::SuperBodyRow motor_row(const MotorSpec& motor, const Eigen::RowVectorXd& joints, double speed,
                                double h, double start) {
  const double limit = motor.max_force * h;
  return {joints.transpose(), static_cast<double>(motor.bodies.size()) * speed, 0.0, -limit, limit, start};
}

contact::SuperBodyRow stop_row(const StopSide& side, const Eigen::RowVectorXd& joint, double h,
                               double start) {
  const double target = side.gap >= 0 ? -side.gap / h : -overrun_share * side.gap / h;
  return {side.sign * joint.transpose(), target, 0.0, 0.0, std::numeric_limits<double>::infinity(), start};
}

}  // namespace drawpoint::engine::machine
