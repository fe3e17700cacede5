// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A study written as a JSON file, whose simulator is a program in any language (external_program.hpp):
///
///     {"name": "throw", "about": "Ore thrown from a belt.",
///      "variables": [{"name": "speed", "unit": "m/s", "lower": 1, "upper": 6},
///                    {"name": "rollers", "lower": 2, "upper": 6, "kind": "integer"},
///                    {"name": "lining", "kind": "categorical", "levels": ["steel", "rubber"]}],
///      "responses": [{"name": "reach", "unit": "m", "goal": "maximize"},
///                    {"name": "wear", "goal": "at_most", "limit": 3, "lower": 0}],
///      "command": ["python3", "throw.py"], "exchange": "files", "attempts": 1, "time_limit": 60,
///      "files": ["model/*.py"], "version": "2",
///      "defaults": {"runs": 40, "validation": 10, "adaptive": 0}}
///
/// Needed are name, variables, responses and command; a variable has lower and upper unless it has levels, a
/// response a goal: minimize, maximize, at_most, at_least or record. Both may have a description. A word of
/// the command that names a file beside the study file means that file, wherever the study is started.
/// Unknown and repeated keys are refused, since they are mostly mistakes.
///
/// The command and these files are what the study holds its runs to (Simulator::name), by their checksum, with
/// `version` and those that `files` names; without it, those that lie beside a program and end as it does
/// (simulator_files.h).
/// The processes of its runs are given the file's name with a checksum of all of it, "@CHECKSUM:FILE", and
/// end where it no longer fits: the file was edited while the study ran.

#include <drawpoint/studies/study.hpp>

#include <filesystem>

namespace drawpoint::studies {

/// `word`: the file's name, as typed or as a run's process is given it. Throws std::runtime_error that names
/// the file, the place in it and what is allowed there, or says that it changed.
Study study_from(const std::string& word);

/// The study of a file that `share` made: without its command, so that no run can be made but elsewhere.
Study study_in_share(const std::filesystem::path& share);

}  // namespace drawpoint::studies
