// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace drawpoint::studies {

/// Version of the SQLite library that is loaded, such as "3.40.1".
std::string sqlite_version();

}  // namespace drawpoint::studies
