// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <vector>

/// Where the work of the motors goes.
///
/// Up to each sample of a cycle, from its first one: the work of lift, tilt and wheel motors is what machine
/// and rock gain, kinetic and potential, and what friction, impacts and tyres take. Power is force times
/// speed at the end of the step: off by ½ F Δv h where the speed changes by Δv in a step, and by more in a
/// step that was done again in parts. Rock that came down the raise or left the drift meanwhile
/// (`emitted_mass`, `escaped_mass`) brings or takes its energy along, which is not discounted.
namespace drawpoint::engine::loading {

struct EnergyBalance {
  double work = 0;        ///< of lift, tilt and wheel motors; braking and holding back count negative [kJ]
  double machine = 0;     ///< gained by the machine, kinetic and potential [kJ]
  double rock = 0;        ///< gained by the rock, in the bucket and in the pile [kJ]
  double dissipated = 0;  ///< what is left: friction, impacts, rolling tyres, and errors of the step [kJ]
};

/// One entry per sample; empty for a cycle without samples. Throws std::invalid_argument naming the signal
/// that the log lacks.
std::vector<std::vector<EnergyBalance>> energy_balances(const LoadingLog& log);

/// The same at the end of each cycle.
std::vector<EnergyBalance> energy_balance_by_cycle(const LoadingLog& log);

}  // namespace drawpoint::engine::loading
