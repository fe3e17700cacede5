// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/store.h>

#include <SQLiteCpp/SQLiteCpp.h>
#include <drawpoint/studies/run/store/columns.h>
#include <drawpoint/studies/run/store/left_out.h>
#include <drawpoint/studies/run/store/marks.h>
#include <drawpoint/studies/run/store/plain_text.h>
#include <drawpoint/studies/run/store/row_checksum.h>
#include <drawpoint/studies/run/store/rows.h>
#include <drawpoint/studies/run/store/store_errors.h>
#include <drawpoint/studies/run/store/times.h>
#include <drawpoint/doe/problem_json.hpp>

#include <ctime>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using detail::create_runs;
using detail::read_rows;
using detail::refuse;
using detail::with_context;

constexpr int schema_version = 5;
constexpr int lock_patience = 30000;   // [ms] for another program that reads the file
constexpr int reader_patience = 2000;  // [ms] of who only reads, and may ask again

/// With room for what printed_last adds.
std::string kept_reason(const std::string& reason) { return plain_text(reason, most_of_reason + 1000); }

std::string now() { return utc_text(std::time(nullptr)); }

int pragma(SQLite::Database& database, const std::string& name) {
  return database.execAndGet("PRAGMA " + name).getInt();
}

void put_in_study(SQLite::Database& database, const std::string& key, const std::string& value) {
  SQLite::Statement put(database, "INSERT OR REPLACE INTO study (key, value) VALUES (?, ?)");
  put.bind(1, key);
  put.bind(2, value);
  put.exec();
}

void write_identity(SQLite::Database& database, const Identity& identity) {
  const auto put = [&](const std::string& key, const std::string& value) {
    put_in_study(database, key, value);
  };
  put("name", identity.study);
  put("problem", to_json(identity.problem).dump());
  put("seed", std::to_string(identity.seed));
  put("replicates", std::to_string(identity.replicates));
  put("corners", identity.corners ? "1" : "0");
  put("options", nlohmann::json(identity.options).dump());
  put("simulator", identity.simulator);
  put("created", now());
  put("rows", "0");
  put("sampling", to_text(Sampling{}));
}

/// Over all entries but itself, in order of their keys.
std::string study_checksum(SQLite::Database& database) {
  SQLite::Statement query(database, "SELECT key, value FROM study WHERE key != 'checksum' ORDER BY key");
  detail::RowText row;
  while (query.executeStep()) row << query.getColumn(0).getString() << query.getColumn(1).getString();
  return doe::detail::checksum(row.text());
}

}  // namespace

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
    database.exec("PRAGMA application_id = " + std::to_string(store_application_id));
    database.exec("PRAGMA user_version = " + std::to_string(schema_version));
    database.exec("CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL)");
    database.exec(create_runs(columns_of(identity.problem)));
    write_identity(database, identity);
    put_in_study(database, "checksum", study_checksum(database));
    transaction.commit();
  });
  fs::rename(draft, file);
  return open(file);
}

Store Store::open(const fs::path& file, Access access) {
  const bool reads = access == Access::read;
  std::error_code ignored;
  if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored))
    refuse(file, "is no regular file, and not the store of a Drawpoint study");
  return with_context(file, [&] {
    Store store(file, std::make_unique<SQLite::Database>(
                          file.string(), reads ? SQLite::OPEN_READONLY : SQLite::OPEN_READWRITE,
                          reads ? reader_patience : lock_patience));
    store.check_format();
    if (!reads) store.check_integrity();
    store.read_identity();
    return store;
  });
}

void Store::check_format() const {
  std::error_code ignored;
  if (fs::file_size(file_, ignored) == 0) refuse(file_, "is empty, and not the store of a Drawpoint study");
  if (pragma(*database_, "application_id") != store_application_id) {
    refuse(file_, "is an SQLite file, but not the store of a Drawpoint study");
  }
  const int version = pragma(*database_, "user_version");
  if (version != schema_version) {
    refuse(file_, "has schema version " + std::to_string(version) + ", this program reads version " +
                      std::to_string(schema_version));
  }
}

void Store::check_integrity() const {
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
  SQLite::Transaction at_one_time(*database_);
  if (get("checksum") != study_checksum(*database_))
    refuse(file_, "is damaged (table study does not fit its checksum)");
  try {
    identity_ = {get("name"),
                 doe::problem_from_json(nlohmann::json::parse(get("problem"))),
                 std::stoull(get("seed")),
                 std::stoi(get("replicates")),
                 get("corners") == "1",
                 nlohmann::json::parse(get("options")).get<OptionValues>(),
                 get("simulator")};
    sampling_ = sampling_from(get("sampling"));
  } catch (const std::logic_error&) {
    refuse(file_, "is damaged (a number in table study is not one)");
  } catch (const nlohmann::json::exception&) {
    refuse(file_, "is damaged (problem, options or sampling in table study are not readable)");
  }
  columns_ = columns_of(identity_.problem);
}

std::vector<Run> Store::runs() const {
  return with_context(file_, [&] {
    SQLite::Transaction at_one_time(*database_);  // another program may be adding rows
    std::vector<Run> result;
    for (auto& [run, checksum] : read_rows(*database_, columns_, "1")) {
      const std::string name = std::to_string(result.size() + 1);
      if (run.id != static_cast<std::int64_t>(result.size()) + 1)
        refuse(file_, "is damaged (run " + name + " is not there)");
      if (checksum != detail::row_checksum(run))
        refuse(file_, "is damaged (run " + name + " does not fit its checksum)");
      run.reason = plain_text(run.reason, most_of_reason + 2000);  // stores of before kept all
      result.push_back(std::move(run));
    }
    const std::string kept = database_->execAndGet("SELECT value FROM study WHERE key = 'rows'").getString();
    if (kept != std::to_string(result.size()))
      refuse(file_, "is damaged (it holds " + std::to_string(result.size()) + " of " + kept + " runs)");
    leave_out(result, read_corrections(), identity_.problem);
    return result;
  });
}

void Store::seal_rows(const std::string& condition) {
  SQLite::Statement update(*database_, "UPDATE runs SET checksum = ? WHERE id = ?");
  for (const auto& [run, ignored] : read_rows(*database_, columns_, condition)) {
    update.reset();
    update.bind(1, detail::row_checksum(run));
    update.bind(2, run.id);
    update.exec();
  }
}

void Store::seal_study() {
  put_in_study(*database_, "rows", database_->execAndGet("SELECT count(*) FROM runs").getString());
  put_in_study(*database_, "checksum", study_checksum(*database_));
}

template <class F>
void Store::change(std::int64_t id, const F& f) {
  with_context(file_, [&] {
    SQLite::Transaction transaction(*database_);
    f();
    seal_rows("id = " + std::to_string(id));
    transaction.commit();
  });
}

void Store::put_setting(const std::string& key, const std::string& value) {
  with_context(file_, [&] {
    SQLite::Transaction transaction(*database_);
    put_in_study(*database_, key, value);
    seal_study();
    transaction.commit();
  });
}

void Store::set_sampling(const Sampling& sampling) {
  put_setting("sampling", to_text(sampling));
  sampling_ = sampling;
}

std::vector<Mark> Store::marks() const {
  return with_context(file_, [&] {
    SQLite::Statement query(*database_, "SELECT value FROM study WHERE key = 'marks'");
    if (!query.executeStep()) return std::vector<Mark>();
    try {
      std::vector<Mark> marks = marks_from(query.getColumn(0).getString());
      check_marks(identity_.problem, marks);
      return marks;
    } catch (const nlohmann::json::exception&) {
    } catch (const std::invalid_argument&) {
    }
    refuse(file_, "is damaged (marks in table study are not readable)");
  });
}

void Store::set_marks(const std::vector<Mark>& marks) { put_setting("marks", to_text(marks)); }

void Store::add(const std::vector<Run>& runs) {
  std::string columns = "id, kind, point, replicate, seed, status, reason, seconds, started, finished, log";
  std::string marks = "?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?";
  constexpr std::size_t first_number = 12;  // of the columns that follow
  for (const auto* group :
       {&columns_.x, &columns_.y, &columns_.predicted, &columns_.lower, &columns_.upper}) {
    for (const auto& column : *group) {
      columns += ", " + column;
      marks += ", ?";
    }
  }
  with_context(file_, [&] {
    SQLite::Transaction transaction(*database_);
    SQLite::Statement insert(*database_, "INSERT INTO runs (" + columns + ") VALUES (" + marks + ")");
    for (const auto& run : runs) {
      insert.reset();
      insert.clearBindings();  // what was not predicted is NULL
      insert.bind(1, run.id);
      insert.bind(2, name_of(run.kind));
      insert.bind(3, run.point);
      insert.bind(4, run.replicate);
      insert.bind(5, std::to_string(run.seed));
      const std::size_t responses = columns_.y.size();
      std::size_t group = first_number + columns_.x.size();
      const auto bind = [&](std::size_t first, const Eigen::VectorXd& values) {
        for (const double value : values) insert.bind(static_cast<int>(first++), value);
      };
      insert.bind(6, name_of(run.status));
      if (has_ended(run)) {
        if (!run.reason.empty()) insert.bind(7, kept_reason(run.reason));
        insert.bind(8, run.seconds);
        insert.bind(9, run.started);
        insert.bind(10, run.finished);
        insert.bind(11, run.log);
      }
      bind(first_number, run.x);
      for (const auto* values : {&run.y, &run.predicted, &run.lower, &run.upper}) {
        bind(group, *values);
        group += responses;
      }
      insert.exec();
    }
    seal_rows("checksum IS NULL");
    seal_study();
    transaction.commit();
  });
}

void Store::mark_running(std::int64_t id) {
  change(id, [&] {
    SQLite::Statement update(*database_,
                             "UPDATE runs SET status = 'running', reason = NULL, started = ? WHERE id = ?");
    update.bind(1, now());
    update.bind(2, id);
    update.exec();
  });
}

void Store::mark_planned(std::int64_t id) {
  change(id, [&] {
    SQLite::Statement update(*database_, "UPDATE runs SET status = 'planned', started = NULL WHERE id = ?");
    update.bind(1, id);
    update.exec();
  });
}

void Store::write_done(std::int64_t id, const Eigen::VectorXd& y, double seconds, const std::string& log) {
  std::string text = "UPDATE runs SET status = 'done', reason = NULL, seconds = ?, finished = ?, log = ?";
  for (const auto& column : columns_.y) text += ", " + column + " = ?";
  SQLite::Statement update(*database_, text + " WHERE id = ?");
  update.bind(1, seconds);
  update.bind(2, now());
  update.bind(3, log);
  for (int i = 0; i < y.size(); ++i) update.bind(4 + i, y[i]);
  update.bind(4 + static_cast<int>(y.size()), id);
  update.exec();
}

void Store::write_failed(std::int64_t id, const std::string& reason, double seconds, const std::string& log) {
  SQLite::Statement update(
      *database_,
      "UPDATE runs SET status = 'failed', reason = ?, seconds = ?, finished = ?, log = ? WHERE id = ?");
  update.bind(1, kept_reason(reason));
  update.bind(2, seconds);
  update.bind(3, now());
  update.bind(4, log);
  update.bind(5, id);
  update.exec();
}

void Store::save_done(std::int64_t id, const Eigen::VectorXd& y, double seconds, const std::string& log) {
  change(id, [&] { write_done(id, y, seconds, log); });
}

void Store::save_failed(std::int64_t id, const std::string& reason, double seconds, const std::string& log) {
  change(id, [&] { write_failed(id, reason, seconds, log); });
}

void Store::plan_again(bool failed) {
  // Points made elsewhere cannot be made here.
  const std::string which = failed ? "('running', 'failed') AND kind != 'imported'" : "('running')";
  with_context(file_, [&] {
    SQLite::Transaction transaction(*database_);
    database_->exec(
        "UPDATE runs SET status = 'planned', reason = NULL, seconds = NULL, started = NULL, finished = NULL, "
        "log = NULL, checksum = NULL WHERE status IN " +
        which);
    seal_rows("checksum IS NULL");
    transaction.commit();
  });
}

}  // namespace drawpoint::studies
