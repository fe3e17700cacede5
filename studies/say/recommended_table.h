// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The strategy that the report recommends (model/recommendation.h) as a table: what many runs there give in the mean,
/// what one run gives, and the gain against a reference, in all objectives and limits.
///
/// Intervals hold 95 %, by draws of the models. Simplified: the choice among points is not in them; they are too short
/// by what it exploits.

#include <drawpoint/studies/model/recommended.h>
#include <drawpoint/studies/say/page/report.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drawpoint::studies {

struct Interval95 {
  double mean, lower, upper;
};

struct RecommendedResponse {
  std::size_t response;  ///< of the problem; objectives and limits alone
  Interval95 mean, run;  ///< of the mean of many runs, of one run
  double reference;      ///< mean there
  Interval95 gain;       ///< in the direction of the goal: above 0 is better; NaN for limits
};

struct RecommendedTable {
  Recommendation recommended;
  std::string choice;  ///< "the recommended one of 200 points of the predicted front"
  double success = 1;  ///< probability that a run succeeds
  std::vector<RecommendedResponse> responses;
};

/// Requires an input with models, a front and what is recommended of it.
RecommendedTable recommended_table(const ReportInput& input);

/// With the command that has it simulated: input.going_on says of which program and folder.
std::string text(const RecommendedTable& table, const ReportInput& input);

/// {"x": {}, "choice", "success", "against": {}, "responses": {name: {"mean", "lower", "upper", "run_lower",
/// "run_upper", "against", "gain", "gain_lower", "gain_upper"}}, "simulated": [runs], "confirm": command,
/// "cautions": []}; what is unknown is null.
nlohmann::ordered_json as_json(const RecommendedTable& table, const ReportInput& input);

}  // namespace drawpoint::studies
