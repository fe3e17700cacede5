// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/share_file.h>

#include <SQLiteCpp/SQLiteCpp.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/plain_text.h>
#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/studies/run/store/store.h>
#include <sys/stat.h>
#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/doe/detail/hash.hpp>
#include <drawpoint/doe/detail/stranger_file.hpp>

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

constexpr int share_id = 0x44727773;
constexpr const char* share_version = "1";

constexpr const char* name_another = "; name the file that the command share made";
constexpr const char* copy_again = "; copy it again from where it was made";

/// To be opened.
[[noreturn]] void refuse_share(const fs::path& file, const std::string& what) {
  throw std::runtime_error("open: " + file.string() + " " + what);
}

/// A complaint of SQLite becomes one of ours.
template <class F>
auto of_share(const fs::path& file, const F& f) {
  try {
    return f();
  } catch (const SQLite::Exception& e) {
    refuse_share(file, std::string("is damaged, or cannot be read: ") + e.what() + copy_again);
  }
}

/// The number of these bytes, the largest first.
std::uintmax_t big_endian(const std::string& bytes) {
  std::uintmax_t number = 0;
  for (const char byte : bytes) number = number << 8 | static_cast<unsigned char>(byte);
  return number;
}

/// How long the file was when SQLite wrote it, by its header (sqlite.org/fileformat.html, section 1.3).
std::uintmax_t whole_size(const std::string& header) {
  const std::uintmax_t page = big_endian(header.substr(16, 2)), pages = big_endian(header.substr(28, 4));
  return (page == 1 ? 65536 : page) * pages;
}

/// SQLite itself takes an empty file for a database without a table, and does not miss its last page before it
/// needs it.
void require_whole(const fs::path& file, doe::detail::StrangerFile& there) {
  static const std::string magic("SQLite format 3\0", 16);
  constexpr std::size_t header_size = 100;
  const std::string header = there.text(0, header_size), size = std::to_string(there.size());
  if (there.size() == 0) refuse_share(file, std::string("is empty") + copy_again);
  if (header.substr(0, magic.size()) != magic.substr(0, header.size()))
    refuse_share(
        file, std::string("is no file of the command share (it does not begin as these do)") + name_another);
  if (header.size() < header_size) refuse_share(file, "ends after " + size + " bytes" + copy_again);
  if (const std::uintmax_t whole = whole_size(header); there.size() < whole)
    refuse_share(file, "has " + size + " of its " + std::to_string(whole) + " bytes" + copy_again);
}

std::string bytes_to_share(const FileToShare& file) {
  doe::detail::StrangerFile opened(file.from);
  if (!opened.fault().empty())
    throw std::runtime_error("share: " + file.from.string() + " " + opened.fault());
  if (opened.size() > largest_shared_file)
    throw std::runtime_error("share: " + file.from.string() + " has " + std::to_string(opened.size()) +
                             " bytes; allowed are 1e9 for one file. Share the folder by tar, or --no-logs");
  std::string bytes = opened.text(0, largest_shared_file);
  if (bytes.size() != opened.size())
    throw std::runtime_error("share: " + file.from.string() + " cannot be read to its end");
  return bytes;
}

void put_file(SQLite::Database& database, const FileToShare& file) {
  const std::string bytes = file.text.empty() ? bytes_to_share(file) : file.text;
  struct stat status = {};
  ::stat(file.from.c_str(), &status);
  SQLite::Statement row(database, "INSERT INTO sqlar VALUES (?, ?, ?, ?, ?)");
  row.bind(1, file.name);
  row.bind(2, 0100644);
  row.bind(3, static_cast<std::int64_t>(status.st_mtime));
  row.bind(4, static_cast<std::int64_t>(bytes.size()));
  row.bindNoCopy(5, bytes.data(), static_cast<int>(bytes.size()));
  row.exec();
  SQLite::Statement sum(database, "INSERT INTO drawpoint_files VALUES (?, ?)");
  sum.bind(1, file.name);
  sum.bind(2, doe::detail::checksum(bytes));
  sum.exec();
}

void fill_share(const std::string& draft, const std::vector<FileToShare>& files,
                const std::map<std::string, std::string>& facts) {
  SQLite::Database database(draft, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  database.exec("PRAGMA journal_mode = OFF");  // the draft is thrown away where this fails
  database.exec("PRAGMA application_id = " + std::to_string(share_id));
  SQLite::Transaction transaction(database);
  database.exec("CREATE TABLE sqlar (name TEXT PRIMARY KEY, mode INT, mtime INT, sz INT, data BLOB)");
  database.exec("CREATE TABLE drawpoint (key TEXT PRIMARY KEY, value TEXT NOT NULL)");
  database.exec("CREATE TABLE drawpoint_files (name TEXT PRIMARY KEY, checksum TEXT NOT NULL)");
  for (const auto& [key, value] : facts) {
    SQLite::Statement row(database, "INSERT INTO drawpoint VALUES (?, ?)");
    row.bind(1, key);
    row.bind(2, value);
    row.exec();
  }
  for (const FileToShare& file : files) put_file(database, file);
  transaction.commit();
}

SQLite::Database opened_share(const fs::path& file) {
  doe::detail::StrangerFile there(file, doe::detail::Links::follow);
  if (there.missing()) refuse_share(file, std::string("is not there") + name_another);
  if (!there.fault().empty()) refuse_share(file, there.fault() + name_another);
  require_whole(file, there);
  SQLite::Database database(file.string(), SQLite::OPEN_READONLY);
  const int id = database.execAndGet("PRAGMA application_id").getInt();
  if (id == store_application_id)
    refuse_share(file, std::string("is the store of a study alone; give the folder in which it lies to --out "
                                   "of another command") +
                           name_another);
  if (id != share_id)
    refuse_share(file, std::string("is an SQLite file, but none of the command share") + name_another);
  return database;
}

void write_unpacked(const fs::path& place, const std::string& bytes) {
  fs::create_directories(place.parent_path());
  if (fs::exists(fs::symlink_status(place)))
    throw std::runtime_error("open: two files of one name: " + place.string() +
                             "; nothing was unpacked; share the folder again");
  doe::write_file(place, bytes);
}

constexpr const char* shared_rows =
    "SELECT s.name, s.sz, s.data, coalesce(f.checksum, '') FROM sqlar s "
    "LEFT JOIN drawpoint_files f ON f.name = s.name ";

/// What was shared, of one of these rows.
std::string bytes_of(const fs::path& file, SQLite::Statement& row) {
  const std::string shown = "\"" + plain_text(row.getColumn(0).getString(), 200) + "\"";
  const SQLite::Column data = row.getColumn(2);
  const std::string bytes(static_cast<const char*>(data.getBlob()),
                          static_cast<std::size_t>(data.getBytes()));
  const bool packed = row.getColumn(1).getInt64() != static_cast<std::int64_t>(bytes.size());
  if (packed || doe::detail::checksum(bytes) != row.getColumn(3).getString())
    refuse_share(file, "is damaged: " + shown +
                           " does not fit its checksum; nothing was unpacked; copy the "
                           "file again from where it was made");
  return bytes;
}

/// One file, if it may lie there.
void unpack_one(const fs::path& file, const fs::path& into, SQLite::Statement& row) {
  const std::string name = row.getColumn(0).getString();
  if (!share_name_is_allowed(name))
    refuse_share(file, "holds \"" + plain_text(name, 200) +
                           "\", which no folder of a study does; nothing was unpacked");
  write_unpacked(into / name, bytes_of(file, row));
}

}  // namespace

bool share_name_is_allowed(const std::string& name) {
  // No part of a name is ".", "..", empty or hidden.
  static const std::regex allowed(
      R"(study\.db|study\.json|report\.html|shared\.checksums|replay_[0-9]+(_cycle_[0-9]+)?\.html)"
      R"(|logs/[A-Za-z0-9_][A-Za-z0-9_.-]*|shared(/[A-Za-z0-9_][A-Za-z0-9_. +-]*)+)");
  return name.size() < 1000 && std::regex_match(name, allowed);
}

std::vector<FileToShare> files_to_share(const fs::path& folder) {
  std::vector<FileToShare> files;
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator();
       ++entry) {
    const std::string name = entry->path().lexically_relative(folder).generic_string();
    if (fs::is_regular_file(entry->symlink_status()) && share_name_is_allowed(name))
      files.push_back({name, entry->path()});
  }
  std::sort(files.begin(), files.end(),
            [](const FileToShare& a, const FileToShare& b) { return a.name < b.name; });
  return files;
}

void write_share(const fs::path& file, const std::vector<FileToShare>& files,
                 std::map<std::string, std::string> facts) {
  facts["version"] = share_version;
  facts["files"] = std::to_string(files.size());
  doe::detail::TemporaryFile draft(file);
  try {
    fill_share(draft.path(), files, facts);
  } catch (const SQLite::Exception& e) {
    throw std::runtime_error("share: " + file.string() + " cannot be written: " + e.what() +
                             "; free some space, or name another file with --output");
  }
  draft.replace_target();
}

std::map<std::string, std::string> share_facts(const fs::path& file) {
  return of_share(file, [&] {
    SQLite::Database database = opened_share(file);
    std::map<std::string, std::string> facts;
    SQLite::Statement query(database, "SELECT key, value FROM drawpoint");
    while (query.executeStep())
      facts[query.getColumn(0).getString()] = plain_text(query.getColumn(1).getString(), 500);
    if (facts["version"] != share_version)
      refuse_share(file, "has version \"" + facts["version"] + "\" of the format, and this program (" +
                             share_version +
                             ") cannot read it; take the program that made it: " + facts["program"]);
    return facts;
  });
}

std::string shared_definition(const fs::path& file) {
  share_facts(file);
  return of_share(file, [&] {
    SQLite::Database database = opened_share(file);
    SQLite::Statement rows(database, shared_rows + std::string("WHERE s.name = ?"));
    rows.bind(1, definition_name);
    return rows.executeStep() ? bytes_of(file, rows) : std::string();
  });
}

int unpack_share(const fs::path& file, const fs::path& into) {
  const std::string wanted = share_facts(file)["files"];
  return of_share(file, [&] {
    SQLite::Database database = opened_share(file);
    const auto needed = static_cast<std::uintmax_t>(std::max<std::int64_t>(
        0, database.execAndGet("SELECT coalesce(sum(length(data)), 0) FROM sqlar").getInt64()));
    if (needed + least_free_space > free_space(into))
      refuse_share(file, "needs " + std::to_string(needed) + " bytes, and the disk of " + into.string() +
                             " has " + std::to_string(free_space(into)) + "; free some space");
    SQLite::Statement rows(database, shared_rows + std::string("ORDER BY s.name"));
    int count = 0;
    for (; rows.executeStep(); ++count) unpack_one(file, into, rows);
    if (std::to_string(count) != wanted)
      refuse_share(file, "is damaged: it holds " + std::to_string(count) + " of " + wanted +
                             " files; nothing was unpacked; copy the file again from where it was made");
    return count;
  });
}

}  // namespace drawpoint::studies
