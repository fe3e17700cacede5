// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The page of a study: what it computes in the browser is what the models say, and all of it is drawn.

#include <drawpoint/tests/end_to_end/support.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

/// What stands outside of scripts.
std::string without_scripts(const std::string& page) {
  std::string rest;
  for (std::size_t at = 0; at != std::string::npos;) {
    const std::size_t open = page.find("<script", at);
    rest += page.substr(at, open - at);
    at = open == std::string::npos ? open : page.find("</script>", open);
  }
  return rest;
}

class ReportPage : public StudyTest {
 protected:
  /// What a browser makes of the page, as markup, its programs and data left out.
  std::string drawn() const {
    const Ended page =
        run("chromium --headless --no-sandbox --disable-gpu --use-angle=swiftshader "
            "--enable-unsafe-swiftshader --virtual-time-budget=20000 --dump-dom file://" +
            (dir() / "report.html").string());
    EXPECT_EQ(page.code, 0) << page.err;
    return without_scripts(page.out);
  }
};

TEST_F(ReportPage, SaysOfTheFrontWhatIsExported) {
  const std::string demo = FORMULA_DEMO;
  ASSERT_EQ(run(demo + " --runs 30 --validation 5 --jobs 2" + out()).code, 0);
  const std::string table = (dir() / "front.json").string();
  ASSERT_EQ(run(demo + " export --what front --format json --file " + table + out()).code, 0);
  const Ended checked =
      run("node " + std::string(PAGE_NUMBERS) + " " + (dir() / "report.html").string() + " " + table);
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_TRUE(contains(checked.out, "points agree"));

  const std::string page = drawn();
  EXPECT_TRUE(contains(page, "data-ready=\"true\""));
  EXPECT_EQ(page.find("could not be drawn:"), std::string::npos);
  for (const char* part :
       {"asks for production as large as possible", "Non-dominated: how likely", "The shaded band is where",
        "The band holds the mean of many runs with 95 %", "Nested contours"})
    EXPECT_TRUE(page.find(part) != std::string::npos) << part;
}

// The study of throw.json, whose ore may not land harder than 48 kJ/t: about half of the box throws it harder.
TEST_F(ReportPage, MarksWhatBreaksALimit) {
  const std::filesystem::path place = dir().parent_path(), from = THROW_JSON;
  std::filesystem::copy_file(from.parent_path() / "throw.py", place / "throw.py");
  std::string study = contents(from);
  const std::string goal = "\"goal\": \"minimize\"";
  ASSERT_NE(study.find(goal), std::string::npos);
  study.replace(study.find(goal), goal.size(), "\"goal\": \"at_most\", \"limit\": 48");
  std::ofstream(place / "throw.json") << study;
  const std::string program = std::string(EXTERNAL_PROGRAM) + " " + (place / "throw.json").string();
  ASSERT_EQ(run(program + " --runs 16 --validation 4 --jobs 2" + out()).code, 0);
  EXPECT_GT(count("impact > 48"), 0);
  EXPECT_GT(count("impact <= 48"), 0);
  const std::string page = drawn();
  EXPECT_EQ(page.find("could not be drawn:"), std::string::npos);
  for (const char* part : {"with impact of at most 48.0 kJ/t", "breaks impact at most 48.0 kJ/t",
                           "An open triangle (▽) is a run that breaks a limit", "training, breaks a limit",
                           "Highest reach predicted within the limits"})
    EXPECT_TRUE(page.find(part) != std::string::npos) << part;
}

}  // namespace
