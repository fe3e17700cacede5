// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <hwy/highway.h>
#include <drawpoint/engine/geometry/highway_version.hpp>

namespace drawpoint::engine::geometry {

std::string highway_version() {
  return std::to_string(HWY_MAJOR) + "." + std::to_string(HWY_MINOR) + "." + std::to_string(HWY_PATCH);
}

}  // namespace drawpoint::engine::geometry
