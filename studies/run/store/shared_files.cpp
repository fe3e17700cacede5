// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/studies/run/store/shared_files.h>
#include <drawpoint/doe/detail/atomic_file.hpp>

#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <system_error>

namespace drawpoint::studies {

namespace fs = std::filesystem;

void remember_shared(const Folder& folder, const fs::path& written) {
  std::map<std::string, std::string> sums;  // by name, so that equal folders give equal files
  for (const auto& entry : fs::recursive_directory_iterator(written)) {
    if (entry.is_regular_file())
      sums[fs::relative(entry.path(), written).string()] = file_checksum(entry.path());
  }
  std::string text;
  for (const auto& [name, sum] : sums) text += sum + ' ' + name + '\n';
  doe::write_file(folder.shared_checksums(), text);
}

void check_shared(const Folder& folder) {
  std::ifstream lines(folder.shared_checksums());
  for (std::string line; std::getline(lines, line);) {
    const auto space = line.find(' ');
    if (space == std::string::npos) continue;
    const fs::path file = folder.shared() / line.substr(space + 1);
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored) && file_checksum(file) == line.substr(0, space)) continue;
    throw std::runtime_error(
        "studies: " + file.string() +
        " is not what the preparation wrote; runs that use it would fail or differ. Remove "
        "the folder " +
        folder.shared().string() + ", and the same command prepares it again");
  }
}

}  // namespace drawpoint::studies
