// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/tables.h>
#include <drawpoint/studies/say/findings.h>

#include <drawpoint/studies/run/logged_runs.h>
#include <drawpoint/studies/say/report_input.h>

#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::studies {
namespace {

Eigen::MatrixXd responses_of(const doe::Evaluations& table) {
  Eigen::MatrixXd Y(table.X().rows(), static_cast<Eigen::Index>(table.problem.responses.size()));
  for (Eigen::Index j = 0; j < Y.cols(); ++j)
    Y.col(j) = table.y(table.problem.responses[static_cast<std::size_t>(j)].name);
  return Y;
}

/// Adaptive runs and confirmed points crowd where the study looked; what is claimed is claimed of the whole box.
doe::Evaluations first_design_of(const ReportInput& input) {
  doe::Evaluations table{.problem = input.problem, .rows = {}};
  for (const auto& row : input.training.rows) {
    const auto kind = input.kinds.find(row.run);
    if (kind == input.kinds.end() || kind->second == name_of(Kind::training)) table.rows.push_back(row);
  }
  return table;
}

/// Row by row of X().
std::vector<std::filesystem::path> logs_of(const doe::Evaluations& table,
                                           const std::vector<const Run*>& logged, const Folder& folder) {
  std::set<std::int64_t> with_log;
  for (const Run* run : logged) with_log.insert(run->id);
  std::vector<std::filesystem::path> logs;
  for (const std::int64_t run : runs_with_values(table))
    logs.push_back(with_log.contains(run) ? folder.log(run) : std::filesystem::path());
  return logs;
}

StudyResults results_of(const ReportInput& input, const std::vector<const Run*>& logged,
                        const OptionValues& options, const Folder& folder) {
  const doe::Evaluations training = first_design_of(input);
  StudyResults results{.problem = as_asked(input.problem, input.flat),
                       .X = training.X(),
                       .Y = responses_of(training),
                       .X_new = input.validation.X(),
                       .Y_new = responses_of(input.validation),
                       .logs = logs_of(training, logged, folder),
                       .nrmse = {},
                       .logs_new = logs_of(input.validation, logged, folder),
                       .options = options};
  constexpr double ends_apart = 2 * 1.96;  // of an interval of 95 %, in standard errors
  for (const auto& error : input.mean_errors) {
    results.nrmse.push_back(error.nrmse());
    results.nrmse_error.push_back(error.share(error.upper - error.lower) / ends_apart);
  }
  return results;
}

}  // namespace

std::vector<Finding> hold_findings(ReportInput& input, const Study& study,
                                   const std::vector<const Run*>& logged, const OptionValues& options,
                                   const Folder& folder) {
  if (!study.presentation.findings) return {};
  try {
    return input.findings = study.presentation.findings(results_of(input, logged, options, folder));
  } catch (const std::exception& e) {
    input.warnings.push_back(std::string("The findings could not be held against the runs: ") + e.what());
    return {};
  }
}

ExportTable findings_table(const Study& study, const Store& store, const Folder& folder) {
  const std::vector<Run> runs = store.runs();
  const ReportInput input = input_with_models(study, store, runs, "findings");
  const OptionValues& options = store.identity().options;
  std::vector<std::string> of_logs;  // what is wrong with some, which the report says
  const std::vector<const Run*> logged = runs_with_log(study, store.identity(), runs, folder, of_logs);
  ExportTable table{.columns = {{"finding", "", ColumnType::text, "its name"},
                                {"claim", "", ColumnType::text, "in a sentence"},
                                {"verdict", "", ColumnType::text, "reproduced, not reproduced or unclear"},
                                {"grounds", "", ColumnType::text, "what decided, or why nothing could"}},
                    .rows = {}};
  for (const Finding& f : study.presentation.findings(results_of(input, logged, options, folder)))
    table.rows.push_back({f.id, f.claim, to_string(f.verdict), f.grounds});
  return table;
}

}  // namespace drawpoint::studies
