// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points that were made elsewhere, by tests or another program, as runs of a study.
///
/// The file is a table as `export` writes it: comma-separated, its first line with the names of the variables
/// and responses, "speed" or "speed [m/s]". Columns of other names are left alone, and so are rows whose
/// column "status", if there is one, says failed, planned or running, or nothing. A categorical variable has the name
/// of a level or its number, from 0.

#include <drawpoint/studies/run/store/store.h>

#include <filesystem>
#include <vector>

namespace drawpoint::studies {

/// The rows of the file that are not among `existing` yet, nor stood there before they were corrected, as runs that are
/// done; their numbers continue those of `existing`. Throws UsageError that names file, line and column for a column
/// that is missing or has another unit, a value that is no number or outside of its range, and a table without rows.
std::vector<Run> imported_runs(const std::filesystem::path& file, const doe::Problem& problem,
                               const std::vector<Run>& existing,
                               const std::vector<Correction>& corrections = {});

}  // namespace drawpoint::studies
