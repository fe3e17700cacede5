// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <SQLiteCpp/SQLiteCpp.h>
#include <drawpoint/studies/run/store/rows.h>

#include <charconv>
#include <limits>
#include <system_error>

namespace drawpoint::studies {

std::string name_of(Kind kind) {
  switch (kind) {
    case Kind::adaptive:
      return "adaptive";
    case Kind::confirmation:
      return "confirmation";
    case Kind::imported:
      return "imported";
    case Kind::validation:
      return "validation";
    default:
      return "training";
  }
}

std::string name_of(Status status) {
  switch (status) {
    case Status::running:
      return "running";
    case Status::done:
      return "done";
    case Status::failed:
      return "failed";
    default:
      return "planned";
  }
}

namespace detail {
namespace {

Kind kind_from(const std::string& name) {
  for (const Kind kind : all_kinds) {
    if (name == name_of(kind)) return kind;
  }
  return Kind::training;
}

Status status_from(const std::string& name) {
  for (const Status status : {Status::running, Status::done, Status::failed}) {
    if (name == name_of(status)) return status;
  }
  return Status::planned;
}

/// 0 for what is no number, which the checksum then shows.
doe::Seed seed_from(const std::string& text) {
  doe::Seed seed = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), seed);
  return end.ec == std::errc() && end.ptr == text.data() + text.size() ? seed : 0;
}

Eigen::VectorXd numbers(SQLite::Statement& row, int first, std::size_t count) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(count));
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const auto column = row.getColumn(first + static_cast<int>(i));
    values[i] = column.isNull() ? std::numeric_limits<double>::quiet_NaN() : column.getDouble();
  }
  return values;
}

constexpr const char* fixed_columns =
    "id, kind, point, replicate, seed, status, coalesce(reason, ''), coalesce(seconds, 0), "
    "coalesce(started, ''), coalesce(finished, ''), coalesce(log, ''), coalesce(checksum, '')";
constexpr int fixed_column_count = 12, checksum_column = 11;

/// A row of `SELECT fixed_columns, Columns::all()`.
Run read_run(SQLite::Statement& row, std::size_t dimension, std::size_t responses) {
  const auto text = [&](int column) { return row.getColumn(column).getString(); };
  int next = fixed_column_count;
  const auto take = [&](std::size_t count) {
    next += static_cast<int>(count);
    return numbers(row, next - static_cast<int>(count), count);
  };
  Run run;
  run.id = row.getColumn(0).getInt64();
  run.kind = kind_from(text(1));
  run.point = row.getColumn(2).getInt64();
  run.replicate = row.getColumn(3).getInt();
  run.seed = seed_from(text(4));
  run.status = status_from(text(5));
  run.reason = text(6);
  run.seconds = row.getColumn(7).getDouble();
  run.started = text(8);
  run.finished = text(9);
  run.log = text(10);
  run.x = take(dimension);
  run.y = take(responses);
  run.predicted = take(responses);
  run.lower = take(responses);
  run.upper = take(responses);
  return run;
}

}  // namespace

std::string create_runs(const Columns& columns) {
  std::string text =
      "CREATE TABLE runs (id INTEGER PRIMARY KEY, kind TEXT NOT NULL CHECK (kind IN ('training', "
      "'adaptive', 'confirmation', 'imported', 'validation')), "
      "point INTEGER NOT NULL, replicate INTEGER NOT NULL, seed TEXT NOT NULL, "
      "status TEXT NOT NULL CHECK (status IN ('planned', 'running', 'done', 'failed')), "
      "reason TEXT, seconds REAL, started TEXT, finished TEXT, log TEXT, checksum TEXT";
  for (const auto& column : columns.x) text += ", " + column + " REAL NOT NULL";
  for (const auto* group : {&columns.y, &columns.predicted, &columns.lower, &columns.upper}) {
    for (const auto& column : *group) text += ", " + column + " REAL";
  }
  return text + ", UNIQUE (kind, point, replicate))";
}

std::vector<std::pair<Run, std::string>> read_rows(SQLite::Database& database, const Columns& columns,
                                                   const std::string& condition) {
  std::string text = std::string("SELECT ") + fixed_columns;
  for (const auto& column : columns.all()) text += ", " + column;
  SQLite::Statement query(database, text + " FROM runs WHERE " + condition + " ORDER BY id");
  std::vector<std::pair<Run, std::string>> found;
  while (query.executeStep())
    found.emplace_back(read_run(query, columns.x.size(), columns.y.size()),
                       query.getColumn(checksum_column).getString());
  return found;
}

}  // namespace detail
}  // namespace drawpoint::studies
