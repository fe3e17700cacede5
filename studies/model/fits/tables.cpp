// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/tables.h>
#include <drawpoint/studies/model/fits/thinning.h>

namespace drawpoint::studies {
namespace {

doe::Outcome stored_outcome(const Run& run) {
  if (run.status == Status::failed) return doe::Failure{run.reason};
  return run.y;
}

}  // namespace

Tables tables_of(const std::vector<Run>& runs, const doe::Problem& problem) {
  Tables tables{.training = {.problem = problem, .rows = {}}, .validation = {.problem = problem, .rows = {}}};
  for (const auto& run : runs) {
    if (!has_ended(run) || run.left_out) continue;
    auto& table = run.kind == Kind::validation ? tables.validation : tables.training;
    table.rows.push_back({run.id, run.replicate, run.seed, run.x, stored_outcome(run), run.seconds});
  }
  const std::size_t training = tables.training.rows.size(), validation = tables.validation.rows.size();
  for (doe::Evaluations* table : {&tables.training, &tables.validation}) thin(*table, runs);
  for (const std::string& text : {thinned_text(training, tables.training.rows.size(), "training"),
                                  thinned_text(validation, tables.validation.rows.size(), "validation")})
    if (!text.empty()) tables.thinned.push_back(text);
  return tables;
}

std::vector<std::int64_t> runs_with_values(const doe::Evaluations& table) {
  std::vector<std::int64_t> runs;
  for (const auto& row : table.rows)
    if (!row.outcome.failed()) runs.push_back(row.run);
  return runs;
}

}  // namespace drawpoint::studies
