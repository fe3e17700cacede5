// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a report says first: what to do, what that gains, and how sure it is, in three sentences; or in one why
/// nothing can be recommended yet. And runs that stand out, called what they are: single runs that scatter.

#include <drawpoint/studies/say/page/report.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// Three sentences where something is recommended, and a fourth where another haul than the runs count changes the
/// order; else one or two.
std::vector<std::string> answer_sentences(const ReportInput& input);

/// "lhd_loading confirm --out results/one", as it is typed: with the program and the folder, where they are known.
std::string command_text(const ReportInput& input, const std::string& command);
/// What has this point alone simulated, once.
std::string confirming_point(const ReportInput& input, const Eigen::VectorXd& x);

namespace detail {

/// {"sentences", "x" or null, "row" of the front or -1, "simulated": [runs], "command": what simulates x or null,
/// "reference": {"name", "x", "means"} or null, "means" of all responses at x, "trust": one line, "cautions": how
/// many}.
nlohmann::json answer_json(const ReportInput& input);

/// "; the luckiest of 52 single runs, run 12, gave 880 kg/s (760 to 1000 with 95 %), where the model expects 764
/// kg/s in the mean": the best run of objective j within the limits; nothing where no run is good.
std::string luckiest_run(const ReportInput& input, std::size_t j);

}  // namespace detail
}  // namespace drawpoint::studies
