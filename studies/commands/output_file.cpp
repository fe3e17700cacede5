// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/output_file.h>
#include <drawpoint/studies/runs/settings.h>

#include <algorithm>
#include <string>

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

}  // namespace

fs::path output_file(const Folder& folder, const fs::path& file, const std::string& option) {
  if (file.empty()) return file;
  if (fs::exists(file) && !fs::is_regular_file(file) && !fs::is_directory(file))
    throw UsageError(option + ": " + file.string() +
                     " is a device or a pipe, whose place a file written whole would take; name a file");
  for (const fs::path& own : {folder.store(), folder.logs(), folder.shared(), folder.shared_checksums(),
                              folder.slurm(), folder.report()}) {
    if (is_within(file, own))
      throw UsageError(option + ": " + file.string() + " is where the study keeps its own (" + own.string() +
                       "); name another");
  }
  return behind_links(file);
}

}  // namespace drawpoint::studies
