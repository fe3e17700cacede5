// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The result of a study in a few lines: for people, and as the one JSON line that scripts read.

#include <drawpoint/studies/model/fronts/checked_runs.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/mean_error.hpp>
#include <drawpoint/pareto/polishing.hpp>
#include <drawpoint/studies/finding.hpp>
#include <drawpoint/studies/headline.hpp>

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::studies {

struct Summary {
  std::string study = {};
  std::map<Kind, int> ended = {};                          ///< runs of each kind, failed ones among them
  int failed = 0;                                          ///< of all kinds
  std::vector<std::string> left_out = {};                  ///< of the models: which runs, and why
  std::vector<std::string> thinned = {};                   ///< runs that are too many for models
  int unfinished = 0;                                      ///< planned or running
  std::vector<std::string> answer = {};                    ///< what to do, what it gains, how sure that is
  Eigen::VectorXd recommended = {};                        ///< empty: nothing is
  doe::Problem problem = {};                               ///< of what is recommended
  std::vector<Headline> headlines = {};                    ///< what the study says first
  std::vector<Finding> findings = {};                      ///< in the study's order
  std::vector<std::pair<std::string, double>> nrmse = {};  ///< by response; NaN where it is unknown
  std::map<std::string, kriging::MeanError> mean_errors = {};  ///< by response; none: unknown
  std::vector<std::pair<std::string, std::string>> flat = {};  ///< by response: what is said of it
  int adaptive_wanted = 0;                                     ///< adaptive points in all
  std::string until = {};     ///< the errors that were wanted, beside those reached; empty: none were
  bool until_met = false;     ///< all of them are
  StopNote stopped = {};      ///< what ended the last command before the study was complete
  std::string no_front = {};  ///< why there is none; empty where there is one
  int front = 0;              ///< points of the Pareto front
  pareto::Polishing polishing = pareto::Polishing();  ///< of the front; GCC 12 warns where this is {}
  CheckedRuns confirmations = {};                     ///< points of predicted fronts that were simulated
  std::string confirming = "confirm";                 ///< the command that has them simulated
  std::string not_polished = {};                      ///< why it was not; empty when it was
  std::filesystem::path report = {};                  ///< empty if there is none
  std::string error = {};                             ///< why there is none
};

/// {"study", "runs", "training", "adaptive", "confirmation", "validation", "failed", "left_out", "unfinished",
/// "adaptive_wanted", "until" and "until_met", "stopped" and "go_on" where there is something to say, "answer":
/// sentences, "recommended": {variable: value} or null, "headlines": {name: number or null}, "findings": {id: verdict},
/// "nrmse": {response: number or null}, "mean_error": {response: mean_error_json}, "flat": [{"response", "text"}],
/// "front", "confirmed": {"points", "values", "within", "failed", "dominated", "breaking", "agree": of the last round},
/// "certified": number or null, "polishing_gain_percent": number or null, "report": path or null}, and "not_polished"
/// and "error", which say why, if there is something to say. `runs` counts those that ended.
std::string json_line(const Summary& summary);

/// {"rmse", "lower", "upper", "nrmse", "nrmse_lower", "nrmse_upper", "noise"}: numbers or null, the first three
/// and the last in the unit of the response.
nlohmann::ordered_json mean_error_json(const kriging::MeanError& error);

/// The entry "flat".
nlohmann::ordered_json flat_json(const std::vector<std::pair<std::string, std::string>>& flat);

/// The entry "confirmed".
nlohmann::ordered_json confirmed_json(const CheckedRuns& checked);

/// Several lines, each with its end.
std::string text(const Summary& summary);

}  // namespace drawpoint::studies
