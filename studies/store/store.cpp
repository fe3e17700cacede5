// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/store/store.h>

#include <SQLiteCpp/SQLiteCpp.h>
#include <drawpoint/studies/store/columns.h>
#include <drawpoint/studies/store/store_errors.h>
#include <drawpoint/doe/problem_json.hpp>

#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using detail::refuse;
using detail::with_context;

constexpr int application_id = 0x44727770;
constexpr int schema_version = 2;
constexpr int lock_patience = 30000;  // [ms] for another program that reads the file

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc = {};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

int pragma(SQLite::Database& database, const std::string& name) {
  return database.execAndGet("PRAGMA " + name).getInt();
}

std::string create_statement(const Columns& columns) {
  std::string text =
      "CREATE TABLE runs (id INTEGER PRIMARY KEY, kind TEXT NOT NULL CHECK (kind IN ('training', "
      "'validation')), "
      "point INTEGER NOT NULL, replicate INTEGER NOT NULL, seed TEXT NOT NULL, "
      "status TEXT NOT NULL CHECK (status IN ('planned', 'running', 'done', 'failed')), "
      "reason TEXT, seconds REAL, started TEXT, finished TEXT";
  for (const auto& column : columns.x) text += ", " + column + " REAL NOT NULL";
  for (const auto& column : columns.y) text += ", " + column + " REAL";
  return text + ", UNIQUE (kind, point, replicate))";
}

void write_identity(SQLite::Database& database, const Identity& identity) {
  const auto put = [&](const std::string& key, const std::string& value) {
    SQLite::Statement insert(database, "INSERT INTO study (key, value) VALUES (?, ?)");
    insert.bind(1, key);
    insert.bind(2, value);
    insert.exec();
  };
  put("name", identity.study);
  put("problem", to_json(identity.problem).dump());
  put("seed", std::to_string(identity.seed));
  put("replicates", std::to_string(identity.replicates));
  put("corners", identity.corners ? "1" : "0");
  put("options", nlohmann::json(identity.options).dump());
  put("created", now());
}

Status status_from(const std::string& name) {
  for (const Status status : {Status::running, Status::done, Status::failed}) {
    if (name == name_of(status)) return status;
  }
  return Status::planned;
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
    "coalesce(started, ''), coalesce(finished, '')";
constexpr int fixed_column_count = 10;

/// A row of `SELECT fixed_columns, x..., y...`.
Run read_run(SQLite::Statement& row, std::size_t dimension, std::size_t responses) {
  const auto text = [&](int column) { return row.getColumn(column).getString(); };
  Run run;
  run.id = row.getColumn(0).getInt64();
  run.kind = text(1) == name_of(Kind::validation) ? Kind::validation : Kind::training;
  run.point = row.getColumn(2).getInt64();
  run.replicate = row.getColumn(3).getInt();
  run.seed = std::stoull(text(4));
  run.status = status_from(text(5));
  run.reason = text(6);
  run.seconds = row.getColumn(7).getDouble();
  run.started = text(8);
  run.finished = text(9);
  run.x = numbers(row, fixed_column_count, dimension);
  run.y = numbers(row, fixed_column_count + static_cast<int>(dimension), responses);
  return run;
}

}  // namespace

std::string name_of(Kind kind) { return kind == Kind::training ? "training" : "validation"; }

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

Store::Store(fs::path file, std::unique_ptr<SQLite::Database> database)
    : file_(std::move(file)), database_(std::move(database)) {}
Store::Store(Store&&) noexcept = default;
Store::~Store() = default;

Store Store::create(const fs::path& file, const Identity& identity) {
  const fs::path draft = file.string() + ".new";
  std::error_code ignored;
  fs::remove(draft, ignored);
  fs::remove(draft.string() + "-journal", ignored);
  with_context(draft, [&] {
    SQLite::Database database(draft.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, lock_patience);
    SQLite::Transaction transaction(database);
    database.exec("PRAGMA application_id = " + std::to_string(application_id));
    database.exec("PRAGMA user_version = " + std::to_string(schema_version));
    database.exec("CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL)");
    database.exec(create_statement(columns_of(identity.problem)));
    write_identity(database, identity);
    transaction.commit();
  });
  fs::rename(draft, file);
  return open(file);
}

Store Store::open(const fs::path& file) {
  return with_context(file, [&] {
    Store store(file,
                std::make_unique<SQLite::Database>(file.string(), SQLite::OPEN_READWRITE, lock_patience));
    store.check_format();
    store.read_identity();
    return store;
  });
}

void Store::check_format() const {
  if (pragma(*database_, "application_id") != application_id) {
    refuse(file_, "is an SQLite file, but not the store of a Drawpoint study");
  }
  const int version = pragma(*database_, "user_version");
  if (version != schema_version) {
    refuse(file_, "has schema version " + std::to_string(version) + ", this program reads version " +
                      std::to_string(schema_version));
  }
  const std::string state = database_->execAndGet("PRAGMA integrity_check").getString();
  if (state != "ok") refuse(file_, "is damaged (" + state + ")");
}

void Store::read_identity() {
  const auto get = [&](const std::string& key) {
    SQLite::Statement query(*database_, "SELECT value FROM study WHERE key = ?");
    query.bind(1, key);
    if (!query.executeStep()) refuse(file_, "is damaged (no entry \"" + key + "\" in table study)");
    return query.getColumn(0).getString();
  };
  try {
    identity_ = {get("name"),
                 doe::problem_from_json(nlohmann::json::parse(get("problem"))),
                 std::stoull(get("seed")),
                 std::stoi(get("replicates")),
                 get("corners") == "1",
                 nlohmann::json::parse(get("options")).get<OptionValues>()};
  } catch (const std::logic_error&) {
    refuse(file_, "is damaged (a number in table study is not one)");
  } catch (const nlohmann::json::exception&) {
    refuse(file_, "is damaged (problem or options in table study are not readable)");
  }
  const Columns columns = columns_of(identity_.problem);
  x_columns_ = columns.x;
  y_columns_ = columns.y;
}

std::vector<Run> Store::runs() const {
  return with_context(file_, [&] {
    std::string text = std::string("SELECT ") + fixed_columns;
    for (const auto& column : x_columns_) text += ", " + column;
    for (const auto& column : y_columns_) text += ", " + column;
    SQLite::Statement query(*database_, text + " FROM runs ORDER BY id");
    std::vector<Run> result;
    while (query.executeStep()) result.push_back(read_run(query, x_columns_.size(), y_columns_.size()));
    return result;
  });
}

void Store::add(const std::vector<Run>& planned) {
  std::string columns = "id, kind, point, replicate, seed, status";
  std::string marks = "?, ?, ?, ?, ?, 'planned'";
  for (const auto& column : x_columns_) {
    columns += ", " + column;
    marks += ", ?";
  }
  with_context(file_, [&] {
    SQLite::Transaction transaction(*database_);
    SQLite::Statement insert(*database_, "INSERT INTO runs (" + columns + ") VALUES (" + marks + ")");
    for (const auto& run : planned) {
      insert.reset();
      insert.bind(1, run.id);
      insert.bind(2, name_of(run.kind));
      insert.bind(3, run.point);
      insert.bind(4, run.replicate);
      insert.bind(5, std::to_string(run.seed));
      for (int i = 0; i < run.x.size(); ++i) insert.bind(6 + i, run.x[i]);
      insert.exec();
    }
    transaction.commit();
  });
}

void Store::mark_running(std::int64_t id) {
  with_context(file_, [&] {
    SQLite::Statement update(*database_,
                             "UPDATE runs SET status = 'running', reason = NULL, started = ? WHERE id = ?");
    update.bind(1, now());
    update.bind(2, id);
    update.exec();
  });
}

void Store::mark_planned(std::int64_t id) {
  with_context(file_, [&] {
    SQLite::Statement update(*database_, "UPDATE runs SET status = 'planned', started = NULL WHERE id = ?");
    update.bind(1, id);
    update.exec();
  });
}

void Store::save_done(std::int64_t id, const Eigen::VectorXd& y, double seconds) {
  std::string text = "UPDATE runs SET status = 'done', reason = NULL, seconds = ?, finished = ?";
  for (const auto& column : y_columns_) text += ", " + column + " = ?";
  with_context(file_, [&] {
    SQLite::Statement update(*database_, text + " WHERE id = ?");
    update.bind(1, seconds);
    update.bind(2, now());
    for (int i = 0; i < y.size(); ++i) update.bind(3 + i, y[i]);
    update.bind(3 + static_cast<int>(y.size()), id);
    update.exec();
  });
}

void Store::save_failed(std::int64_t id, const std::string& reason, double seconds) {
  with_context(file_, [&] {
    SQLite::Statement update(
        *database_, "UPDATE runs SET status = 'failed', reason = ?, seconds = ?, finished = ? WHERE id = ?");
    update.bind(1, reason);
    update.bind(2, seconds);
    update.bind(3, now());
    update.bind(4, id);
    update.exec();
  });
}

void Store::plan_again(bool failed) {
  const std::string which = failed ? "('running', 'failed')" : "('running')";
  with_context(file_, [&] {
    database_->exec(
        "UPDATE runs SET status = 'planned', reason = NULL, seconds = NULL, started = NULL, finished = NULL "
        "WHERE status IN " +
        which);
  });
}

}  // namespace drawpoint::studies
