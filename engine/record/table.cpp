// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/record/table.hpp>
#include <stdexcept>

namespace drawpoint::engine::record {
namespace {

std::string listing(const std::vector<Column>& columns) {
  std::string names;
  for (const Column& column : columns) names += (names.empty() ? "" : ", ") + column.name;
  return names.empty() ? "none" : names;
}

}  // namespace

void Table::append_row(std::span<const double> row) {
  if (row.size() != columns.size())
    throw std::invalid_argument("record::Table: a row of " + std::to_string(row.size()) + " values for " +
                                std::to_string(columns.size()) + " columns; give one value per column");
  values.insert(values.end(), row.begin(), row.end());
}

bool Table::has(std::string_view name) const {
  for (const Column& column : columns)
    if (column.name == name) return true;
  return false;
}

std::size_t Table::index(std::string_view name) const {
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (columns[k].name == name) return k;
  throw std::invalid_argument("record::Table: no column \"" + std::string(name) +
                              "\"; there are: " + listing(columns));
}

std::vector<double> Table::column(std::string_view name) const {
  const std::size_t k = index(name);
  std::vector<double> result;
  result.reserve(rows());
  for (std::size_t row = 0; row < rows(); ++row) result.push_back(at(row, k));
  return result;
}

}  // namespace drawpoint::engine::record
