// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/counts.h>
#include <drawpoint/studies/run/points/point_table.h>
#include <drawpoint/studies/run/settings.h>
#include <drawpoint/doe/detail/round_off.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

namespace drawpoint::studies {
namespace {

std::string text_of(const std::filesystem::path& file, const std::string& option) {
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(file, ignored);  // reading one throws
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  if (!folder) text.assign(std::istreambuf_iterator<char>(stream), {});
  if (folder || !stream.is_open() || stream.bad())
    throw UsageError(option + " " + file.string() + ": cannot be read; give a table as export writes it");
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);  // a byte order mark, as spreadsheets write it
  if (!text.empty() && text.back() != '\n') text += '\n';
  return text;
}

bool is_blank(const std::string& text) { return text.find_first_not_of(" \t") == text.npos; }

/// A quantity may have the name of a column that ask and export give.
bool is_of_ask(const std::string& name) {
  static const std::set<std::string> columns = {"run",  "kind",   "point",  "replicate",
                                                "seed", "status", "reason", "seconds"};
  return columns.contains(name);
}

}  // namespace

TableHeader::TableHeader(doe::detail::CsvRecord names, TablePlace place)
    : names_(std::move(names)), place_(std::move(place)) {
  std::set<std::string> seen;
  for (const std::string& name : names_)
    if (!name.empty() && !seen.insert(name).second)
      place_.fail("the column \"" + name + "\" stands there twice; remove one");
}

void TablePlace::fail(const std::string& what) const {
  throw UsageError(option + " " + file + ", line " + std::to_string(line) + ": " + what);
}

std::optional<std::size_t> TableHeader::find_bare(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names_.begin());
}

std::optional<std::size_t> TableHeader::find(const std::string& name, const std::string& unit) const {
  const std::string whole = name + " [" + unit + "]";
  const auto with_unit = find_bare(whole), bare = find_bare(name);
  if (with_unit && bare && !is_of_ask(name))
    place_.fail("the columns \"" + name + "\" and \"" + whole + "\" are of one quantity; remove one");
  if (with_unit || bare) return with_unit ? with_unit : bare;
  for (const std::string& other : names_)
    if (other.rfind(name + " [", 0) == 0 && other.back() == ']')
      place_.fail("the column \"" + other + "\" is not in " + (unit.empty() ? "pure numbers" : unit) +
                  "; convert it");
  return std::nullopt;
}

std::size_t TableHeader::column(const std::string& name, const std::string& unit) const {
  const auto found = find(name, unit);
  if (!found) place_.fail("there is no column \"" + name + "\"; name one so in the first line");
  return *found;
}

TablePlace read_table(const std::filesystem::path& file, const std::string& option,
                      const std::function<void(const TableHeader&)>& first,
                      const std::function<void(const doe::detail::CsvRecord&, const TablePlace&)>& row) {
  const std::string text = text_of(file, option);
  TablePlace place{.option = option, .file = file.string()};
  doe::detail::CsvReader reader(text);
  const auto header = reader.next();
  if (!header) place.fail("there is no first line with the names of variables and responses");
  first(TableHeader(*header, place));
  while (const auto record = reader.next()) {
    place.line = reader.line();
    if (record->size() == 1 && record->front().empty()) continue;  // an empty line
    if (record->size() != header->size())
      place.fail("it has " + std::to_string(record->size()) + " fields, and the first line has " +
                 std::to_string(header->size()) +
                 "; numbers take a decimal point, and a text with a comma stands in quotes");
    // The first column may hold names of rows, as pandas and R write them.
    for (std::size_t k = 1; k < record->size(); ++k)
      if (is_blank((*header)[k]) && !is_blank((*record)[k]))
        place.fail("\"" + (*record)[k] +
                   "\" stands under no name; name the column, or empty it: numbers take a decimal point");
    row(*record, place);
  }
  place.line = reader.line();
  if (!reader.fault().empty()) place.fail(reader.fault());
  return place;
}

Eigen::MatrixXd points_of_table(const std::filesystem::path& file, const std::string& option,
                                const doe::Problem& problem) {
  std::vector<std::size_t> columns;
  std::vector<double> values;
  const auto first = [&](const TableHeader& header) {
    for (const doe::Variable& v : problem.variables) columns.push_back(header.column(v.name, v.unit));
  };
  const auto row = [&](const doe::detail::CsvRecord& record, const TablePlace& place) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      values.push_back(variable_from(record[columns[k]], problem.variables[k], place));
  };
  const TablePlace end = read_table(file, option, first, row);
  if (values.empty()) end.fail("the table has no rows; give one per point");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto d = static_cast<Eigen::Index>(columns.size());
  return Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(values.size()) / d, d);
}

double number_from(const std::string& text, const std::string& name, const TablePlace& place) {
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || end.ec != std::errc() || end.ptr != text.data() + text.size() || !std::isfinite(value))
    place.fail("\"" + text + "\" is no number for \"" + name + "\"; give one, or leave the row out");
  return value;
}

double level_or_number_from(const std::string& text, const doe::Variable& variable, const TablePlace& place) {
  const auto level = std::find(variable.levels.begin(), variable.levels.end(), text);
  if (level != variable.levels.end()) return static_cast<double>(level - variable.levels.begin());
  return number_from(text, variable.name, place);
}

double variable_from(const std::string& text, const doe::Variable& variable, const TablePlace& place) {
  const double value = level_or_number_from(text, variable, place);
  const bool whole = variable.kind == doe::VariableKind::real || value == std::round(value);
  if (value < variable.lower || value > variable.upper || !whole)
    place.fail("\"" + variable.name + "\" is " + doe::detail::with_unit(value, variable.unit) +
               "; allowed are " + (variable.kind == doe::VariableKind::real ? "" : "whole numbers from ") +
               doe::detail::number_text(variable.lower) + " to " +
               doe::detail::with_unit(variable.upper, variable.unit) + ", the box of the study");
  return value;
}

double response_from(const std::string& text, const doe::Response& response, const TablePlace& place) {
  const double value = doe::detail::without_round_off(response, number_from(text, response.name, place));
  if (value < response.lower || value > response.upper)
    place.fail("\"" + response.name + "\" is " + doe::detail::with_unit(value, response.unit) +
               ", which lies outside of its range");
  return value;
}

void check_status(const std::string& text, const TablePlace& place) {
  const auto is_this = [&](Status status) { return name_of(status) == text; };
  if (!text.empty() && std::none_of(all_states.begin(), all_states.end(), is_this))
    place.fail("\"status\" is \"" + text + "\"; allowed are done, failed, planned and running");
}

}  // namespace drawpoint::studies
