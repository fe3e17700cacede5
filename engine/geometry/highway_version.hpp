// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The version of Highway that this library was compiled with, such as "1.0.3".

#include <string>

namespace drawpoint::engine::geometry {

std::string highway_version();

}  // namespace drawpoint::engine::geometry
