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
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad() || std::filesystem::is_directory(file))
    throw UsageError(option + " " + file.string() + ": cannot be read; give a table as export writes it");
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);  // a byte order mark, as spreadsheets write it
  if (!text.empty() && text.back() != '\n') text += '\n';
  return text;
}

}  // namespace

void TablePlace::fail(const std::string& what) const {
  throw UsageError(option + " " + file + ", line " + std::to_string(line) + ": " + what);
}

std::optional<std::size_t> TableHeader::find(const std::string& name, const std::string& unit) const {
  for (std::size_t k = 0; k < names_.size(); ++k) {
    if (names_[k] == name) return k;
    if (names_[k].rfind(name + " [", 0) != 0 || names_[k].back() != ']') continue;
    if (names_[k] != name + " [" + unit + "]")
      place_.fail("the column \"" + names_[k] + "\" is not in " + unit + "; convert it");
    return k;
  }
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

double variable_from(const std::string& text, const doe::Variable& variable, const TablePlace& place) {
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

double response_from(const std::string& text, const doe::Response& response, const TablePlace& place) {
  const double value = number_from(text, response.name, place);
  if (value < response.lower || value > response.upper)
    place.fail("\"" + response.name + "\" is " + doe::detail::with_unit(value, response.unit) +
               ", which lies outside of its range");
  return value;
}

}  // namespace drawpoint::studies
