// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A process beside which nothing else is to be done.

#include <drawpoint/doe/processes.hpp>
#include <drawpoint/doe/slurm_jobs.hpp>

namespace drawpoint::studies {

/// Starts it and waits for its end. Throws Interrupted where the program is asked to stop, once the process has ended.
doe::ProcessEnd end_of(const doe::Process& process);

/// The same as a task of a Slurm cluster; a task that a process which died has left is taken over, or cancelled.
doe::ProcessEnd end_on_cluster(const doe::Process& process, const doe::SlurmOptions& options);

}  // namespace drawpoint::studies
