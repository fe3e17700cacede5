// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The study that is kept in studies/results, read as docs/tutorials/a-study-read.md does: what the page shows is what
/// its commands print.

#include <drawpoint/tests/end_to_end/documents.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

class KeptStudyPage : public StudyTest {};

}  // namespace

TEST_F(KeptStudyPage, ShowsWhatItsCommandsPrint) {
  const std::string page = contents(TWO_HOURS);
  std::filesystem::copy(KEPT_STUDIES, place_, std::filesystem::copy_options::recursive);
  std::vector<std::string> shown;
  for (const Block& block : blocks_of(page)) {
    if (block.kind == "text") shown.push_back(block.text);
  }
  EXPECT_EQ(follow(page, place_), shown)
      << "copy to docs/tutorials/a-study-read.md what is printed now, and read it again";
}
