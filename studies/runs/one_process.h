// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A process beside which nothing else is to be done.

#include <drawpoint/doe/processes.hpp>

namespace drawpoint::studies {

/// Starts it and waits for its end. Throws Interrupted where the program is asked to stop, once the process has ended.
doe::ProcessEnd end_of(const doe::Process& process);

}  // namespace drawpoint::studies
