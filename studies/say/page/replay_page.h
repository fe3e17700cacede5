// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The replay of one run: a page like the report's (report.h), with the run's point and responses, its
/// figures and how it was made.

#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/doe/problem.hpp>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::studies {

struct ReplayInput {
  std::string study, about, command;  ///< any text; the page shows it as it is
  doe::Problem problem;
  doe::Evaluation run;
  std::string kind;       ///< of the run
  nlohmann::json panels;  ///< those that studies::Study lists; a faulty one is left out with a caution
  std::vector<std::pair<std::string, std::string>> facts;  ///< label and value
  std::size_t most_bytes = 20'000'000;  ///< of all cycles; the last ones are left out, and that is said
};

/// The page. Throws std::runtime_error when no panel can be drawn, saying why.
std::string replay_page(const ReplayInput& input);

/// Writes the file whole or not at all. Throws std::runtime_error when no panel can be drawn, saying why, and
/// when the disk refuses; an existing file then stands.
void write_replay(const std::filesystem::path& path, const ReplayInput& input);

}  // namespace drawpoint::studies
