// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Responses taken anew from the logs of a study: what the runs gave where nothing has changed, the new
/// values where something has, and never a run again.

#include <drawpoint/tests/end_to_end/support.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string study = "env TROUBLE=logged " TROUBLED_STUDY;
const char* const rows =
    "SELECT group_concat(id || kind || point || quote(x) || quote(y) || seed || status || coalesce(reason, "
    "'') || "
    "quote(cost) || "
    "quote(wear) || seconds || started || finished || log) FROM runs";

class RerunResponses : public StudyTest {
 protected:
  RerunResponses() { made_ = run(study + " --runs 12 --validation 4 --json" + out()); }

  std::filesystem::path anew() const { return place_ / "anew"; }
  std::string command() const {
    return study + " rerun-responses --from " + dir().string() + " --out " + anew().string();
  }
  /// As query, of the new folder.
  std::string query_anew(const std::string& sql) const {
    SQLite::Database store((anew() / "study.db").string(), SQLite::OPEN_READONLY, 10000);
    return store.execAndGet(sql).getString();
  }
  void expect_refused(const std::string& line, int code, const std::string& words) const {
    const Ended end = run(line);
    EXPECT_EQ(end.code, code);
    EXPECT_TRUE(contains(end.err, words));
    EXPECT_FALSE(std::filesystem::exists(anew()));
  }

  Ended made_;
};

TEST_F(RerunResponses, WhatDidNotChangeComesOutBitForBit) {
  ASSERT_EQ(made_.code, 0) << made_.err;
  const Ended end = run(command() + "/ --json");  // as the shell completes the folder's name
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(query_anew(rows), query(rows));
  EXPECT_GT(count("status = 'failed'"), 0);
  EXPECT_EQ(end.json()["nrmse"], made_.json()["nrmse"]);
  EXPECT_TRUE(std::filesystem::exists(anew() / "report.html"));
}

TEST_F(RerunResponses, AnOptionOfResponsesMakesAFolderThatGoesOn) {
  const std::string before = query(rows);
  EXPECT_EQ(run(command() + " --price=3").code, 0);
  EXPECT_EQ(query(rows), before);
  const std::string price = "SELECT group_concat(quote(3 * cost)) FROM runs";
  EXPECT_EQ(query_anew("SELECT group_concat(quote(cost)) FROM runs"), query(price));
  EXPECT_EQ(run(study + " --runs 14 --out " + anew().string()).code, 0);
  EXPECT_EQ(query_anew("SELECT count(*) FROM runs WHERE status != 'planned'"), "18");
  const Ended other = run(study + " --price=3" + out());
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.err, "option price: 1 there, 3 here"));
}

TEST_F(RerunResponses, ConfirmedPointsBecomeAdaptiveOnes) {
  ASSERT_EQ(run(study + " confirm --points 2 --rounds 1" + out()).code, 0);
  ASSERT_EQ(run(command() + " --price=2").code, 0);
  EXPECT_EQ(query_anew("SELECT count(*) FROM runs WHERE kind = 'adaptive'"),
            query("SELECT count(*) FROM runs WHERE kind = 'confirmation'"));
  EXPECT_EQ(query_anew("SELECT count(cost_predicted) FROM runs"), "0");
  const Ended more = run(study + " --json --out " + anew().string());
  EXPECT_EQ(more.code, 0) << more.err;
  EXPECT_EQ(more.json()["unfinished"], 0);
}

TEST_F(RerunResponses, ALostLogIsNamedAndNothingIsWritten) {
  const std::string good = query("SELECT id FROM runs WHERE status = 'done' LIMIT 1");
  std::ofstream(dir() / "logs" / ("run_000" + good + ".h5"), std::ios::app) << "more";
  expect_refused(command(), 1, "no sound log of run " + good);
}

TEST_F(RerunResponses, WhatCannotBeIsRefused) {
  expect_refused(command() + " --rock=waste", 2, "option rock: ore there, waste here");
  expect_refused("env TROUBLE=none " TROUBLED_STUDY " rerun-responses --from " + dir().string() + " --out " +
                     anew().string(),
                 2, "does not say how its responses follow from a run's log");
  expect_refused(study + " rerun-responses --from " + place_.string() + " --out " + anew().string(), 1,
                 "there is no study in");
  const Ended onto_itself = run(study + " rerun-responses --from " + dir().string() + out());
  EXPECT_EQ(onto_itself.code, 2);
  EXPECT_TRUE(contains(onto_itself.err, "is not empty, and what is there is not touched"));
}

}  // namespace
