// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <vector>

/// Where the work of the motors goes in each cycle.
namespace drawpoint::engine::loading {

struct EnergyLedger {
  double work = 0;        ///< of lift, tilt and wheel motors; braking and holding back count negative [kJ]
  double machine = 0;     ///< gained by the machine, kinetic and potential [kJ]
  double rock = 0;        ///< gained by the rock, in the bucket and in the pile [kJ]
  double dissipated = 0;  ///< what is left: friction, impacts, rolling tyres, and errors of the step [kJ]
};

/// Up to each sample of a cycle, from its first one; one entry per sample, empty for a cycle without samples. The
/// motors' power is force times speed at the end of the step, which is exact for forces that are constant in it. Rock
/// that came down the raise meanwhile (`emitted_mass`) brings its height along and is not discounted. Throws
/// std::invalid_argument naming the signal that the log lacks.
std::vector<std::vector<EnergyLedger>> energy_ledgers(const LoadingLog& log);

/// The same at the end of each cycle.
std::vector<EnergyLedger> energy_ledger_by_cycle(const LoadingLog& log);

}  // namespace drawpoint::engine::loading
