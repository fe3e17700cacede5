// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The ledger of a store: what people have taken out of it or put right, with what stood there before.

#include <SQLiteCpp/SQLiteCpp.h>
#include <drawpoint/studies/run/store/left_out.h>
#include <drawpoint/studies/run/store/plain_text.h>
#include <drawpoint/studies/run/store/row_checksum.h>
#include <drawpoint/studies/run/store/rows.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/run/store/store_errors.h>
#include <drawpoint/studies/run/store/times.h>

#include <ctime>
#include <nlohmann/json.hpp>

namespace drawpoint::studies {
namespace {

using detail::refuse;
using detail::with_context;

constexpr const char* columns_of_ledger = "number, run, what, why, before, made";

std::string ledger_checksum(const Correction& c) {
  detail::RowText row;
  row << std::to_string(c.number) << std::to_string(c.run) << c.what << c.why << c.before << c.made;
  return doe::detail::checksum(row.text());
}

/// As one JSON object, numbers to the last digit.
std::string state_of(const Run& run) {
  nlohmann::ordered_json state = {{"status", name_of(run.status)}};
  if (run.status == Status::failed) state["reason"] = run.reason;
  if (run.status == Status::done) state["values"] = std::vector<double>(run.y.begin(), run.y.end());
  state["seconds"] = run.seconds;
  return state.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

std::vector<double> values_before(const Correction& correction) {
  const nlohmann::json state = nlohmann::json::parse(correction.before, nullptr, false);
  if (!state.is_object() || !state.contains("values")) return {};
  return state["values"].get<std::vector<double>>();
}

std::vector<Correction> Store::read_corrections() const {
  if (!database_->tableExists("corrections")) return {};
  SQLite::Statement query(
      *database_, std::string("SELECT ") + columns_of_ledger + ", checksum FROM corrections ORDER BY number");
  std::vector<Correction> all;
  while (query.executeStep()) {
    const auto text = [&](int column) { return query.getColumn(column).getString(); };
    all.push_back(
        {query.getColumn(0).getInt64(), query.getColumn(1).getInt64(), text(2), text(3), text(4), text(5)});
    const std::string name = std::to_string(all.size());
    if (all.back().number != static_cast<std::int64_t>(all.size()))
      refuse(file_, "is damaged (correction " + name + " is not there)");
    if (ledger_checksum(all.back()) != text(6))
      refuse(file_, "is damaged (correction " + name + " does not fit its checksum)");
  }
  return all;
}

std::vector<Correction> Store::corrections() const {
  return with_context(file_, [&] { return read_corrections(); });
}

void Store::write_correction(const Run& before, const std::string& what, const std::string& why) {
  database_->exec(
      "CREATE TABLE IF NOT EXISTS corrections (number INTEGER PRIMARY KEY, run INTEGER NOT NULL, what TEXT "
      "NOT "
      "NULL, why TEXT NOT NULL, before TEXT NOT NULL, made TEXT NOT NULL, checksum TEXT NOT NULL)");
  const Correction next{static_cast<std::int64_t>(read_corrections().size()) + 1,
                        before.id,
                        what,
                        plain_text(why),
                        state_of(before),
                        utc_text(std::time(nullptr))};
  SQLite::Statement insert(*database_, std::string("INSERT INTO corrections (") + columns_of_ledger +
                                           ", checksum) VALUES (?, ?, ?, ?, ?, ?, ?)");
  insert.bind(1, next.number);
  insert.bind(2, next.run);
  insert.bind(3, next.what);
  insert.bind(4, next.why);
  insert.bind(5, next.before);
  insert.bind(6, next.made);
  insert.bind(7, ledger_checksum(next));
  insert.exec();
}

void Store::exclude(std::int64_t id, const std::string& why, bool take_back) {
  with_context(file_, [&] {
    SQLite::Transaction transaction(*database_);
    write_correction(stored_row(id), take_back ? include_word : exclude_word, why);
    transaction.commit();
  });
}

void Store::replace(std::int64_t id, const Eigen::VectorXd& y, const std::string& reason, double seconds,
                    const std::string& why) {
  with_context(file_, [&] {
    SQLite::Transaction transaction(*database_);
    write_correction(stored_row(id), replace_word, why);
    if (y.size() > 0)
      write_done(id, y, seconds, "");
    else
      write_failed(id, reason, seconds, "");
    seal_rows("id = " + std::to_string(id));
    transaction.commit();
  });
}

Run Store::stored_row(std::int64_t id) const {
  auto rows = detail::read_rows(*database_, columns_, "id = " + std::to_string(id));
  if (rows.empty()) refuse(file_, "has no run " + std::to_string(id));
  return std::move(rows.front().first);
}

}  // namespace drawpoint::studies
