// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The version of the Simbody library that is loaded, such as "3.7.0".

#include <string>

namespace drawpoint::engine::machine {

std::string simbody_version();

}  // namespace drawpoint::engine::machine
