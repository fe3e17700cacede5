// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The report of a study: one HTML file with its data, plots (plotly.js) and scene viewer (three.js) inside.
/// It loads nothing from anywhere and opens from disk. The page is assembled from report/web when the library
/// is built. studies::Study lists the kinds of figures ("panels") of a simulation.
///
/// Contents: the answer in three sentences with trade-off and simulation side by side, trade-offs, what simulation
/// said of them, figures of one simulation, runs set against each other, response surfaces (the surrogates are
/// evaluated in the browser), other hauls, how far to trust it, validation, findings, the runs, what was asked. Each part copes with what is missing: no
/// validation runs, one response, no objective, no successful run.

#include <drawpoint/studies/report/checked_runs.h>
#include <drawpoint/studies/report/flat_responses.h>
#include <drawpoint/studies/report/front_uncertainty.h>
#include <drawpoint/studies/report/haul_choice.h>
#include <drawpoint/studies/report/recommended.h>
#include <drawpoint/studies/report/run_noise.h>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/pareto/polishing.hpp>
#include <drawpoint/pareto/search.hpp>
#include <drawpoint/studies/finding.hpp>
#include <drawpoint/studies/headline.hpp>
#include <drawpoint/studies/mark.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
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

struct ReportInput {
  std::string study, about, command;     ///< any text; the page shows it as it is
  std::vector<Headline> headlines = {};  ///< said first
  std::vector<Finding> findings = {};    ///< said next
  doe::Problem problem;                  ///< what was searched: flat objectives are recorded only
  std::vector<FlatResponse> flat = {};   ///< with the goals that the study has for them
  doe::Evaluations training, validation;
  std::map<std::int64_t, std::string> kinds = {};  ///< of runs: what the table of runs calls them
  std::vector<kriging::TransformedModel>
      models;  ///< one per response, in order; empty when none could be fitted
  std::vector<kriging::Validation> validations;      ///< one per response; empty without validation runs
  std::vector<kriging::MeanError> mean_errors = {};  ///< one per validation; empty: as the page finds them
  pareto::Front front;                               ///< found on the models; no rows when there is none
  std::string no_front = {};                         ///< why there is none; empty where there is one
  Eigen::VectorXd success = {};       ///< of a run at each point of the front; empty: no run failed
  FrontUncertainty uncertainty = {};  ///< of the front
  std::vector<Mark> marks = {};       ///< points with names
  std::optional<Recommendation> recommended = {};  ///< what recommend() finds in all this; empty: nothing
  CheckedRuns confirmations = {};                  ///< points of predicted fronts that were simulated
  std::string confirming = "confirm";              ///< the command that has them simulated
  Continuation going_on = {};                      ///< how more runs are made
  pareto::Polishing polishing;                     ///< of the front
  std::string not_polished;                        ///< why it was not; empty when it was
  nlohmann::json illustrations =
      nlohmann::json::array();                         ///< panels; a faulty one is left out with a caution
  std::string shown = {};                              ///< which run these are of, and why, in a sentence
  nlohmann::json contrasts = nlohmann::json::array();  ///< panels that set runs against each other
  std::vector<std::pair<std::string, std::string>> facts;  ///< label and value: machine, wall time, versions
  std::vector<std::string> warnings;                       ///< shown first among the cautions
  std::optional<HaulChoice> hauls = {};  ///< what other hauls would change, where the study knows
};

/// Writes the file whole or not at all. Throws std::invalid_argument when the parts of the input do not
/// belong together, std::runtime_error when the disk refuses; an existing file then stands.
void write_report(const std::filesystem::path& path, const ReportInput& input);

}  // namespace drawpoint::studies
