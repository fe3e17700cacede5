// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/export.h>
#include <drawpoint/studies/analysis/number_or_null.h>
#include <drawpoint/studies/models/front.h>
#include <drawpoint/studies/models/models.h>
#include <drawpoint/studies/models/tables.h>
#include <drawpoint/doe/detail/csv.hpp>

#include <cmath>

namespace drawpoint::studies {
namespace {

using nlohmann::json;

void append_numbers(std::vector<json>& row, const Eigen::VectorXd& values) {
  for (const double value : values) row.push_back(number_or_null(value));
}

/// A level by its name, which is what people set; numbers else.
void append_point(std::vector<json>& row, const doe::Problem& problem, const Eigen::VectorXd& x) {
  for (std::size_t k = 0; k < problem.variables.size(); ++k) {
    const doe::Variable& variable = problem.variables[k];
    const double value = x[static_cast<Eigen::Index>(k)];
    if (variable.levels.empty())
      row.push_back(number_or_null(value));
    else
      row.push_back(variable.levels.at(static_cast<std::size_t>(std::lround(value))));
  }
}

void append_variables(ExportTable& table, const doe::Problem& problem) {
  for (const auto& variable : problem.variables) table.columns.push_back({variable.name, variable.unit});
}

void append_responses(ExportTable& table, const doe::Problem& problem, const std::string& ending) {
  for (const auto& response : problem.responses)
    table.columns.push_back({response.name + ending, response.unit});
}

std::string csv_text(const json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return doe::detail::number_text(value.get<double>());
  return value.dump();
}

}  // namespace

ExportTable runs_table(const Identity& identity, const std::vector<Run>& runs) {
  ExportTable table{.columns = {{"run", ""},
                                {"kind", ""},
                                {"point", ""},
                                {"replicate", ""},
                                {"seed", ""},
                                {"status", ""},
                                {"reason", ""},
                                {"seconds", "s"}},
                    .rows = {}};
  append_variables(table, identity.problem);
  for (const char* ending : {"", "_predicted", "_lower", "_upper"})
    append_responses(table, identity.problem, ending);
  for (const Run& run : runs) {
    std::vector<json> row = {run.id,
                             name_of(run.kind),
                             run.point,
                             run.replicate,
                             std::to_string(run.seed),
                             name_of(run.status),
                             run.reason,
                             run.seconds};
    append_point(row, identity.problem, run.x);
    for (const auto* values : {&run.y, &run.predicted, &run.lower, &run.upper}) append_numbers(row, *values);
    table.rows.push_back(std::move(row));
  }
  return table;
}

ExportTable asked_table(const Identity& identity, const std::vector<Run>& runs) {
  ExportTable table{.columns = {{"run", ""}, {"kind", ""}, {"point", ""}, {"replicate", ""}, {"seed", ""}},
                    .rows = {}};
  append_variables(table, identity.problem);
  for (const Run& run : runs) {
    std::vector<json> row = {run.id, name_of(run.kind), run.point, run.replicate, std::to_string(run.seed)};
    append_point(row, identity.problem, run.x);
    table.rows.push_back(std::move(row));
  }
  return table;
}

ExportTable front_table(const Identity& identity, const std::vector<Run>& runs) {
  const doe::Problem& problem = identity.problem;
  const Tables tables = tables_of(runs, problem);
  const Models fitted = models_or_reason(tables);
  const PredictedFront predicted = predicted_front(fitted.models, tables, identity.seed);
  const pareto::Front& front = predicted.found.front;
  ExportTable table;
  append_variables(table, problem);
  for (const char* ending : {"", "_lower", "_upper"}) append_responses(table, problem, ending);
  table.columns.push_back({"success", "1"});
  if (front.X.rows() == 0) return table;
  const PlannedPoints points = with_predictions(fitted.models, problem, front.X);
  const Eigen::VectorXd success = predicted.failures.probability_of_success(front.X);
  for (Eigen::Index i = 0; i < front.X.rows(); ++i) {
    std::vector<json> row;
    append_point(row, problem, front.X.row(i));
    append_numbers(row, front.responses.row(i));
    append_numbers(row, points.lower.row(i));
    append_numbers(row, points.upper.row(i));
    row.push_back(number_or_null(success[i]));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string as_csv(const ExportTable& table) {
  doe::detail::CsvRecord record;
  for (const auto& [name, unit] : table.columns)
    record.push_back(unit.empty() ? name : name + " [" + unit + "]");
  std::string text = doe::detail::csv_line(record);
  for (const auto& row : table.rows) {
    record.clear();
    for (const json& value : row) record.push_back(csv_text(value));
    text += doe::detail::csv_line(record);
  }
  return text;
}

std::string as_json(const std::string& study, const ExportTable& table) {
  nlohmann::ordered_json data = {{"study", study}};
  data["columns"] = nlohmann::ordered_json::array();
  for (const auto& [name, unit] : table.columns) data["columns"].push_back({{"name", name}, {"unit", unit}});
  data["rows"] = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) data["rows"].push_back(row);
  return data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace drawpoint::studies
