// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The version of the HDF5 library that is loaded, such as "1.10.8".

#include <string>

namespace drawpoint::engine::record {

std::string hdf5_version();

}  // namespace drawpoint::engine::record
