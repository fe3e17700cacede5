// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/collision/fcl_version.hpp>
#include <drawpoint/engine/geometry/highway_version.hpp>
#include <drawpoint/engine/loading/libraries.hpp>
#include <drawpoint/engine/machine/simbody_version.hpp>
#include <drawpoint/engine/record/hdf5_version.hpp>

namespace drawpoint::engine::loading {

std::vector<std::string> libraries() {
  return {"Simbody " + machine::simbody_version(), "FCL " + collision::fcl_version(),
          "Highway " + geometry::highway_version(), "HDF5 " + record::hdf5_version()};
}

}  // namespace drawpoint::engine::loading
