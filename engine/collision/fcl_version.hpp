// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The version of FCL that this library was compiled with, such as "0.7.0".

#include <string>

namespace drawpoint::engine::collision {

std::string fcl_version();

}  // namespace drawpoint::engine::collision
