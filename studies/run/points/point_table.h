// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tables of points and responses that people and other programs write, read with the place of every fault.
///
/// Comma-separated, the first line with names, "speed" or "speed [m/s]", none of them twice; columns of other
/// names are left alone. Every row is as long as the first line: decimal commas make it longer.

#include <drawpoint/doe/detail/csv.hpp>
#include <drawpoint/doe/problem.hpp>

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace drawpoint::studies {

/// Where in which table, for messages. `option` is how the command line names it, such as "--import".
struct TablePlace {
  std::string option, file;
  int line = 1;

  /// Throws UsageError.
  [[noreturn]] void fail(const std::string& what) const;
};

/// The first line of a table.
class TableHeader {
 public:
  /// Throws UsageError for a name that stands there twice.
  TableHeader(doe::detail::CsvRecord names, TablePlace place);

  /// The quantity's column, named with its unit or, where there is no such, by its bare name; nothing where
  /// there is none. Throws UsageError where it is in another unit, or stands there twice.
  std::optional<std::size_t> find(const std::string& name, const std::string& unit) const;
  /// Throws UsageError where there is none.
  std::size_t column(const std::string& name, const std::string& unit) const;
  /// What is no quantity of the study, such as "status": by its bare name alone.
  std::optional<std::size_t> find_bare(const std::string& name) const;
  /// Throws UsageError with the place of the first line.
  [[noreturn]] void fail(const std::string& what) const { place_.fail(what); }

 private:
  doe::detail::CsvRecord names_;
  TablePlace place_;
};

/// Calls first(header) once and row(record, place) for every line that is not empty. Throws UsageError where
/// the file cannot be read, is no table, or has no line of names. Returns the end of the table.
TablePlace read_table(const std::filesystem::path& file, const std::string& option,
                      const std::function<void(const TableHeader&)>& first,
                      const std::function<void(const doe::detail::CsvRecord&, const TablePlace&)>& row);

/// The points of a table, one row each (n x d). Throws UsageError as read_table, for a column that is missing, for what
/// is no value of its variable, and for a table without rows.
Eigen::MatrixXd points_of_table(const std::filesystem::path& file, const std::string& option,
                                const doe::Problem& problem);

// Fields of a row. They throw UsageError with the place for what cannot be.

double number_from(const std::string& text, const std::string& name, const TablePlace& place);
/// A categorical variable has the name of a level or its number, from 0.
/// The same, whatever the box of the study.
double level_or_number_from(const std::string& text, const doe::Variable& variable, const TablePlace& place);
double variable_from(const std::string& text, const doe::Variable& variable, const TablePlace& place);
double response_from(const std::string& text, const doe::Response& response, const TablePlace& place);

/// Throws UsageError where a column "status" says what no table of a study does.
void check_status(const std::string& text, const TablePlace& place);

}  // namespace drawpoint::studies
