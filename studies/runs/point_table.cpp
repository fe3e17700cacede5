// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/runs/point_table.h>
#include <drawpoint/studies/runs/settings.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
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

}  // namespace

void TablePlace::fail(const std::string& what) const {
  throw UsageError(option + " " + file + ", line " + std::to_string(line) + ": " + what);
}

std::optional<std::size_t> TableHeader::find_bare(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) return std::nullopt;
  if (std::find(found + 1, names_.end(), name) != names_.end())
    place_.fail("the column \"" + name + "\" stands there twice; remove one");
  return static_cast<std::size_t>(found - names_.begin());
}

std::optional<std::size_t> TableHeader::find(const std::string& name, const std::string& unit) const {
  const std::string whole = name + " [" + unit + "]";
  if (const auto with_unit = find_bare(whole)) return with_unit;
  if (const auto bare = find_bare(name)) return bare;
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
    row(*record, place);
  }
  place.line = reader.line();
  if (!reader.fault().empty()) place.fail(reader.fault());
  return place;
}

const std::string& field_of(const doe::detail::CsvRecord& record, std::size_t column,
                            const TablePlace& place) {
  if (column >= record.size())
    place.fail("it has " + std::to_string(record.size()) + " fields, fewer than the first line");
  return record[column];
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
  const double value = number_from(text, response.name, place);
  if (value < response.lower || value > response.upper)
    place.fail("\"" + response.name + "\" is " + doe::detail::with_unit(value, response.unit) +
               ", which lies outside of its range");
  return value;
}

}  // namespace drawpoint::studies
