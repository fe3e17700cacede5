// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/runs/imported_points.h>
#include <drawpoint/studies/runs/plan.h>
#include <drawpoint/studies/runs/settings.h>
#include <drawpoint/doe/detail/csv.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>

namespace drawpoint::studies {
namespace {

using doe::detail::CsvRecord;

/// A table that was read, for messages.
struct Place {
  std::string file;
  int line = 1;

  [[noreturn]] void fail(const std::string& what) const {
    throw UsageError("--import " + file + ", line " + std::to_string(line) + ": " + what);
  }
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad() || std::filesystem::is_directory(file))
    throw UsageError("--import " + file.string() + ": cannot be read; give a table as export writes it");
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);  // a byte order mark, as spreadsheets write it
  if (!text.empty() && text.back() != '\n') text += '\n';
  return text;
}

/// Where the quantity stands in the header; nothing where it does not.
std::optional<std::size_t> column_of(const CsvRecord& header, const std::string& name,
                                     const std::string& unit, const Place& place) {
  for (std::size_t k = 0; k < header.size(); ++k) {
    if (header[k] == name) return k;
    if (header[k].rfind(name + " [", 0) != 0 || header[k].back() != ']') continue;
    if (header[k] != name + " [" + unit + "]")
      place.fail("the column \"" + header[k] + "\" is not in " + unit + "; convert it");
    return k;
  }
  return std::nullopt;
}

std::vector<std::size_t> columns_of(const CsvRecord& header, const doe::Problem& problem,
                                    const Place& place) {
  std::vector<std::size_t> columns;
  const auto claim = [&](const std::string& name, const std::string& unit) {
    const auto column = column_of(header, name, unit, place);
    if (!column) place.fail("there is no column \"" + name + "\"; name one so in the first line");
    columns.push_back(*column);
  };
  for (const auto& variable : problem.variables) claim(variable.name, variable.unit);
  for (const auto& response : problem.responses) claim(response.name, response.unit);
  return columns;
}

double number_from(const std::string& text, const std::string& name, const Place& place) {
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || end.ec != std::errc() || end.ptr != text.data() + text.size() || !std::isfinite(value))
    place.fail("\"" + text + "\" is no number for \"" + name + "\"; give one, or leave the row out");
  return value;
}

double variable_from(const std::string& text, const doe::Variable& variable, const Place& place) {
  const auto level = std::find(variable.levels.begin(), variable.levels.end(), text);
  if (level != variable.levels.end()) return static_cast<double>(level - variable.levels.begin());
  const double value = number_from(text, variable.name, place);
  const bool whole = variable.kind == doe::VariableKind::real || value == std::round(value);
  if (value < variable.lower || value > variable.upper || !whole)
    place.fail("\"" + variable.name + "\" is " + doe::detail::with_unit(value, variable.unit) +
               "; allowed are " + (variable.kind == doe::VariableKind::real ? "" : "whole numbers from ") +
               doe::detail::number_text(variable.lower) + " to " +
               doe::detail::with_unit(variable.upper, variable.unit) + ", the box of the study");
  return value;
}

double response_from(const std::string& text, const doe::Response& response, const Place& place) {
  const double value = number_from(text, response.name, place);
  if (value < response.lower || value > response.upper)
    place.fail("\"" + response.name + "\" is " + doe::detail::with_unit(value, response.unit) +
               ", which lies outside of its range");
  return value;
}

Run run_from(const CsvRecord& record, const std::vector<std::size_t>& columns, const doe::Problem& problem,
             const Place& place) {
  const std::size_t d = problem.variables.size();
  Run run;
  run.kind = Kind::imported;
  run.status = Status::done;
  run.x.resize(static_cast<Eigen::Index>(d));
  run.y.resize(static_cast<Eigen::Index>(problem.responses.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k] >= record.size())
      place.fail("it has " + std::to_string(record.size()) + " fields, fewer than the first line");
    const std::string& text = record[columns[k]];
    if (k < d)
      run.x[static_cast<Eigen::Index>(k)] = variable_from(text, problem.variables[k], place);
    else
      run.y[static_cast<Eigen::Index>(k - d)] = response_from(text, problem.responses[k - d], place);
  }
  return run;
}

bool is_among(const Run& run, const std::vector<Run>& runs) {
  return std::any_of(runs.begin(), runs.end(), [&](const Run& other) {
    return other.kind == Kind::imported && other.x == run.x && other.y == run.y;
  });
}

}  // namespace

std::vector<Run> imported_runs(const std::filesystem::path& file, const doe::Problem& problem,
                               const std::vector<Run>& existing) {
  const std::string text = text_of(file);
  Place place{.file = file.string()};
  doe::detail::CsvReader reader(text);
  const auto header = reader.next();
  if (!header) place.fail("there is no first line with the names of variables and responses");
  const std::vector<std::size_t> columns = columns_of(*header, problem, place);
  const auto status = column_of(*header, "status", "", place);
  std::vector<Run> runs;
  int rows = 0;
  while (const auto record = reader.next()) {
    place.line = reader.line();
    if (record->size() == 1 && record->front().empty()) continue;  // an empty line
    if (status && *status < record->size() && (*record)[*status] != "done") continue;
    Run run = run_from(*record, columns, problem, place);
    ++rows;
    if (is_among(run, existing)) continue;
    run.id = static_cast<std::int64_t>(existing.size() + runs.size()) + 1;
    run.point = count_points(existing, Kind::imported) + static_cast<std::int64_t>(runs.size()) + 1;
    runs.push_back(std::move(run));
  }
  place.line = reader.line();
  if (!reader.fault().empty()) place.fail(reader.fault());
  if (rows == 0) place.fail("there is no row with a point");
  return runs;
}

}  // namespace drawpoint::studies
