// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/points/imported_points.h>
#include <drawpoint/studies/run/points/point_table.h>
#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/left_out.h>

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace drawpoint::studies {
namespace {

/// Columns of an imported table: those of the variables, the responses and, if there is one, the status.
struct ImportedColumns {
  std::vector<std::size_t> variables, responses;
  std::optional<std::size_t> status;
};

ImportedColumns imported_columns(const TableHeader& header, const doe::Problem& problem) {
  ImportedColumns columns;
  for (const auto& v : problem.variables) columns.variables.push_back(header.column(v.name, v.unit));
  for (const auto& r : problem.responses) columns.responses.push_back(header.column(r.name, r.unit));
  columns.status = header.find_bare("status");
  return columns;
}

Run run_from(const doe::detail::CsvRecord& record, const ImportedColumns& columns,
             const doe::Problem& problem, const TablePlace& place) {
  Run run;
  run.kind = Kind::imported;
  run.status = Status::done;
  run.x.resize(static_cast<Eigen::Index>(columns.variables.size()));
  run.y.resize(static_cast<Eigen::Index>(columns.responses.size()));
  for (std::size_t k = 0; k < columns.variables.size(); ++k)
    run.x[static_cast<Eigen::Index>(k)] =
        variable_from(record[columns.variables[k]], problem.variables[k], place);
  for (std::size_t k = 0; k < columns.responses.size(); ++k)
    run.y[static_cast<Eigen::Index>(k)] =
        response_from(record[columns.responses[k]], problem.responses[k], place);
  return run;
}

/// Point and values, by which a row is known again.
std::vector<double> key_of(const Run& run) {
  std::vector<double> key(run.x.begin(), run.x.end());
  key.insert(key.end(), run.y.begin(), run.y.end());
  return key;
}

/// With what stood there before it was corrected: the table may say so still.
std::set<std::vector<double>> keys_of_imported(const std::vector<Run>& runs,
                                               const std::vector<Correction>& corrections) {
  std::set<std::vector<double>> keys;
  for (const Run& run : runs)
    if (run.kind == Kind::imported) keys.insert(key_of(run));
  for (const Correction& c : corrections) {
    if (c.what != replace_word) continue;
    Run before = runs.at(static_cast<std::size_t>(c.run) - 1);
    if (before.kind != Kind::imported) continue;
    const std::vector<double> values = values_before(c);
    before.y = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    keys.insert(key_of(before));
  }
  return keys;
}

}  // namespace

std::vector<Run> imported_runs(const std::filesystem::path& file, const doe::Problem& problem,
                               const std::vector<Run>& existing, const std::vector<Correction>& corrections) {
  ImportedColumns columns;
  std::vector<Run> runs;
  const std::set<std::vector<double>> known = keys_of_imported(existing, corrections);
  const std::int64_t points = count_points(existing, Kind::imported);
  int rows = 0;
  const auto take = [&](const doe::detail::CsvRecord& record, const TablePlace& place) {
    if (columns.status) {
      check_status(record[*columns.status], place);
      if (record[*columns.status] != "done") return;
    }
    Run run = run_from(record, columns, problem, place);
    ++rows;
    if (known.contains(key_of(run))) return;
    run.id = static_cast<std::int64_t>(existing.size() + runs.size()) + 1;
    run.point = points + static_cast<std::int64_t>(runs.size()) + 1;
    runs.push_back(std::move(run));
  };
  const TablePlace end = read_table(
      file, "--import", [&](const TableHeader& header) { columns = imported_columns(header, problem); },
      take);
  if (rows == 0) end.fail("there is no row with a point");
  return runs;
}

}  // namespace drawpoint::studies
