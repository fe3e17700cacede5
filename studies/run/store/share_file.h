// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The files of a study in one: an SQLite archive (the format of `sqlite3 -A`, application id 0x44727773),
/// nothing in it compressed, with a checksum of each file (64-bit FNV-1a; against damage, not against forgery):
///
///     sqlar(name, mode, mtime, sz, data)      one row per file
///     drawpoint(key, value)                   version of this format, study, program, folder, made
///     drawpoint_files(name, checksum)         one row per file
///
/// What is unpacked is what a folder of a study may hold (share_name_is_allowed), in a new folder, and nothing
/// of it before every file has its checksum. All failures throw std::runtime_error that says what to do.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace drawpoint::studies {

struct FileToShare {
  std::string name;  ///< in the folder, with "/"
  std::filesystem::path from;
  std::string text = {};  ///< of a file that is nowhere else; empty: what `from` holds
};

/// What Simulator::definition is called there.
inline constexpr const char* definition_name = "study.json";

/// The most bytes of one file, which SQLite bounds: 1e9.
inline constexpr std::uintmax_t largest_shared_file = 1'000'000'000;

/// Whether a file of this name is unpacked: study.db, study.json, report.html, shared.checksums, replay pages, and
/// files in logs and in shared.
bool share_name_is_allowed(const std::string& name);

/// What there is in the folder to be shared, in order of name; links and what is no file are left out.
std::vector<FileToShare> files_to_share(const std::filesystem::path& folder);

/// Appears complete or not at all, in the place of what was there. `facts` go to the table drawpoint.
void write_share(const std::filesystem::path& file, const std::vector<FileToShare>& files,
                 std::map<std::string, std::string> facts);

/// The facts of such a file, of which "version" is one that this program reads.
std::map<std::string, std::string> share_facts(const std::filesystem::path& file);

/// The text of its study.json; empty where there is none.
std::string shared_definition(const std::filesystem::path& file);

/// Into an empty folder that nobody else sees yet. Returns how many files there are.
int unpack_share(const std::filesystem::path& file, const std::filesystem::path& into);

}  // namespace drawpoint::studies
