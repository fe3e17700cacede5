// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a run lies in the table of runs (store.h): fixed columns, then Columns::all().

#include <drawpoint/studies/run/store/columns.h>
#include <drawpoint/studies/run/store/store.h>

#include <string>
#include <utility>
#include <vector>

namespace drawpoint::studies::detail {

/// SQL that makes the table.
std::string create_runs(const Columns& columns);

/// The rows for which `condition` (SQL) holds, in order of id, as they are, sound or not, with their
/// checksums.
std::vector<std::pair<Run, std::string>> read_rows(SQLite::Database& database, const Columns& columns,
                                                   const std::string& condition);

}  // namespace drawpoint::studies::detail
