// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A point that a user has named once is known to the folder: to its report, its recommendation and its status.

#include <drawpoint/tests/end_to_end/support.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string study = TROUBLED_STUDY;  // x from 0 to 1, y from -5 to 25

class Marks : public StudyTest {
 protected:
  nlohmann::json against(const std::string& options = "") const {
    const Ended end = run(study + " recommend --json" + options + out());
    EXPECT_EQ(end.code, 0) << end.err;
    return end.json()["against"];
  }
  std::string status() const { return run(study + " status" + out()).out; }
  std::string page() const { return contents(dir() / "report.html"); }
};

TEST_F(Marks, AreKeptWithTheStudyReplacedAndTakenAway) {
  ASSERT_EQ(
      run(study + " --runs 10 --validation 4 --mark today=0.5,2 --mark 'reference=0.25,4'" + out()).code, 0);
  EXPECT_TRUE(contains(page(), R"("name":"today")"));
  EXPECT_EQ(against(), nlohmann::json({{"x", 0.25}, {"y", 4.0}}));
  EXPECT_TRUE(contains(status(), "marks: today=0.5,2 reference=0.25,4\n"));
  EXPECT_EQ(run(study + " status --json" + out()).json()["marks"]["today"],
            nlohmann::json({{"x", 0.5}, {"y", 2.0}}));
  ASSERT_EQ(run(study + " report" + out()).code, 0);
  EXPECT_TRUE(contains(page(), R"("name":"today")")) << "without naming it again";
  // Another command puts another in its place, says so, and it stays.
  const Ended replaced = run(study + " recommend --mark reference=0.5,3" + out());
  ASSERT_EQ(replaced.code, 0) << replaced.err;
  EXPECT_TRUE(contains(replaced.out, "mark reference=0.5,3 takes the place of reference=0.25,4\n"));
  EXPECT_EQ(against(), nlohmann::json({{"x", 0.5}, {"y", 3.0}}));
  const Ended same = run(study + " report --mark reference=0.5,3" + out());
  EXPECT_FALSE(contains(same.out, "takes the place")) << "nothing is replaced";
  ASSERT_EQ(run(study + " confirm --points 1 --rounds 1 --mark tomorrow=0.75,1" + out()).code, 0);
  EXPECT_TRUE(contains(status(), "marks: today=0.5,2 reference=0.5,3 tomorrow=0.75,1\n"));
  // Taken away, the reference is the middle again.
  const Ended gone = run(study + " report --mark reference= --mark today=" + out());
  ASSERT_EQ(gone.code, 0) << gone.err;
  EXPECT_TRUE(contains(gone.out, "mark today=0.5,2 is taken away\n"));
  EXPECT_FALSE(contains(page(), R"("name":"today")"));
  EXPECT_EQ(against(), nlohmann::json({{"x", 0.5}, {"y", 10.0}}));
  EXPECT_TRUE(contains(status(), "marks: tomorrow=0.75,1\n"));
}

TEST_F(Marks, OneNameTwiceOrNoneToTakeAwayIsRefusedBeforeAnythingIsDone) {
  expect_refused(
      study + " --mark today=0.5,2 --mark today=0.6,2" + out(), 2,
      "--mark today=0.5,2 and --mark today=0.6,2: one name, two points; give each point a name of its own");
  expect_refused(study + " --mark today= --mark today=0.6,2" + out(), 2,
                 "--mark today= and --mark today=0.6,2: ");
  EXPECT_FALSE(std::filesystem::exists(dir()));
  ASSERT_EQ(run(study + " --runs 6 --validation 2 --mark today=0.5,2" + out()).code, 0);
  const std::string before = contents(dir() / "report.html");
  expect_refused(study + " report --mark yesterday=" + out(), 2,
                 "--mark yesterday=: the folder " + dir().string() +
                     " has no mark of this name to take away; it has today");
  EXPECT_EQ(contents(dir() / "report.html"), before);
}

}  // namespace
