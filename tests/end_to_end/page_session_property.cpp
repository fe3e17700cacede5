// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Report and replay gone through by a hand: all that can be clicked does what it says, without an error on the
/// console and without a request (page_session.mjs).

#include <drawpoint/tests/end_to_end/support.hpp>

#include <vector>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string cycles = "env TROUBLE=cycles " TROUBLED_STUDY;

class PageSession : public StudyTest {
 protected:
  /// What was done with the page; each of these was among it, and `missing` steps found nothing to do.
  void go_through(const std::filesystem::path& page, const std::vector<std::string>& done,
                  int missing) const {
    const Ended end = run("node " PAGE_SESSION " " + page.string());
    EXPECT_EQ(end.code, 0) << end.out << end.err;
    for (const std::string& line : done) EXPECT_TRUE(contains(end.out, line)) << line << "\n" << end.out;
    int absent = 0;
    const std::string words = "not on this page";
    for (auto at = end.out.find(words); at != std::string::npos; at = end.out.find(words, at + 1)) ++absent;
    EXPECT_EQ(absent, missing) << end.out;
    EXPECT_TRUE(contains(end.out, "console errors: 0, requests: 0")) << end.out;
  }
  std::string replay() const {
    return cycles + " replay --run " + query("SELECT id FROM runs WHERE x <= 0.5 LIMIT 1") + out();
  }
};

TEST_F(PageSession, TheReport) {
  ASSERT_EQ(run(FORMULA_DEMO " --runs 30 --validation 5 --jobs 2 --mark today=1,0.5,0.2,0.2" + out()).code,
            0);
  go_through(dir() / "report.html",
             {"first screen: desktop: ",
              "named: recommended, middle, today\n",
              "table, sorted: from",
              "table, filtered: Copy",
              "table, copied: it says so",
              "table, downloaded: formula_demo_points_of_the_front.csv",
              "row, marked: point",
              "sections: ",
              "colours: the other ones and back",
              "of 200 front points",
              "range in numbers: ",
              "slider: ",
              "surfaces in 3-D: and contours again",
              "nested contours: 16 plots",
              "runs side by side: Run 1, Run 2, difference",
              "what to do next: ",
              "point, pointed at: point",
              "point, clicked: point",
              "line of a design, pointed at and clicked: point",
              "run on a surface, pointed at and clicked: run",
              ".svg, ",
              "paper: ",
              "a phone, from the beginning: "},
             8);  // those of a scene, and of a haul
}

TEST_F(PageSession, TheReplayOfARunOfTwoCycles) {
  ASSERT_EQ(run(cycles + " --runs 12 --validation 0" + out()).code, 0);
  const auto page = place_ / "replay.html";
  ASSERT_EQ(run(replay() + " --file " + page.string()).code, 0);
  go_through(page,
             {"keys in the scene: 0 s, 0.05 s, 2 s", "play: to ", "slider of time: to 1.", "cameras: side",
              "click in a plot of the scene: to ", "payload 2.50 t",
              "plot of the scene, saved: troubled_run_", "cycles: 1, 2"},
             22);  // those of a report
}

TEST_F(PageSession, OneCycleHasAPageAndPicturesOfItsOwn) {
  ASSERT_EQ(run(cycles + " --runs 12 --validation 0" + out()).code, 0);
  const Ended page = run(replay() + " --cycle 2");
  EXPECT_TRUE(contains(page.out, "_cycle_2.html")) << page.err;
  const std::string text = contents(page.out.substr(0, page.out.size() - 1));
  EXPECT_TRUE(contains(text, "Cycle 2."));
  EXPECT_FALSE(contains(text, "Cycle 1."));
  std::vector<std::string> pictures;
  for (const std::string cycle : {"", " --cycle 1", " --cycle 2"}) {
    const auto folder = place_ / ("pictures" + std::to_string(pictures.size()));
    const Ended end = run(replay() + cycle + " --size 320x180 --from 1 --to 1 --frames " + folder.string());
    ASSERT_EQ(end.code, 0) << end.err;
    pictures.push_back(contents(folder / "frame_000001.png"));
  }
  EXPECT_EQ(pictures[0], pictures[1]) << "without a word it is the first cycle";
  EXPECT_NE(pictures[1], pictures[2]);
  expect_refused(replay() + " --cycle 3", 2, "has cycles 1 to 2");
}

}  // namespace
