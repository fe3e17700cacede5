// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/tables.h>
#include <drawpoint/studies/model/fronts/front.h>
#include <drawpoint/studies/model/fronts/front_uncertainty.h>
#include <drawpoint/studies/say/export.h>
#include <drawpoint/studies/say/number_or_null.h>
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
  for (const auto& variable : problem.variables)
    table.columns.push_back({variable.name, variable.unit,
                             variable.levels.empty() ? ColumnType::number : ColumnType::text,
                             variable.description.empty() ? "variable" : variable.description});
}

void append_responses(ExportTable& table, const doe::Problem& problem, const std::string& ending,
                      const std::string& description) {
  for (const auto& response : problem.responses)
    table.columns.push_back({response.name + ending, response.unit, ColumnType::number, description});
}

void append_simulated(ExportTable& table, const doe::Problem& problem) {
  for (const auto& response : problem.responses)
    table.columns.push_back({response.name, response.unit, ColumnType::number,
                             response.description.empty() ? "response" : response.description});
}

constexpr const char* lower_end = "lower end of the interval that should hold 95 of 100 such runs";
constexpr const char* upper_end = "upper end of the interval that should hold 95 of 100 such runs";

/// What names a run, in both tables of runs.
std::vector<ExportColumn> run_columns() {
  return {{"run", "", ColumnType::whole, "number of the run"},
          {"kind", "", ColumnType::text, "training, adaptive, confirmation, imported or validation"},
          {"point", "", ColumnType::whole, "number of the point within its kind, from 1"},
          {"replicate", "", ColumnType::whole, "number of the run at that point, from 0"},
          {"seed", "", ColumnType::text, "of the run, 64 bits without sign"}};
}

std::vector<json> run_values(const Run& run) {
  return {run.id, name_of(run.kind), run.point, run.replicate, std::to_string(run.seed)};
}

/// Standard errors of the expected responses at the rows of X, the noise of a run left out (n x responses).
Eigen::MatrixXd standard_errors(const std::vector<kriging::TransformedModel>& models,
                                const Eigen::MatrixXd& X) {
  Eigen::MatrixXd errors(X.rows(), static_cast<Eigen::Index>(models.size()));
  for (std::size_t j = 0; j < models.size(); ++j)
    errors.col(static_cast<Eigen::Index>(j)) = models[j].predict(X).variance.cwiseMax(0.0).cwiseSqrt();
  return errors;
}

/// Ending of the columns that hold standard_errors; not "_standard_error" where a response has such a name.
const char* ending_of_errors(const doe::Problem& problem) {
  for (const doe::Response& a : problem.responses)
    for (const doe::Response& b : problem.responses)
      if (b.name == a.name + "_standard_error") return "_error_of_mean";
  return "_standard_error";
}

void append_expected_columns(ExportTable& table, const doe::Problem& problem) {
  append_variables(table, problem);
  append_responses(table, problem, "", "what the models expect of a run");
  append_responses(table, problem, "_lower", lower_end);
  append_responses(table, problem, "_upper", upper_end);
  append_responses(table, problem, ending_of_errors(problem),
                   "standard error of what the models expect, noise left out");
}

ExportColumn success_column() {
  return {"success", "1", ColumnType::number, "probability that a run succeeds"};
}

/// Holds what the models expect at points, and gives the columns of append_expected_columns.
class Expected {
 public:
  Expected(const std::vector<kriging::TransformedModel>& models, const doe::Problem& problem,
           const Eigen::MatrixXd& X)
      : problem_(problem),
        points_(with_predictions(models, problem, X)),
        errors_(standard_errors(models, X)) {}

  std::vector<json> row(Eigen::Index i) const {
    std::vector<json> row;
    append_point(row, problem_, points_.X.row(i));
    for (const Eigen::MatrixXd* values : {&points_.predicted, &points_.lower, &points_.upper, &errors_})
      append_numbers(row, values->row(i));
    return row;
  }

 private:
  const doe::Problem& problem_;
  PlannedPoints points_;
  Eigen::MatrixXd errors_;
};

std::string csv_text(const json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return doe::detail::number_text(value.get<double>());
  return value.dump();
}

}  // namespace

ExportTable runs_table(const Identity& identity, const std::vector<Run>& runs) {
  ExportTable table{.columns = run_columns(), .rows = {}};
  table.columns.push_back({"status", "", ColumnType::text, "planned, running, done or failed"});
  table.columns.push_back({"reason", "", ColumnType::text, "why the run failed"});
  table.columns.push_back({"seconds", "s", ColumnType::number, "wall time of the run"});
  append_variables(table, identity.problem);
  append_simulated(table, identity.problem);
  append_responses(table, identity.problem, "_predicted", "what the models before the run expected of it");
  append_responses(table, identity.problem, "_lower", lower_end);
  append_responses(table, identity.problem, "_upper", upper_end);
  for (const Run& run : runs) {
    std::vector<json> row = run_values(run);
    row.insert(row.end(), {name_of(run.status), run.reason, run.seconds});
    append_point(row, identity.problem, run.x);
    for (const auto* values : {&run.y, &run.predicted, &run.lower, &run.upper}) append_numbers(row, *values);
    table.rows.push_back(std::move(row));
  }
  return table;
}

ExportTable asked_table(const Identity& identity, const std::vector<Run>& runs) {
  ExportTable table{.columns = run_columns(), .rows = {}};
  append_variables(table, identity.problem);
  for (const Run& run : runs) {
    std::vector<json> row = run_values(run);
    append_point(row, identity.problem, run.x);
    table.rows.push_back(std::move(row));
  }
  return table;
}

ExportTable front_table(const Identity& identity, const std::vector<Run>& runs, std::string* missing) {
  const doe::Problem& problem = identity.problem;
  const Tables tables = tables_of(runs, problem);
  const Models fitted = models_or_reason(tables);
  const PredictedFront predicted = predicted_front(fitted.models, tables, identity.seed);
  const pareto::Front& front = predicted.found.front;
  ExportTable table;
  append_expected_columns(table, problem);
  table.columns.push_back(
      {"non_dominated", "1", ColumnType::number,
       "probability that the mean keeps every limit while no other point of the front is at "
       "least as good in all objectives and better in one"});
  table.columns.push_back(success_column());
  if (missing) *missing = predicted.missing;
  if (front.X.rows() == 0) return table;
  const Expected expected(fitted.models, problem, front.X);
  const Eigen::VectorXd on_front =
      uncertainty_of(front, fitted.models, predicted.problem, identity.seed).non_dominated;
  const Eigen::VectorXd success = predicted.failures.probability_of_success(front.X);
  for (Eigen::Index i = 0; i < front.X.rows(); ++i) {
    std::vector<json> row = expected.row(i);
    row.push_back(on_front.size() > 0 ? json(on_front[i]) : json());
    row.push_back(number_or_null(success[i]));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ExportTable predictions_table(const Identity& identity, const std::vector<Run>& runs,
                              const Eigen::MatrixXd& X) {
  const Tables tables = tables_of(runs, identity.problem);
  const Expected expected(models_or_reason(tables).models, identity.problem, X);
  const Eigen::VectorXd success = Failures(tables).probability_of_success(X);
  ExportTable table;
  append_expected_columns(table, identity.problem);
  table.columns.push_back(success_column());
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    table.rows.push_back(expected.row(i));
    table.rows.back().push_back(number_or_null(success[i]));
  }
  return table;
}

ExportTable variables_table(const doe::Problem& problem) {
  ExportTable table{.columns = {{"name", "", ColumnType::text, "of each variable"},
                                {"unit", "", ColumnType::text, "of its values and bounds"},
                                {"lower", "", ColumnType::number, "lower bound, in the variable's unit"},
                                {"upper", "", ColumnType::number, "upper bound, in the variable's unit"},
                                {"kind", "", ColumnType::text, "real, integer or categorical"},
                                {"description", "", ColumnType::text, "what it is"}},
                    .rows = {}};
  for (const doe::Variable& v : problem.variables)
    table.rows.push_back({v.name, v.unit, v.lower, v.upper, to_string(v.kind), v.description});
  return table;
}

ExportTable responses_table(const doe::Problem& problem) {
  ExportTable table{
      .columns = {{"name", "", ColumnType::text, "of each response"},
                  {"unit", "", ColumnType::text, "of its values, bounds and limit"},
                  {"goal", "", ColumnType::text, "minimize, maximize, at_most, at_least or record"},
                  {"limit", "", ColumnType::number, "of at_most and at_least, in the response's unit"},
                  {"lower", "", ColumnType::number, "no value lies below, in the response's unit"},
                  {"upper", "", ColumnType::number, "no value lies above, in the response's unit"},
                  {"description", "", ColumnType::text, "what it is"},
                  {"standard_error", "", ColumnType::text, "name of the response that tells its noise"},
                  {"standard_error_freedom", "", ColumnType::number,
                   "its degrees of freedom, 0 where unknown"}},
      .rows = {}};
  for (const doe::Response& r : problem.responses)
    table.rows.push_back({r.name, r.unit, to_string(r.goal), r.limit, r.lower, r.upper, r.description,
                          r.standard_error, r.standard_error_freedom});
  return table;
}

std::string as_csv(const ExportTable& table) {
  doe::detail::CsvRecord record;
  for (const ExportColumn& column : table.columns)
    record.push_back(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
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
  for (const ExportColumn& column : table.columns)
    data["columns"].push_back({{"name", column.name}, {"unit", column.unit}});
  data["rows"] = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) data["rows"].push_back(row);
  return data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace drawpoint::studies
