// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <fcl/config.h>
#include <drawpoint/engine/collision/fcl_version.hpp>

namespace drawpoint::engine::collision {

std::string fcl_version() { return FCL_VERSION; }

}  // namespace drawpoint::engine::collision
