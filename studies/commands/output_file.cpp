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

}  // namespace

void check_output_file(const Folder& folder, const fs::path& file, const std::string& option) {
  for (const fs::path& own :
       {folder.store(), folder.logs(), folder.shared(), folder.shared_checksums(), folder.slurm()}) {
    if (is_within(file, own))
      throw UsageError(option + ": " + file.string() + " is where the study keeps its own (" + own.string() +
                       "); name another");
  }
}

}  // namespace drawpoint::studies
