// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A newcomer's walk: docs/writing-a-study.md, followed to the letter. A block that opens with a kind and a
/// file name is that file, a block of the kind sh is typed.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <sstream>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

struct Block {
  std::string kind, file, text;
};

std::vector<Block> blocks_of(const std::string& page) {
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

class WritingAStudy : public StudyTest {};

}  // namespace

TEST_F(WritingAStudy, TheDocumentsCommandsWorkAsTyped) {
  int typed = 0;
  for (const Block& block : blocks_of(contents(WRITING_A_STUDY))) {
    if (!block.file.empty()) std::ofstream(place_ / block.file) << block.text;
    if (block.kind != "sh") continue;
    std::ofstream(place_ / "typed.sh")
        << "cd " << place_.string() << "\nPATH=" << STUDY_PROGRAMS << ":$PATH\nset -e\n"
        << block.text;
    const Ended end = run("sh " + (place_ / "typed.sh").string());
    EXPECT_EQ(end.code, 0) << block.text << end.out << end.err;
    ++typed;
  }
  EXPECT_EQ(typed, 3);
  EXPECT_TRUE(contains(contents(place_ / "results/mill/report.html"), "A ball mill"));
  EXPECT_TRUE(contains(contents(place_ / "mill.csv"), "ground_lower [t/h]"));
}
