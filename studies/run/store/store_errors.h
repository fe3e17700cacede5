// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What to say when SQLite refuses: the file, SQLite's own words, and what the user can do, by kind of error.
/// For store.cpp only.

#include <SQLiteCpp/Exception.h>
#include <drawpoint/studies/run/store/store.h>
#include <sqlite3.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace drawpoint::studies::detail {

inline std::string advice(int code) {
  if (code == SQLITE_READONLY_ROLLBACK)
    return "a process died while it wrote there; the command status puts it in order";
  if (code == SQLITE_READONLY_DBMOVED)
    return "the folder was moved, or the file was taken out of it, while this command worked there; give the "
           "same "
           "command again with its new place as --out";
  switch (code & 0xff) {
    case SQLITE_FULL:
    case SQLITE_IOERR:
      return "free some space on the disk and give the same command again; finished runs are kept";
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      return "the file is damaged or of another program and was left as it is; move it away, "
             "or choose another folder with --out";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program holds the file; close it and give the same command again";
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
      return "allow reading and writing it, or choose another folder with --out";
    default:
      return "the file was left as it is; move it away, or choose another folder with --out";
  }
}

/// Runs f; a complaint of SQLite becomes one of ours, with the file and what to do.
template <class F>
auto with_context(const std::filesystem::path& file, const F& f) {
  try {
    return f();
  } catch (const SQLite::Exception& e) {
    const std::string text =
        "studies: " + file.string() + ": " + e.what() + "; " + advice(e.getExtendedErrorCode());
    const int kind = e.getErrorCode() & 0xff;
    if (kind == SQLITE_BUSY || kind == SQLITE_LOCKED) throw StoreBusy(text);
    throw std::runtime_error(text);
  }
}

[[noreturn]] inline void refuse(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error("studies: " + file.string() + " " + reason +
                           "; it was left as it is; move it away, or choose another folder with --out");
}

}  // namespace drawpoint::studies::detail
