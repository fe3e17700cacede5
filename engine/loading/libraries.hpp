// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What makes the runs of the loading case: the simulator by a name that changes with what it simulates, and the
/// libraries that it is made with, each with its version, such as "Simbody 3.7.0".

#include <string>
#include <vector>

namespace drawpoint::engine::loading {

/// Another one when machine, rock, contacts or responses have changed so that a scenario gives other numbers: a
/// study does not put the runs of both into one model.
inline constexpr const char* simulator = "drawpoint loading, model 5";

std::vector<std::string> libraries();

}  // namespace drawpoint::engine::loading
