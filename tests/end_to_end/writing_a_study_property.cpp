// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A newcomer's walk: docs/tutorials/first-study.md, followed to the letter.

#include <drawpoint/tests/end_to_end/documents.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

class WritingAStudy : public StudyTest {};

}  // namespace

TEST_F(WritingAStudy, TheDocumentsCommandsWorkAsTyped) {
  const std::vector<std::string> printed = follow(contents(WRITING_A_STUDY), place_);
  ASSERT_EQ(printed.size(), 5u);
  EXPECT_TRUE(contains(printed[1], "mill: 31 training and 10 validation runs, "));
  EXPECT_TRUE(contains(printed[4], "mill: 41 training, 8 adaptive, "));
  EXPECT_TRUE(std::filesystem::exists(place_ / "results/imported/report.html"));
  EXPECT_TRUE(contains(contents(place_ / "results/mill/report.html"), "A ball mill"));
  EXPECT_TRUE(contains(contents(place_ / "mill.csv"), "ground_lower [t/h]"));
}
