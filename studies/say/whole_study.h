// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A whole study in one HDF5 file for other programs (docs/decisions/0003).
///
///     study/        name, seed, simulator, version; no_front, why there is none
///     options/      one text per option of the study
///     variables/    one entry per variable: name, unit, lower, upper, kind, description
///     levels/       per categorical variable the names of its levels
///     responses/    one entry per response: name, unit, goal, limit, lower, upper, description
///     runs/         one entry per run: the columns of runs_table
///     front/        one entry per point of the predicted front: the columns of front_table
///
/// One dataset per column, with the attributes `unit` and `description`: numbers as doubles, NaN where there
/// is none; whole numbers as 32-bit integers; text of fixed length, in UTF-8. A "/" in a name is a "_" here,
/// and a name that is taken gets a "_" behind. Equal studies give equal bytes.

#include <drawpoint/studies/run/store/store.h>

#include <filesystem>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// Writes beside the file, reads that again and renames it over the file. Returns why there is no front, or
/// "". Throws std::runtime_error if it cannot be written, and the old file then still stands.
std::string write_whole_study(const std::filesystem::path& file, const Identity& identity,
                              const std::vector<Run>& runs);

}  // namespace drawpoint::studies
