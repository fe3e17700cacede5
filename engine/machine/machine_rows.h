// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/machine/machine_spec.hpp>
#include <drawpoint/engine/world/articulated_body.hpp>

/// A machine's own rows in the solve: velocity motors with force limits and joint stops.
///
/// Motor of k joints: (J₁ + … + J_k) w⁺ = k · set speed with −h · reverse limit ≤ λ ≤ h · limit, λ the
/// impulse on each. Stop of k joints, one row for each end, as a fast joint may meet either: with the distance g left
/// to it (mean over the joints) and the direction s in which it pushes, s (J₁ + … + J_k) w⁺ ≥ −k g/h, λ the impulse on
/// each; past the end (g < 0) it asks for k |g|/5h back, so that an overrun is taken out over some five steps and the
/// load is not thrown. First order in h.
namespace drawpoint::engine::machine {

struct StopSide {
  double gap;   ///< g [rad] or [m], negative past the end
  double sign;  ///< s: +1 at the lower end, −1 at the upper
};

/// The lower and the upper end.
std::array<StopSide, 2> ends_of(const StopSpec& stop, double coordinate);

struct MotorSetting {
  double speed;          ///< summed over the motor's joints [rad/s] or [m/s]
  double limit;          ///< of the force on each [N m] or [N]
  double reverse_limit;  ///< the same, against the joint's direction
};

/// `joints`: sum of the rows of N for the motor's or stop's joints; `start`: impulse to start from [N s] or
/// [N m s].
engine::SuperBodyRow motor_row(const MotorSetting& motor, const Eigen::RowVectorXd& joints, double h,
                               double start);
engine::SuperBodyRow stop_row(const StopSpec& stop, const StopSide& side, const Eigen::RowVectorXd& joints,
                              double h, double start);

}  // namespace drawpoint::engine::machine
