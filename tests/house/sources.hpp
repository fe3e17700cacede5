// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

/// The repository's sources as text, for the tests that read them: paths are relative to the root and in
/// order. Only *.hpp, *.cpp and *.h count; folders that start with a dot and node_modules are skipped.
namespace drawpoint::house {

struct Source {
  std::string path;  ///< relative, with '/'
  std::string text;
};

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline bool skipped(const std::filesystem::path& folder) {
  const std::string name = folder.filename().string();
  return name.starts_with(".") || name == "node_modules";
}

inline std::vector<Source> sources(const std::filesystem::path& root,
                                   const std::vector<std::string>& folders) {
  std::vector<Source> found;
  for (const std::string& folder : folders) {
    if (!std::filesystem::exists(root / folder)) continue;
    std::filesystem::recursive_directory_iterator entry(root / folder), end;
    for (; entry != end; ++entry) {
      const std::filesystem::path& path = entry->path();
      if (entry->is_directory() && skipped(path)) entry.disable_recursion_pending();
      const std::string extension = path.extension().string();
      if (!entry->is_regular_file() || (extension != ".hpp" && extension != ".cpp" && extension != ".h"))
        continue;
      found.push_back({path.lexically_relative(root).generic_string(), read_text(path)});
    }
  }
  std::sort(found.begin(), found.end(), [](const Source& a, const Source& b) { return a.path < b.path; });
  return found;
}

/// One message for a test to show.
inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace drawpoint::house
