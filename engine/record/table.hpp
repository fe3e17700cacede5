// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// A table of numbers with named columns and units, grown row by row: the form of every signal in a run log.
namespace drawpoint::engine::record {

struct Column {
  std::string name, unit;
  std::string description = {};  ///< what it is and in which axes, for people
};

struct Table {
  std::vector<Column> columns;
  std::vector<double> values;  ///< row-major, rows() × columns.size()

  /// Throws std::invalid_argument unless the row has one value per column.
  void append_row(std::span<const double> row);

  std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  bool has(std::string_view name) const;
  /// Throws std::invalid_argument, listing what there is, if no column has this name.
  std::size_t index(std::string_view name) const;
  std::vector<double> column(std::string_view name) const;
  double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
};

}  // namespace drawpoint::engine::record
