// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One strategy for who has to choose: the best point of the predicted front where there is one objective, else
/// its balanced choice (report/summary.h); beside a reference.
///
/// The mean of many runs, its 95 % interval, and that of what it gains come from 1024 draws of the models, in
/// which both places err together as far as they are near; the interval of one run holds its noise, too.
/// Simplified: the choice among points is not in the intervals, which are too short by what it exploits.

#include <drawpoint/studies/report/report.h>

#include <Eigen/Core>
#include <cstdint>
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

struct Recommendation {
  Eigen::VectorXd x, against;
  std::string choice;  ///< "the balanced choice of 200 points of the predicted front"
  double success = 1;  ///< probability that a run succeeds
  std::vector<RecommendedResponse> responses;
  std::vector<std::int64_t> simulated;  ///< confirmation runs within 2 % of each range
};

/// Requires an input with models and a front.
Recommendation recommendation_of(const ReportInput& input, const Eigen::VectorXd& against, doe::Seed seed);

struct RecommendationWords {
  std::string reference;  ///< "the middle of the box", "--against"
  std::string confirm;    ///< the command that has it simulated
};

std::string text(const Recommendation& recommended, const ReportInput& input,
                 const RecommendationWords& words);

/// {"x": {}, "choice", "success", "against": {}, "responses": {name: {"mean", "lower", "upper", "run_lower",
/// "run_upper", "against", "gain", "gain_lower", "gain_upper"}}, "simulated": [runs], "confirm": command,
/// "cautions": []}; what is unknown is null.
nlohmann::ordered_json as_json(const Recommendation& recommended, const ReportInput& input,
                               const RecommendationWords& words);

}  // namespace drawpoint::studies
