// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Ctrl-C (SIGINT, SIGTERM) of a command that prints what it has so far: the signal only sets a flag, which
/// the runs look at.
namespace drawpoint::benchmarks {

constexpr int interrupted_exit = 130;  ///< exit code of a command that was interrupted

/// From here on. Call before the runs.
void watch_for_interrupt();
bool interrupted();
/// Throws std::runtime_error once interrupted: to be called within a run.
void end_if_interrupted();

}  // namespace drawpoint::benchmarks
