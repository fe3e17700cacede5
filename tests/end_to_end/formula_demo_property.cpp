// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The whole pipeline on a formula: what scripts read, what the store holds, and that the same command gives
/// the same result.

#include <sys/stat.h>
#include <drawpoint/tests/end_to_end/support.hpp>

#include <algorithm>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string demo = FORMULA_DEMO;

/// Everything about the runs but the times.
const std::string fingerprint =
    "SELECT group_concat(id || kind || point || seed || status || quote(alpha) || quote(beta) || "
    "quote(gamma) || "
    "quote(kappa) || quote(production) || quote(joint_damage) || quote(rock_spill)) FROM (SELECT * FROM runs "
    "ORDER BY id)";

class FormulaDemo : public StudyTest {};

TEST_F(FormulaDemo, DoesTheWholeJob) {
  const Ended first = run(demo + " --runs 40 --validation 12 --jobs 2" + out() + " --json");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(std::count(first.out.begin(), first.out.end(), '\n'), 1) << first.out;
  const auto line = first.json();
  EXPECT_EQ(line["runs"], 52);
  EXPECT_EQ(line["failed"], 0);
  ASSERT_EQ(line["nrmse"].size(), 3u);
  for (const auto& [response, nrmse] : line["nrmse"].items()) {
    // A model that knows nothing predicts the mean: its NRMSE is the standard deviation over the range, near
    // 0.29 for an even spread. 40 runs of this smooth formula with 2 per cent noise must do several times
    // better.
    EXPECT_LT(nrmse.get<double>(), 0.1) << response;
    EXPECT_GT(nrmse.get<double>(), 0.0) << response;
  }
  EXPECT_GE(line["front"].get<int>(), 20);
  EXPECT_GT(line["certified"].get<int>(), line["front"].get<int>() / 2);
  EXPECT_GE(line["polishing_gain_percent"].get<double>(), 0.0);
  EXPECT_EQ(line["report"], (dir() / "report.html").string());
  EXPECT_TRUE(contains(contents(dir() / "report.html"), "</html>"));
  EXPECT_EQ(count("status = 'done'"), 52);
  EXPECT_EQ(count("kind = 'training' AND alpha IN (0.2, 2.0) AND beta IN (0, 1) AND gamma IN (0, 1) AND "
                  "kappa IN (0, 1)"),
            16);
  EXPECT_EQ(count("alpha BETWEEN 0.2 AND 2.0 AND beta BETWEEN 0 AND 1"), 52);
  EXPECT_EQ(query("SELECT count(DISTINCT seed) FROM runs"), "52");

  // Again: nothing is run, nothing changes, the result is the same.
  const std::string times = query("SELECT group_concat(started || finished) FROM runs");
  const Ended again = run(demo + " report" + out() + " --json");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.json(), line);
  EXPECT_EQ(query("SELECT group_concat(started || finished) FROM runs"), times);
}

TEST_F(FormulaDemo, TableDoesNotDependOnTheNumberOfJobs) {
  ASSERT_EQ(run(demo + " run --runs 20 --validation 5 --jobs 1" + out()).code, 0);
  const std::string one = query(fingerprint);
  std::filesystem::remove_all(dir());
  ASSERT_EQ(run(demo + " run --runs 20 --validation 5 --jobs 4" + out()).code, 0);
  EXPECT_EQ(query(fingerprint), one);
}

TEST_F(FormulaDemo, AdaptiveRunsDoNotDependOnJobsOrOnStops) {
  const std::string options = " --runs 20 --validation 5 --batch 4 --criteria error,lola_voronoi=2";
  const Ended whole = run(demo + options + " --adaptive 12 --jobs 2 --json" + out());
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(whole.json()["adaptive"], 12);
  EXPECT_TRUE(contains(whole.err, "adaptive points 9 to 12 of 12: 28 runs for the models so far; NRMSE"));
  EXPECT_EQ(count("kind = 'adaptive' AND status = 'done' AND production_lower < production_upper"), 12);
  EXPECT_EQ(count("kind != 'adaptive' AND production_predicted IS NOT NULL"), 0);
  const std::string one = query(fingerprint);
  std::filesystem::remove_all(dir());
  ASSERT_EQ(run(demo + options + " --adaptive 4 --jobs 1" + out()).code, 0);
  ASSERT_EQ(run(demo + " --adaptive 12 --hours 0" + out()).code, 0);  // no time: nothing is begun
  EXPECT_EQ(count("kind = 'adaptive'"), 4);
  ASSERT_EQ(run(demo + out()).code, 0);  // the folder knows the rest
  EXPECT_EQ(query(fingerprint), one);
}

TEST_F(FormulaDemo, ATargetThatIsMetEndsTheSampling) {
  const Ended study = run(demo + " --runs 30 --validation 10 --adaptive 50 --target 0.9" + out());
  ASSERT_EQ(study.code, 0) << study.err;
  EXPECT_TRUE(contains(study.out, "no further adaptive runs, the target is met: 30 runs"));
  EXPECT_EQ(count("kind = 'adaptive'"), 0);
}

TEST_F(FormulaDemo, ConfirmSimulatesTheFront) {
  ASSERT_EQ(run(demo + " --runs 30 --validation 10" + out()).code, 0);
  const Ended confirmed = run(demo + " confirm --points 5 --rounds 1 --x=1,0.5,0.5,0.5 --json" + out());
  ASSERT_EQ(confirmed.code, 0) << confirmed.err;
  const auto line = confirmed.json();
  EXPECT_EQ(line["confirmed"]["points"], 6);
  EXPECT_EQ(line["confirmation"], 6);
  EXPECT_EQ(line["confirmed"]["values"], 18);
  EXPECT_TRUE(contains(confirmed.err, "round 1: 6 points to simulate"));
  EXPECT_EQ(count("kind = 'confirmation' AND alpha = 1 AND beta = 0.5 AND gamma = 0.5 AND kappa = 0.5"), 1);
  EXPECT_EQ(count("kind = 'confirmation' AND joint_damage_predicted IS NULL"), 0);
  EXPECT_TRUE(contains(contents(dir() / "report.html"), "within the stated 95 % interval"));
  // The named point is there already; the next round goes elsewhere.
  ASSERT_EQ(run(demo + " confirm --points 2 --rounds 1 --x=1,0.5,0.5,0.5" + out()).code, 0);
  EXPECT_EQ(count("kind = 'confirmation'"), 8);
  EXPECT_EQ(query("SELECT count(DISTINCT alpha || ' ' || beta || ' ' || gamma || ' ' || kappa) FROM runs "
                  "WHERE kind = 'confirmation'"),
            "8");
}

TEST_F(FormulaDemo, ExportsRunsAndFront) {
  ASSERT_EQ(run(demo + " --runs 20 --validation 0" + out()).code, 0);
  const std::string file = (place_ / "runs.csv").string();
  ASSERT_EQ(run(demo + " export --file " + file + out()).code, 0);
  const std::string csv = contents(file);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 21);
  EXPECT_EQ(
      csv.find(
          "run,kind,point,replicate,seed,status,reason,seconds [s],alpha [1],beta [1],gamma [1],kappa [1],"
          "production [kg/s],joint_damage [s],rock_spill [1],production_predicted [kg/s],"),
      0u);
  const Ended as_json = run(demo + " export --format json" + out());
  const auto runs = as_json.json();
  ASSERT_EQ(runs["rows"].size(), 20u);
  EXPECT_EQ(runs["columns"][12]["name"], "production");
  SQLite::Database store(database().string());
  EXPECT_EQ(runs["rows"][3][12].get<double>(),
            store.execAndGet("SELECT production FROM runs WHERE id = 4").getDouble());
  EXPECT_EQ(runs["rows"][3][4], query("SELECT seed FROM runs WHERE id = 4"));
  EXPECT_TRUE(runs["rows"][3][15].is_null());
  const auto front = run(demo + " export --what front --format json" + out()).json();
  EXPECT_EQ(static_cast<int>(front["rows"].size()), run(demo + " report --json" + out()).json()["front"]);
  EXPECT_EQ(front["columns"][4]["unit"], "kg/s");
  EXPECT_EQ(front["columns"][7]["name"], "production_lower");
  for (const auto& row : front["rows"]) EXPECT_LT(row[7].get<double>(), row[10].get<double>());
  EXPECT_EQ(front["columns"][13]["name"], "production_standard_error");
}

TEST_F(FormulaDemo, ExportsTheWholeStudy) {
  ASSERT_EQ(run(demo + " --runs 20 --validation 0" + out()).code, 0);
  const std::string file = (place_ / "study.h5").string(), again = (place_ / "again.h5").string();
  const std::string wanted = demo + " export --format hdf5" + out();
  const Ended end = run(wanted + " --file " + file);
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(contains(end.err, "the study with 20 runs in " + file));
  EXPECT_EQ(run(wanted + " --file " + again).code, 0);
  EXPECT_EQ(contents(file), contents(again));
  expect_refused(wanted, 2, "does not go to standard output; name one with --file");
  expect_refused(wanted + " --what front --file " + file, 2, "holds the runs and the front; leave it out");
  expect_refused(wanted + " --file " + database().string(), 2, "is where the study keeps its own");
}

// What a file takes the place of, whole, is a file: not the pipe or the device that somebody else reads, nor
// a link.
TEST_F(FormulaDemo, ExportsBehindALinkAndToNoDevice) {
  ASSERT_EQ(run(demo + " --runs 20 --validation 0" + out()).code, 0);
  const auto file = place_ / "runs.csv", link = place_ / "link.csv", pipe = place_ / "pipe";
  std::filesystem::create_symlink(file, link);
  EXPECT_EQ(run(demo + " export --file " + link.string() + out()).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_TRUE(std::filesystem::is_regular_file(file));
  const auto asked = place_ / "asked.csv", other_link = place_ / "other.csv";
  std::filesystem::create_symlink("asked.csv", other_link);
  EXPECT_EQ(run(demo + " ask --runs 24 --file " + other_link.string() + out()).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(other_link));
  EXPECT_TRUE(std::filesystem::is_regular_file(asked));
  for (const char* own : {".lock", "study.db-journal", "study.db-wal"})
    expect_refused(demo + " export --file " + (database().parent_path() / own).string() + out(), 2,
                   "is where the study keeps its own");
  const auto loop = place_ / "loop";
  std::filesystem::create_symlink("loop", loop);
  expect_refused(demo + " export --file " + loop.string() + out(), 2, "cannot be reached");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  expect_refused(demo + " export --file " + pipe.string() + out(), 2, "is a device or a pipe");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(FormulaDemo, ShowsTheFrontInTheTerminal) {
  ASSERT_EQ(run(demo + " --runs 20 --validation 0" + out()).code, 0);
  const Ended shown = run(demo + " front --limit 4" + out());
  EXPECT_EQ(shown.code, 0) << shown.err;
  for (const std::string part : {"4 shown", "highest production", "lowest joint_damage", "balanced choice",
                                 "nothing yet; the command confirm",
                                 "Caution: Without a validation run, nothing tells how good the models are."})
    EXPECT_TRUE(contains(shown.out, part));
  const auto front = run(demo + " front --json" + out()).json();
  const auto exported = run(demo + " export --what front --format json" + out()).json()["rows"];
  ASSERT_EQ(front["points"].size(), exported.size());
  EXPECT_EQ(front["points"][2]["x"]["beta"], exported[2][1]);
  EXPECT_EQ(front["points"][2]["predicted"]["production"]["lower"], exported[2][7]);
  const std::string all = run(demo + " front --all" + out()).out;
  EXPECT_GT(std::count(all.begin(), all.end(), '\n'), static_cast<std::ptrdiff_t>(exported.size()));
}

TEST_F(FormulaDemo, SaysHowItIsFittedAndHowThatHolds) {
  ASSERT_EQ(run(demo + " --runs 20 --validation 6" + out()).code, 0);
  const auto fit = run(demo + " fit --json" + out()).json()["models"]["production"];
  EXPECT_EQ(fit["runs"], 20);
  EXPECT_EQ(fit["theta"].size(), 4u);
  EXPECT_LE(fit["leave_one_out"]["within"], 20);
  EXPECT_TRUE(contains(run(demo + " fit" + out()).out, "production [kg/s]: "));
  const auto checked = run(demo + " validate --json" + out()).json()["validations"]["rock_spill"];
  ASSERT_EQ(checked["rows"].size(), 6u);
  int within = 0;
  for (const auto& row : checked["rows"])
    within += row["simulated"] >= row["lower"] && row["simulated"] <= row["upper"];
  EXPECT_EQ(checked["within"], within);
  EXPECT_EQ(
      checked["rows"][0]["simulated"].get<double>(),
      std::stod(query("SELECT printf('%!.17g', rock_spill) FROM runs WHERE kind = 'validation' LIMIT 1")));
  EXPECT_TRUE(contains(run(demo + " validate" + out()).out, "of 6 within their 95 % interval"));
}

TEST_F(FormulaDemo, OnePointByHandIsTheRowOfTheTable) {
  ASSERT_EQ(run(demo + " --runs 6 --validation 0" + out()).code, 0);
  const std::string x =
      query("SELECT printf('%!.17g,%!.17g,%!.17g,%!.17g', alpha, beta, gamma, kappa) FROM runs WHERE id = 4");
  const std::string seed = query("SELECT seed FROM runs WHERE id = 4");
  const Ended point = run(demo + " evaluate --x=" + x + " --seed " + seed + " --json");
  ASSERT_EQ(point.code, 0) << point.err;
  SQLite::Database store(database().string());
  for (const std::string response : {"production", "joint_damage", "rock_spill"}) {
    EXPECT_EQ(point.json()["values"][response].get<double>(),
              store.execAndGet("SELECT " + response + " FROM runs WHERE id = 4").getDouble());
  }
}

TEST_F(FormulaDemo, GrowsAndReplicates) {
  ASSERT_EQ(run(demo + " --runs 8 --validation 2 --replicates 2" + out()).code, 0);
  EXPECT_EQ(count("kind = 'training'"), 16);
  EXPECT_EQ(query("SELECT count(DISTINCT production) FROM runs WHERE kind = 'training' AND point = 3"), "2");
  const Ended grown = run(demo + " --runs 10" + out() + " --json");
  ASSERT_EQ(grown.code, 0) << grown.err;
  EXPECT_EQ(grown.json()["runs"], 22);
  EXPECT_TRUE(contains(grown.err, "18/22 runs"));
}

TEST_F(FormulaDemo, HelpAndVersion) {
  const Ended help = run(demo + " --help");
  EXPECT_EQ(help.code, 0);
  for (const std::string word : {"run", "status", "front", "compare", "replay", "report", "evaluate",
                                 "--validation", "--jobs", "--help-all"}) {
    EXPECT_TRUE(contains(help.out, word));
  }
  EXPECT_LT(std::count(help.out.begin(), help.out.end(), '\n'), 70) << help.out;
  EXPECT_TRUE(contains(run(demo + " --help-all").out, "--retry-failed"));
  EXPECT_EQ(run(demo + " --version").code, 0);
  for (const std::string command : {"front", "compare", "replay"})
    EXPECT_TRUE(contains(run(demo + " " + command + " --help").out, "Example: formula_demo " + command));
  EXPECT_TRUE(contains(run(demo + " compare --help").out, "Give both studies the same --seed"));
}

}  // namespace
