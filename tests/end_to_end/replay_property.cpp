// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The page of one run, of a study whose runs beyond x = 0.9 fail without a log and beyond 0.5 with one.

#include <drawpoint/tests/end_to_end/support.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string study = "env TROUBLE=drawn " TROUBLED_STUDY;

class ReplayCommand : public StudyTest {
 protected:
  ReplayCommand() { made_ = run(study + " --runs 12 --validation 4" + out()); }

  std::string id_of(const std::string& condition) const {
    return query("SELECT id FROM runs WHERE " + condition + " LIMIT 1");
  }
  std::filesystem::path page_of(const std::string& id) const {
    return dir() / ("replay_" + std::string(4 - id.size(), '0') + id + ".html");
  }
  void expect_no_replay(const std::string& run_id, int code, const std::string& words) const {
    expect_refused(study + " replay --run " + run_id + out(), code, words);
  }

  Ended made_;
};

TEST_F(ReplayCommand, WritesThePageAndSaysWhere) {
  ASSERT_EQ(made_.code, 0) << made_.err;
  for (const std::string status : {"done", "failed"}) {
    const std::string id = id_of("x <= 0.9 AND status = '" + status + "'");
    const Ended end = run(study + " replay --run " + id + out());
    EXPECT_EQ(end.code, 0) << end.err;
    EXPECT_EQ(end.out, page_of(id).string() + "\n");
    const std::string page = contents(page_of(id));
    EXPECT_TRUE(contains(page, "<title>troubled, run " + id + "</title>"));
    EXPECT_TRUE(contains(page, "\"columns\":[\"hours\",\"wear\"]"));
    EXPECT_EQ(page.find("\"reason\":\"spilled\"") != std::string::npos, status == "failed");
  }
  const auto named = place_ / "here.html";
  EXPECT_EQ(run(study + " replay --run " + id_of("x <= 0.5") + " --file " + named.string() + out()).out,
            named.string() + "\n");
  EXPECT_TRUE(std::filesystem::exists(named));
}

TEST_F(ReplayCommand, SaysWhyThereIsNone) {
  expect_no_replay("17", 2, "--run 17: the study in " + dir().string() + " has runs 1 to 16");
  expect_no_replay("0", 2, "--run");
  const std::string jammed = id_of("x > 0.9");
  expect_no_replay(jammed, 1, "run " + jammed + " wrote no log. It failed: jammed. Choose a run that did");
  const std::string done = id_of("status = 'done'");
  const auto log = dir() / "logs" / ("run_" + std::string(4 - done.size(), '0') + done + ".h5");
  std::ofstream(log, std::ios::app) << "more";
  expect_no_replay(done, 1,
                   log.string() + " is damaged, or not what the run wrote; make it again with evaluate");
  EXPECT_FALSE(std::filesystem::exists(page_of(done)));
}

}  // namespace
