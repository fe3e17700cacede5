// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/output_file.h>
#include <drawpoint/studies/run/settings.h>

#include <algorithm>
#include <string>
#include <system_error>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

/// Whether it is this place or lies in it, whatever links lead there.
bool is_within(const fs::path& file, const fs::path& place) {
  const fs::path whole = fs::weakly_canonical(file), of = fs::weakly_canonical(place);
  return std::mismatch(of.begin(), of.end(), whole.begin(), whole.end()).first == of.end();
}

fs::path behind_links(const fs::path& file) {
  constexpr int most_links = 40;  // as the system follows
  fs::path end = file;
  for (int link = 0; link < most_links && fs::is_symlink(end); ++link)
    end = end.parent_path() / fs::read_symlink(end);
  return end;
}

fs::path beside(fs::path file, const char* ending) { return file += ending; }

}  // namespace

fs::path output_file(const Folder& folder, const fs::path& file, const std::string& option) {
  if (file.empty()) return file;
  std::error_code broken;
  if (fs::status(file, broken).type() == fs::file_type::none)
    throw UsageError(option + ": " + file.string() + " cannot be reached: " + broken.message() +
                     "; name another");
  if (fs::exists(file) && !fs::is_regular_file(file) && !fs::is_directory(file))
    throw UsageError(
        option + ": " + file.string() +
        " is a device or a pipe, and no file; name a file, or for a table on standard output leave " +
        option + " out");
  for (const fs::path& own :
       {folder.store(), folder.logs(), folder.shared(), folder.shared_checksums(), folder.slurm(),
        folder.report(), folder.lock(), beside(folder.store(), "-journal"), beside(folder.store(), "-wal"),
        beside(folder.store(), "-shm")}) {
    if (is_within(file, own))
      throw UsageError(option + ": " + file.string() + " is where the study keeps its own (" + own.string() +
                       "); name another");
  }
  return behind_links(file);
}

}  // namespace drawpoint::studies
