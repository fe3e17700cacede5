// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <SQLiteCpp/SQLiteCpp.h>
#include <drawpoint/studies/run/store/row_checksum.h>
#include <drawpoint/studies/run/store/rows.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/doe/problem_json.hpp>
#include <drawpoint/tests/fuzz/own_folder.hpp>

#include <nlohmann/json.hpp>
#include <sstream>

namespace drawpoint::fuzz {
namespace {

using namespace studies;

const OwnFolder& folder() {
  static const OwnFolder made;
  return made;
}

void read_file(const std::filesystem::path& file) {
  taken_or_refused([&] {
    const Store store = Store::open(file, Access::read);
    for (const studies::Run& run : store.runs())
      if (run.status == Status::done &&
          run.y.size() != static_cast<Eigen::Index>(store.identity().problem.responses.size()))
        __builtin_trap();
    store.corrections();
  });
}

/// Two runs, one of them done.
void make_sound(const std::filesystem::path& file) {
  const doe::Problem problem{.variables = {{"alpha", "1", 0.2, 2.0}, {"lip", "m", -1.0, 3.0}},
                             .responses = {{"production", "kg/s", doe::Goal::maximize}}};
  Store store = Store::create(file, {.study = "sample", .problem = problem});
  studies::Run first, second;
  first.id = first.point = 1;
  second.id = second.point = 2;
  first.x = second.x = Eigen::Vector2d(1.0, 2.0);
  store.add({first, second});
  store.save_done(1, Eigen::VectorXd::Constant(1, 3.0), 1.0);
  store.exclude(1, "fuzz");
}

void put(SQLite::Database& database, const std::string& line) {
  std::istringstream parts(line);
  std::string key, name, value;
  std::getline(parts, key, '\t');
  std::getline(parts, key == "run" ? name : value, '\t');
  if (key == "run") std::getline(parts, value);
  SQLite::Statement change(database, key == "run"
                                         ? "UPDATE runs SET " + detail::sql_quoted(name) + " = ? WHERE id = 1"
                                         : "UPDATE study SET value = ? WHERE key = '" + key + "'");
  change.bind(1, value);
  change.exec();
}

/// So that what is wrong is the meaning, and not the sum.
void seal(SQLite::Database& database) {
  SQLite::Statement query(database, "SELECT key, value FROM study WHERE key != 'checksum' ORDER BY key");
  detail::RowText row;
  std::string problem;
  while (query.executeStep()) {
    row << query.getColumn(0).getString() << query.getColumn(1).getString();
    if (query.getColumn(0).getString() == "problem") problem = query.getColumn(1).getString();
  }
  SQLite::Statement update(database, "UPDATE study SET value = ? WHERE key = 'checksum'");
  update.bind(1, doe::detail::checksum(row.text()));
  update.exec();
  const Columns columns = columns_of(doe::problem_from_json(nlohmann::json::parse(problem)));
  for (const auto& [run, ignored] : detail::read_rows(database, columns, "id = 1")) {
    SQLite::Statement sum(database, "UPDATE runs SET checksum = ? WHERE id = 1");
    sum.bind(1, detail::row_checksum(run));
    sum.exec();
  }
}

}  // namespace

void read_store(Bytes bytes) {
  if (bytes.empty()) return;
  const std::filesystem::path file = folder() / "study.db", sound = folder() / "sound.db";
  if (bytes[0] % 2 == 0) {
    write(file, bytes.subspan(1));
    return read_file(file);
  }
  if (!std::filesystem::exists(sound)) make_sound(sound);
  std::filesystem::copy_file(sound, file, std::filesystem::copy_options::overwrite_existing);
  try {
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    database.exec("PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY");
    std::istringstream lines(text_of(bytes.subspan(1)));
    for (std::string line; std::getline(lines, line);) put(database, line);
    seal(database);
  } catch (const std::exception&) {  // there is no such column, or no problem to seal by
  }
  read_file(file);
}

}  // namespace drawpoint::fuzz
