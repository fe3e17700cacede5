// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A newcomer's walk: docs/writing-a-study.md, followed to the letter.

#include <drawpoint/tests/end_to_end/documents.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

class WritingAStudy : public StudyTest {};

}  // namespace

TEST_F(WritingAStudy, TheDocumentsCommandsWorkAsTyped) {
  EXPECT_EQ(follow(contents(WRITING_A_STUDY), place_).size(), 3u);
  EXPECT_TRUE(contains(contents(place_ / "results/mill/report.html"), "A ball mill"));
  EXPECT_TRUE(contains(contents(place_ / "mill.csv"), "ground_lower [t/h]"));
}
