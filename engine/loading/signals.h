// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/site.hpp>
#include <drawpoint/engine/loading/strategy/executor.hpp>
#include <drawpoint/engine/record/table.hpp>

/// The raw signals of a run at full rate: one row per step, every quantity that a response may need, in
/// single precision but for the time.
///
/// Wrenches: on the child by its parent at the joint, in the child's axes, mean over the step; hinge G is the
/// bucket's. Its y component is about the pin: zero with cylinder drive, the tilt torque with hinge motors.
namespace drawpoint::engine::loading {

class SignalRecorder {
 public:
  /// Into `table`, which is to stay. `all_joints`: the wrench of each joint of the tree, in place of hinge
  /// G's alone.
  SignalRecorder(const Lhd& lhd, bool all_joints, record::Table& table);
  /// `progress`: of the present stage; `set`: what the executor asked for.
  void append(const Site& site, int cycle, const Executor& executor, const ActuatorRates& set,
              const engine::StepReport& report);

 private:
  record::Table& table_;
  std::vector<int> joints_;  // bodies whose joint wrench is logged
  std::vector<double> row_;
};

}  // namespace drawpoint::engine::loading
