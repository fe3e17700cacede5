// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The report of a study: one HTML file with its data, plots (plotly.js) and scene viewer (three.js) inside.
/// It loads nothing from anywhere and opens from disk. The page is assembled from say/page/web when the library
/// is built. studies::Study lists the kinds of figures ("panels") of a simulation.
///
/// Contents: the answer in three sentences with trade-off and simulation side by side, trade-offs, what simulation
/// said of them, figures of one simulation, runs set against each other, response surfaces (the surrogates are
/// evaluated in the browser), other hauls, how far to trust it, validation, findings, the runs, what was asked. Each
/// part copes with what is missing: no validation runs, one response, no objective, no successful run.

#include <drawpoint/studies/model/modelled_study.h>
#include <drawpoint/studies/finding.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::studies {

/// How a study goes on: what its next runs are made with, and how many points it plans so far.
struct Continuation {
  bool possible = true;        ///< false: another simulator made its runs, and none can be added
  std::string making = "run";  ///< the command that makes runs, or gives them to who makes them
  std::string folder = {};     ///< the option that names the folder, with a space before it
  std::string program = {};    ///< what is typed before a command; empty: unknown
  int training = 0, validation = 0, adaptive = 0;  ///< points, made or not
};

/// What the models say, and what the page says beside it.
struct ReportInput : ModelledStudy {
  std::string study, about, command;               ///< any text; the page shows it as it is
  std::vector<Finding> findings = {};              ///< said behind the headlines
  std::map<std::int64_t, std::string> kinds = {};  ///< of runs: what the table of runs calls them
  std::string confirming = "confirm";              ///< the command that has points simulated
  Continuation going_on = {};                      ///< how more runs are made
  nlohmann::json illustrations =
      nlohmann::json::array();                         ///< panels; a faulty one is left out with a caution
  std::string shown = {};                              ///< which run these are of, and why, in a sentence
  nlohmann::json contrasts = nlohmann::json::array();  ///< panels that set runs against each other
  std::vector<std::pair<std::string, std::string>> facts;  ///< label and value: machine, wall time, versions
  std::vector<std::string> warnings;                       ///< shown first among the cautions
};

/// Writes the file whole or not at all. Throws std::invalid_argument when the parts of the input do not
/// belong together, std::runtime_error when the disk refuses; an existing file then stands.
void write_report(const std::filesystem::path& path, const ReportInput& input);

}  // namespace drawpoint::studies
