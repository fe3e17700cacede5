// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Documents followed to the letter: a block that opens with a kind and a file name is that file, a block of
/// the kind sh is typed; one that names a place, such as "sh clone", is typed elsewhere (.ci/run).

#include <drawpoint/tests/end_to_end/support.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace drawpoint::test {

struct Block {
  std::string kind, file, text;
};

inline std::vector<Block> blocks_of(const std::string& page) {
  std::vector<Block> blocks;
  bool inside = false;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (!inside) continue;
      Block block;
      std::istringstream(line.substr(3)) >> block.kind >> block.file;
      blocks.push_back(block);
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
  }
  return blocks;
}

/// Follows the page in the folder, with the programs of a study on the path; expects every command to
/// succeed. Returns what each block of commands printed.
inline std::vector<std::string> follow(const std::string& page, const std::filesystem::path& folder) {
  std::vector<std::string> printed;
  for (const Block& block : blocks_of(page)) {
    if (block.kind != "sh" && !block.file.empty()) std::ofstream(folder / block.file) << block.text;
    if (block.kind != "sh" || !block.file.empty()) continue;
    std::ofstream(folder / "typed.sh")
        << "cd " << folder.string() << "\nPATH=" << STUDY_PROGRAMS
        << ":/usr/bin:$PATH\nexport MPLBACKEND=Agg PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=" << PYTHON_READER
        << "\nset -e\n"
        << block.text;
    const Ended end = Command("sh " + (folder / "typed.sh").string(), folder).wait();
    EXPECT_EQ(end.code, 0) << block.text << end.out << end.err;
    printed.push_back(end.out);
  }
  return printed;
}

}  // namespace drawpoint::test
