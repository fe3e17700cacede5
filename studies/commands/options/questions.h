// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the program `drawpoint` and the build ask a study, by a first word that --help does not show: about,
/// man-page, and complete with the words typed so far.

#include <CLI/CLI.hpp>
#include <drawpoint/studies/study.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// Prints the answer; false where the words are no question. `program` is the name without leading words.
bool answered(const CLI::App& app, const std::vector<std::string>& words, std::string program,
              const Study& study);

}  // namespace drawpoint::studies
