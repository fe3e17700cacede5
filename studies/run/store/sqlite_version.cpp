// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <SQLiteCpp/Database.h>
#include <drawpoint/studies/run/store/sqlite_version.h>

namespace drawpoint::studies {

std::string sqlite_version() { return SQLite::getLibVersion(); }

}  // namespace drawpoint::studies
