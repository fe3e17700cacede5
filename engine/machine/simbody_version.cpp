// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <SimTKcommon/internal/common.h>

#include <drawpoint/engine/machine/simbody_version.hpp>

namespace drawpoint::engine::machine {

std::string simbody_version() {
  int major = 0, minor = 0, build = 0;
  SimTK_version_SimTKcommon(&major, &minor, &build);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(build);
}

}  // namespace drawpoint::engine::machine
