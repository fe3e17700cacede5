// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/findings.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace drawpoint::studies {
namespace {

Eigen::MatrixXd responses_of(const doe::Evaluations& table) {
  Eigen::MatrixXd Y(table.X().rows(), static_cast<Eigen::Index>(table.problem.responses.size()));
  for (Eigen::Index j = 0; j < Y.cols(); ++j)
    Y.col(j) = table.y(table.problem.responses[static_cast<std::size_t>(j)].name);
  return Y;
}

StudyResults results_of(const ReportInput& input, const Folder& folder) {
  StudyResults results{.problem = input.problem,
                       .X = input.training.X(),
                       .Y = responses_of(input.training),
                       .X_new = input.validation.X(),
                       .Y_new = responses_of(input.validation),
                       .logs = {},
                       .nrmse = {}};
  for (const auto& row : input.training.rows) {
    if (row.outcome.failed()) continue;
    const std::filesystem::path log = folder.log(row.run);
    results.logs.push_back(std::filesystem::exists(log) ? log : std::filesystem::path());
  }
  for (const auto& validation : input.validations) results.nrmse.push_back(validation.nrmse);
  return results;
}

nlohmann::json panel_of(const std::vector<Finding>& findings) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Finding& f : findings) rows.push_back({f.id, f.claim, to_string(f.verdict), f.grounds});
  return {
      {"type", "table"},
      {"title", "Findings held against the runs"},
      {"caption",
       "Of all runs of the study, not of one. What decides is given with two standard errors; unclear: the "
       "runs do not tell."},
      {"columns", {"finding", "claim", "verdict", "grounds"}},
      {"rows", std::move(rows)}};
}

}  // namespace

std::vector<Finding> hold_findings(ReportInput& input, const Study& study, const Folder& folder) {
  if (!study.findings) return {};
  try {
    std::vector<Finding> findings = study.findings(results_of(input, folder));
    if (!findings.empty()) input.illustrations.insert(input.illustrations.begin(), panel_of(findings));
    return findings;
  } catch (const std::exception& e) {
    input.warnings.push_back(std::string("The findings could not be held against the runs: ") + e.what());
    return {};
  }
}

}  // namespace drawpoint::studies
