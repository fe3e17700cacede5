// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Whatever goes wrong is said in clear words, with exit code 2 for wrong usage and 1 for failure, and
/// nothing is lost.

#include <drawpoint/tests/end_to_end/support.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string study = TROUBLED_STUDY;

std::string with(const std::string& trouble) { return "env TROUBLE=" + trouble + " " + study + " "; }

class BadInput : public StudyTest {
 protected:
  /// The study ends well; its runs beyond x = 0.5 have failed, with this reason.
  void expect_failed_runs(const std::string& trouble, const std::string& reason,
                          const std::string& options = "") {
    std::filesystem::remove_all(dir());
    const Ended end = run(with(trouble) + "--runs 12 --validation 4 --json " + options + out());
    ASSERT_EQ(end.code, 0) << end.err;
    EXPECT_EQ(count("status = 'failed' AND x > 0.5 AND cost IS NULL"), count("x > 0.5"));
    EXPECT_EQ(count("status = 'done'"), count("x <= 0.5"));
    EXPECT_EQ(end.json()["failed"], count("x > 0.5"));
    EXPECT_GE(count("status = 'failed'"), 4);
    EXPECT_TRUE(
        contains(query("SELECT group_concat(DISTINCT reason) FROM runs WHERE status = 'failed'"), reason));
  }
};

TEST_F(BadInput, WrongUsage) {
  expect_refused(study + " --runs -5" + out(), 2, "--runs: Value -5 not in range");
  expect_refused(study + " --runs many" + out(), 2, "--runs");
  expect_refused(study + " --validation -1" + out(), 2, "--validation");
  expect_refused(study + " --jobs 0" + out(), 2, "--jobs");
  expect_refused(study + " --seed -1" + out(), 2, "--seed");
  expect_refused(study + " --seed 99999999999999999999" + out(), 2,
                 "give a whole number from 0 to 18446744073709551615");
  expect_refused(study + " --time-limit nan" + out(), 2, "--time-limit: Value nan is no time");
  expect_refused(study + " --out ''", 2, "--out: an empty name");
  expect_refused(study + " evaluate", 2, "give a point with --x, or a run of a study with --run");
  expect_refused(study + " --sed 1" + out(), 2, "--sed");
  expect_refused(study + " --criteria lola=1" + out(), 2, "\"lola=1\" is no criterion and weight");
  expect_refused(study + " --target 2" + out(), 2, "Value 2 is no share of the range; give 0 to 1");
  expect_refused(study + " --target nan" + out(), 2, "Value nan is no share of the range");
  expect_refused(study + " --hours nan" + out(), 2, "Value nan is no time");
  expect_refused(study + " --target 0.1 --validation 0" + out(), 2, "give --validation 10 or more");
  expect_refused(study + " --adaptive -1" + out(), 2, "--adaptive");
  expect_refused(study + " --mark today" + out(), 2, "--mark today: no name; give NAME=x,y");
  expect_refused(study + " --mark today=1" + out(), 2,
                 "\"today\": it has 1 values; give 2, one per variable");
  expect_refused(study + " --mark today=0.5,north" + out(), 2, "\"north\" is no number");
  expect_refused(study + " --mark today=0.5,26" + out(), 2, "y = 26 deg is outside its range -5 to 25 deg");
  expect_refused(study + " confirm --points 0" + out(), 2, "--points");
  expect_refused(study + " confirm --x=0.5,26" + out(), 2, "y = 26 deg is outside its range -5 to 25 deg");
  expect_refused(study + " confirm" + out(), 1, "there is no study in");
  expect_refused(study + " export --format xls" + out(), 2, "--format");
  expect_refused(study + " ask --format hdf5" + out(), 2, "--format");
  expect_refused(study + " export" + out(), 1, "there is no study in");
  expect_refused(
      study + " frobnicate", 2,
      "unknown command \"frobnicate\"; the commands are run, check, confirm, ask, tell, exclude, "
      "status, live, fit, validate, "
      "front, predict, recommend, compare, report, replay, export, share, open, rerun-responses, evaluate");
  expect_refused(study + " front --limit 0" + out(), 2, "--limit");
  expect_refused(study + " front" + out(), 1, "there is no study in");
  expect_refused(study + " compare" + out(), 2, "--with is required");
  expect_refused(study + " compare --with ''" + out(), 2, "--with: an empty name");
  expect_refused(study + " replay" + out(), 2, "--run is required");
  expect_refused(study + " replay --run 1" + out(), 2, "does not say what to draw of a run's log");
  expect_refused(study + " evaluate --x 0.5", 2, "--x: got 1 values, need 2: x, y");
  expect_refused(study + " evaluate --x=0.5,26", 2, "y = 26 deg is outside its range -5 to 25 deg");
  EXPECT_FALSE(std::filesystem::exists(dir()));
}

// An option that the study declares reaches every run, is kept with the folder, and is refused like any
// other.
TEST_F(BadInput, OptionsOfTheStudy) {
  expect_refused(study + " --rock coal" + out(), 2,
                 "\"coal\" is not one of the values of --rock; allowed: ore, waste");
  EXPECT_TRUE(contains(run(study + " run --help").out, "what is loaded: ore, waste (default ore"));
  EXPECT_EQ(run(with("options") + "evaluate --x=0.2,5 --rock ore").code, 0);
  const Ended failed = run(with("options") + "evaluate --x=0.2,5 --rock=waste");
  EXPECT_EQ(failed.code, 1);
  EXPECT_TRUE(contains(failed.err, "only waste"));
  ASSERT_EQ(run(with("options") + "--runs 12 --validation 0 --rock ore --json" + out()).code, 0);
  EXPECT_EQ(count("status = 'done'"), 12);
  expect_refused(study + " --rock waste" + out(), 2, "option rock: ore there, waste here");
}

// A table is not written over what the study is.
TEST_F(BadInput, OutputWhereTheStudyKeepsItsOwn) {
  ASSERT_EQ(run(study + " --runs 12 --validation 0" + out()).code, 0);
  const std::string before = contents(dir() / "study.db");
  for (const std::string own : {"/study.db", "/logs/run_0001.h5", "/logs/../study.db"})
    expect_refused(study + " export --file " + dir().string() + own + out(), 2,
                   "is where the study keeps its own");
  EXPECT_EQ(contents(dir() / "study.db"), before);
}

TEST_F(BadInput, WrongBounds) {
  expect_refused(with("bounds") + out(), 1,
                 "variable \"y\": lower bound 25 deg is not below upper bound -5 deg; swap them");
  EXPECT_FALSE(std::filesystem::exists(dir()));
}

// Whether a run ends by itself or is killed, what it has written of its log is kept as one file.
TEST_F(BadInput, RunsThatDieBetweenPartsOfTheirLog) {
  ASSERT_EQ(run(with("parts") + "--runs 12 --validation 0 --json" + out()).code, 0);
  EXPECT_GT(count("status = 'failed'"), 0);
  EXPECT_GT(count("status = 'done'"), 0);
  int logs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(dir() / "logs")) {
    if (entry.path().extension() == ".txt") continue;
    EXPECT_EQ(entry.path().extension(), ".h5");
    EXPECT_EQ(contents(entry.path()), "first\nsecond\n") << entry.path();
    ++logs;
  }
  EXPECT_EQ(logs, 12);
}

TEST_F(BadInput, RunsThatThrow) { expect_failed_runs("throw", "the bucket is stuck"); }

// Everything beyond x = 0.5 fails: fit, page and exported front say so, and no point of the front lies there.
// (wear is least at x = 1, so that without the failures the front would reach there.)
TEST_F(BadInput, WhereRunsFailIsKnown) {
  const Ended end = run(with("throw") + "--runs 24 --validation 8 --json" + out());
  ASSERT_EQ(end.code, 0) << end.err;
  const auto success = run(study + " fit --json" + out()).json()["success"];
  EXPECT_EQ(success["runs"], 32);
  EXPECT_EQ(success["failed"], count("status = 'failed'"));
  EXPECT_GT(success["left_out_score"], success["share_score"]);
  EXPECT_LT(success["length_scales"]["x"], success["length_scales"]["y"]);
  const std::string page = contents(dir() / "report.html");
  EXPECT_TRUE(contains(page, "The place tells which runs fail ("));
  for (const auto& point : run(study + " front --json" + out()).json()["points"])
    EXPECT_GE(point["success"].get<double>(), 0.5);
  EXPECT_TRUE(contains(run(study + " front" + out()).out, "a run succeeds"));
  const auto front = run(study + " export --what front --format json" + out()).json();
  EXPECT_EQ(front["columns"].back()["name"], "success");
  ASSERT_GT(front["rows"].size(), 0u);
  for (const auto& row : front["rows"]) {
    EXPECT_LT(row[0].get<double>(), 0.6);
    EXPECT_GE(row.back().get<double>(), 0.5);
  }
}
TEST_F(BadInput, RunsThatAreNotFinite) { expect_failed_runs("nan", "response \"wear\" is nan"); }
TEST_F(BadInput, RunsWithAWrongCount) {
  expect_failed_runs("count", "returned 3 values where the problem has 2 responses");
}
TEST_F(BadInput, RunsThatExit) { expect_failed_runs("exit", "ended with exit code 7"); }
TEST_F(BadInput, RunsThatHang) {
  expect_failed_runs("hang", "stopped after 5 s, its time limit", "--jobs 8 --time-limit 5");
}

TEST_F(BadInput, RunsThatCrashAndARetry) {
  expect_failed_runs(
      "crash", "ended by signal SIGSEGV (Segmentation fault); it printed last \"about to crash\" (logs/run_");
  const std::string id = query("SELECT id FROM runs WHERE status = 'failed'");
  EXPECT_EQ(contents(dir() / "logs" / ("run_" + std::string(4 - id.size(), '0') + id + ".txt")),
            "about to crash\n");
  EXPECT_EQ(run(study + out()).code, 0);
  EXPECT_GE(count("status = 'failed'"), 4);  // not without being asked
  EXPECT_EQ(run(study + " --retry-failed" + out()).code, 0);
  EXPECT_EQ(count("status = 'done'"), 16);
}

TEST_F(BadInput, NothingButFailuresIsAFailureThatSaysWhy) {
  const Ended end = run(with("all") + "--runs 5 --validation 2 --keep-going --json" + out());
  EXPECT_EQ(end.code, 1);
  EXPECT_EQ(end.json()["failed"], 7);
  EXPECT_TRUE(end.json()["report"].is_null());
  EXPECT_TRUE(contains(end.err, "the bucket is stuck"));
}

TEST_F(BadInput, ABlackBoxThatPrintsDoesNotDisturbScripts) {
  const Ended end = run(with("print") + "--runs 6 --validation 0 --json" + out());
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.json()["failed"], 0);
  EXPECT_EQ(end.out.find('\n'), end.out.size() - 1);
  EXPECT_EQ(contents(dir() / "logs" / "run_0001.txt"), "a black box that prints\n");
}

TEST_F(BadInput, PreparationIsKeptWholeOrNotAtAll) {
  expect_refused(with("unprepared") + "--runs 6 --json" + out(), 1,
                 "the preparation failed: exception: the pile does not settle");
  EXPECT_FALSE(std::filesystem::exists(dir() / "shared"));
  EXPECT_EQ(count("status = 'planned'"), 10);
  const Ended end = run(with("shared") + "--json" + out());
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.json()["failed"], 0);
  EXPECT_EQ(contents(dir() / "shared" / "pile.txt"), "settled\n");
  EXPECT_EQ(contents(dir() / "logs" / "run_0010.h5").size(), 10u);
}

// An empty pile would fail every run for good.
TEST_F(BadInput, ADamagedPreparationIsNamedBeforeARunFails) {
  ASSERT_EQ(run(with("shared") + "--runs 6 --validation 0" + out()).code, 0);
  const auto pile = dir() / "shared" / "pile.txt";
  std::filesystem::resize_file(pile, 0);
  for (const char* command : {"--runs 8", "confirm"}) {
    const Ended end = run(with("shared") + command + out());
    EXPECT_EQ(end.code, 1);
    EXPECT_TRUE(contains(end.err, pile.string() + " is not what the preparation wrote"));
    EXPECT_EQ(count("status = 'failed'"), 0);
  }
  std::filesystem::remove_all(dir() / "shared");
  EXPECT_EQ(run(with("shared") + "--runs 8" + out()).code, 0);
  EXPECT_EQ(count("status = 'done'"), 8);
  EXPECT_EQ(contents(pile), "settled\n");
}

TEST_F(BadInput, FoldersOfOthersStayAsTheyAre) {
  std::filesystem::create_directories(dir());
  std::ofstream(database()) << "these are my notes, not a database\n";
  expect_refused(study + out(), 1, "not a database");
  EXPECT_EQ(contents(database()), "these are my notes, not a database\n");
  std::filesystem::remove(database());
  SQLite::Database(database().string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE runs (mine TEXT)");
  const std::string before = contents(database());
  for (const std::string command : {" run", " status", " report"}) {
    expect_refused(study + command + out(), 1, "not the store of a Drawpoint study");
  }
  EXPECT_EQ(contents(database()), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir()), {}), 1);
}

TEST_F(BadInput, AnotherStudyInTheFolder) {
  ASSERT_EQ(run(study + " --runs 6 --validation 2" + out()).code, 0);
  expect_refused(study + " --seed 5" + out(), 2, "seed 1 there, 5 here");
  expect_refused(study + " --runs 5" + out(), 2, "use --runs 6 or more");
  expect_refused(with("changed") + out(), 2, "variable \"y\": upper bound 25.0 there, 30.0 here");
  expect_refused(FORMULA_DEMO + out(), 2, "name \"troubled\" there, \"formula_demo\" here");
  EXPECT_EQ(count("status = 'done'"), 8);
}

TEST_F(BadInput, ALinkToNothingIsNamed) {
  std::filesystem::create_symlink("/nowhere/there", dir());
  expect_refused(study + out(), 1, "is a link to /nowhere/there, which is not there");
}

TEST_F(BadInput, ARunByHandFillsTheFolderThatItNames) {
  const auto folder = place_ / "deep" / "shared";
  const std::string one = with("shared") + "evaluate --x=0.5,0.5 --shared " + folder.string();
  ASSERT_EQ(run(one).code, 0);
  EXPECT_EQ(contents(folder / "pile.txt"), "settled\n");
  std::ofstream(folder / "pile.txt") << "kept";
  ASSERT_EQ(run(one).code, 0);
  EXPECT_EQ(contents(folder / "pile.txt"), "kept") << "it is filled once";
  const auto other = place_ / "other";
  EXPECT_NE(run(with("unprepared") + "evaluate --x=0.5,0.5 --shared " + other.string()).code, 0);
  EXPECT_FALSE(std::filesystem::exists(other));
}

// A run is made again from its number: point, seed, options and shared folder are the study's.
TEST_F(BadInput, ARunIsMadeAgainFromItsNumber) {
  ASSERT_EQ(run(with("shared") + "--runs 6 --validation 2 --rock waste" + out()).code, 0);
  const Ended end = run(with("shared") + "evaluate --run 7 --json" + out());
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.json()["as_stored"], true);
  EXPECT_EQ(end.json()["values"]["cost"].get<double>(),
            std::stod(query("SELECT printf('%!.17g', cost) FROM runs WHERE id = 7")));
  const Ended other = run(with("all") + "evaluate --run 7" + out());
  EXPECT_EQ(other.code, 1);
  EXPECT_TRUE(contains(other.err, "run 7: not as stored")) << other.err;
  expect_refused(study + " evaluate --run 9" + out(), 2, "has runs 1 to 8");
  expect_refused(study + " evaluate --run 1 --rock ore" + out(), 2,
                 "its options are the study's; leave out --rock");
}

// Damaged, or exchanged for another run's: the report leaves it out and names it.
TEST_F(BadInput, ALogThatIsNotItsRunsIsNamed) {
  ASSERT_EQ(run(with("large") + "--runs 6 --validation 0" + out()).code, 0);
  const auto page = [&] {
    EXPECT_EQ(run(study + " report" + out()).code, 0);
    return contents(dir() / "report.html");
  };
  EXPECT_FALSE(contains(page(), "run_0003.h5"));
  std::ofstream(dir() / "logs" / "run_0003.h5", std::ios::app) << "x";
  EXPECT_TRUE(contains(page(), "damaged, or not what their run wrote, are left out: run_0003.h5"));
  std::filesystem::remove(dir() / "logs" / "run_0003.h5");
  EXPECT_TRUE(contains(page(), "The folder has the logs of 5 of 6 runs"));
}

// What is planned does not count as made.
TEST_F(BadInput, AReportOnAnUnfinishedStudyCountsWhatEnded) {
  Command command(with("slow") + "--runs 40 --validation 0 --jobs 1" + out(), dir().parent_path());
  await_done(4);
  command.send(SIGINT);
  EXPECT_EQ(command.wait().code, 130);
  const Ended end = run(study + " report --json" + out());
  const int done = count("status = 'done'");
  EXPECT_LT(done, 40);
  EXPECT_EQ(end.json()["training"], done);
  EXPECT_EQ(end.json()["unfinished"], 40 - done);
}

TEST_F(BadInput, AReportNeedsAStudy) {
  expect_refused(study + " report" + out(), 1, "there is no study in " + dir().string());
  expect_refused(study + " status" + out(), 1, "there is no study in " + dir().string());
}

TEST_F(BadInput, AFullStandardOutput) {
  for (const char* words : {" evaluate --x 0.1,0.1", " --version", " --help", " man-page"}) {
    const Ended end = run(study + words + " > /dev/full");
    EXPECT_EQ(end.code, 1) << words;
    EXPECT_TRUE(contains(end.err, "cannot write to standard output")) << words;
  }
}

}  // namespace
