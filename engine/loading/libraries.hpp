// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The libraries that the loading case is made with, each with its version, such as "Simbody 3.7.0".

#include <string>
#include <vector>

namespace drawpoint::engine::loading {

std::vector<std::string> libraries();

}  // namespace drawpoint::engine::loading
