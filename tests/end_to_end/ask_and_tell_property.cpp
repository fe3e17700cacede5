// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Runs that are made elsewhere: ask gives them, tell takes what came out.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const char* const options = " --runs 12 --validation 3 --adaptive 4 --batch 2 --seed 5";

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

// A bench: the study file names no program.
constexpr const char* bench = R"({"name": "bench",
  "variables": [{"name": "speed", "unit": "m/s", "lower": 1, "upper": 6}],
  "responses": [{"name": "wear", "unit": "mm", "goal": "minimize", "lower": 0}],
  "defaults": {"runs": 3, "validation": 1}})";

class AskAndTell : public StudyTest {
 protected:
  AskAndTell() { std::ofstream(place_ / "bench.json") << bench; }

  std::filesystem::path table() const { return place_ / "table.csv"; }
  Ended on_bench(const std::string& words) const {
    return run(EXTERNAL_PROGRAM " " + (place_ / "bench.json").string() + " " + words + out());
  }
  Ended tell(const std::string& text) const {
    std::ofstream(table()) << text;
    return on_bench("tell --file " + table().string());
  }

  /// Makes the runs that are asked for one by one, as somebody else's loop would. Returns how many.
  int make_asked_runs() const {
    const Ended asked = run(FORMULA_DEMO " ask" + std::string(options) + out());
    EXPECT_EQ(asked.code, 0) << asked.err;
    std::istringstream rows(asked.out);
    std::string row, answer = "run,production [kg/s],joint_damage [s],rock_spill\n";
    std::getline(rows, row);
    EXPECT_EQ(row, "run,kind,point,replicate,seed,alpha [1],beta [1],gamma [1],kappa [1]");
    int made = 0;
    for (; std::getline(rows, row); ++made) {
      const auto f = fields_of(row);
      const auto outcome = run(FORMULA_DEMO " evaluate --json --x=" + f[5] + "," + f[6] + "," + f[7] + "," +
                               f[8] + " --seed " + f[4])
                               .json();
      answer += f[0];
      for (const char* response : {"production", "joint_damage", "rock_spill"})
        answer += "," + outcome["values"][response].dump();
      answer += "\n";
    }
    std::ofstream(table()) << answer;
    if (made > 0) {
      EXPECT_EQ(run(FORMULA_DEMO " tell --file " + table().string() + out()).code, 0);
    }
    return made;
  }
};

/// Of a table of runs, all but the time that each took.
std::string without_seconds(const std::string& csv) {
  std::istringstream rows(csv);
  std::string kept;
  for (std::string row; std::getline(rows, row);) {
    auto f = fields_of(row);
    f.erase(f.begin() + 7);
    for (const std::string& field : f) kept += field + ",";
    kept += "\n";
  }
  return kept;
}

}  // namespace

// First design, two adaptive batches, nothing more: the runs, their seeds and what they gave are those of the
// command run, bit for bit.
TEST_F(AskAndTell, MakesTheStudyThatRunMakes) {
  EXPECT_EQ(make_asked_runs(), 15);
  EXPECT_EQ(make_asked_runs(), 2);
  EXPECT_EQ(make_asked_runs(), 2);
  EXPECT_EQ(make_asked_runs(), 0);
  const std::string other = " --out " + (place_ / "other").string();
  ASSERT_EQ(run(FORMULA_DEMO + std::string(options) + other).code, 0);
  EXPECT_EQ(without_seconds(run(FORMULA_DEMO " export" + out()).out),
            without_seconds(run(FORMULA_DEMO " export" + other).out));
}

// Nothing is lost with a caller that dies: the same runs are given until they are told, in whatever order.
TEST_F(AskAndTell, AskedAgainTheSameRunsAreGiven) {
  const Ended first = on_bench("ask"), second = on_bench("ask"), two = on_bench("ask --count 2");
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.out, second.out);
  EXPECT_TRUE(first.out.starts_with(two.out));
  ASSERT_EQ(tell("wear,run\n0.5,3\n").code, 0);
  EXPECT_EQ(query("select wear from runs where id = 3"), "0.5");
  EXPECT_EQ(count("status = 'planned'"), 3);
  ASSERT_EQ(tell("run,wear,status,reason,seconds\n1,,failed,it broke,7\n2,,\"\",,\n3,0.5,done,,\n").code, 0);
  EXPECT_EQ(query("select reason from runs where id = 1"), "it broke");
  EXPECT_EQ(query("select seconds from runs where id = 1"), "7.0");
  EXPECT_EQ(count("status = 'planned'"), 2);
  EXPECT_TRUE(on_bench("ask --retry-failed").out.starts_with(two.out));
}

// A table with one fault changes nothing.
TEST_F(AskAndTell, FaultyTablesAreRefusedWithTheirPlace) {
  on_bench("ask");
  ASSERT_EQ(tell("run,wear\n4,1\n").code, 0);
  const std::string speed = query("select speed from runs where id = 2");
  const auto refused = [&](const std::string& text, const std::string& words) {
    const Ended end = tell(text);
    EXPECT_EQ(end.code, 2) << text;
    EXPECT_TRUE(contains(end.err, words));
    EXPECT_EQ(count("status = 'done'"), 1) << text;
  };
  refused("run,wear\n1,2\n9,1\n", "line 3: \"run\" is 9; the study has runs 1 to 4");
  refused("run,wear\n1,2\n1,2\n", "line 3: run 1 is told twice");
  refused("run,wear\n1,2\n2,-1\n", "line 3: \"wear\" is -1 mm, which lies outside of its range");
  refused("run,wear\n1,2\n2,x\n", "\"x\" is no number for \"wear\"");
  refused("run,wear\n1,2\n4,2\n", "line 3: run 4 has ended otherwise before");
  refused("run,wear,speed\n1,2,1\n2,2," + std::to_string(std::stod(speed) + 0.01) + "\n",
          "is it the table of another study?");
  refused("run,speed\n1,2\n", "there is no column \"wear\"");
  refused("run,wear [m]\n1,2\n", "is not in mm; convert it");
  refused("", "there is no first line");
  EXPECT_EQ(tell("run,wear,speed\n4,1," + query("select speed from runs where id = 4") + "\n").code, 0)
      << "told again";
}

// A decimal comma makes a row longer than its header, whoever reads it.
TEST_F(AskAndTell, ARowIsAsLongAsItsHeader) {
  on_bench("ask");
  for (const char* text : {"run,wear\n1,1,5\n", "run,wear,note\n1,1\n", "run,wear\n1,1,\n"}) {
    const Ended end = tell(text);
    EXPECT_EQ(end.code, 2) << text;
    EXPECT_TRUE(contains(end.err, "line 2: it has ")) << text;
    EXPECT_TRUE(contains(end.err, "numbers take a decimal point"));
  }
  const Ended imported = on_bench("ask --import " + table().string());
  EXPECT_EQ(imported.code, 2);
  EXPECT_TRUE(contains(tell("run,wear,run\n1,1,2\n").err, "the column \"run\" stands there twice"));
  EXPECT_TRUE(contains(tell("run,wear,who,who\n1,1,a,b\n").err, "the column \"who\" stands there twice"));
  EXPECT_TRUE(contains(tell("run,wear,wear [mm]\n1,1,2\n").err, "are of one quantity; remove one"));
  EXPECT_TRUE(contains(tell("run,wear,,\n1,1,5,75\n").err, "\"5\" stands under no name"));
  EXPECT_TRUE(contains(tell("run,wear\n1,\"1\"5\n").err, "behind the closing quote"));
  EXPECT_TRUE(contains(tell("run,wear,status\n1,1,OK\n").err, "\"status\" is \"OK\"; allowed are done"));
  EXPECT_EQ(count("status = 'done'"), 0);
}

// What was told wrongly is put right with a reason; what stood there is kept, and a run can be left out and taken in
// again.
TEST_F(AskAndTell, CorrectionsAreALedger) {
  on_bench("ask --runs 4");
  ASSERT_EQ(tell("run,wear\n1,4\n2,3\n3,2\n4,1\n5,2\n").code, 0);
  EXPECT_TRUE(contains(tell("run,wear\n1,0.4\n").err, "or correct the run with --replace --why TEXT"));
  const std::string file = " --file " + table().string();
  EXPECT_EQ(on_bench("tell --replace" + file).code, 2) << "without a reason";
  EXPECT_TRUE(contains(on_bench("ask --runs 6").out, "6,"));
  std::ofstream(table()) << "run,wear\n6,1\n";
  EXPECT_TRUE(contains(on_bench("tell --replace --why 'so it is'" + file).err,
                       "no run of the table has a result that could be replaced"));
  std::ofstream(table()) << "run,wear\n1,0.4\n";
  const Ended replaced = on_bench("tell --replace --why 'a decimal comma'" + file);
  ASSERT_EQ(replaced.code, 0) << replaced.err;
  EXPECT_TRUE(contains(replaced.out, "1 of them had ended otherwise"));
  EXPECT_EQ(query("select wear from runs where id = 1"), "0.4");
  EXPECT_EQ(on_bench("exclude --run 2").code, 2) << "without a reason";
  ASSERT_EQ(on_bench("exclude --run 2 --why 'the belt stood'").code, 0);
  EXPECT_EQ(on_bench("exclude --run 2 --why again").code, 2);
  const Ended ledger = on_bench("exclude");
  EXPECT_TRUE(contains(ledger.out, "1. replace run 1, "));
  EXPECT_TRUE(contains(ledger.out, "a decimal comma; before: {\"status\":\"done\",\"values\":[4.0]"));
  EXPECT_TRUE(contains(ledger.out, "2. exclude run 2, "));
  EXPECT_TRUE(contains(on_bench("status").out, "corrections by hand: 2"));
  const Ended report = on_bench("report");
  EXPECT_EQ(report.code, 0) << report.err;
  EXPECT_TRUE(contains(report.out, "caution: Run 2 is left out: excluded by hand: the belt stood."));
  EXPECT_TRUE(contains(contents(dir() / "report.html"), "excluded by hand: the belt stood"));
  EXPECT_EQ(query("select wear from runs where id = 2"), "3.0") << "what is stored stays";
  ASSERT_EQ(on_bench("exclude --run 2 --undo --why 'it did not'").code, 0);
  EXPECT_EQ(on_bench("report").out.find("left out"), std::string::npos);
}

// An absurd value ends no report; it is left out with a caution until it is corrected.
TEST_F(AskAndTell, AValueThatCannotBeIsLeftOut) {
  on_bench("ask --runs 8 --validation 2");
  for (const char* absurd : {"1e200", "1.7e308", "1e30"}) {
    std::filesystem::remove_all(dir());
    on_bench("ask --runs 8 --validation 2");
    ASSERT_EQ(
        tell("run,wear\n1,4\n2,3\n3," + std::string(absurd) + "\n4,1\n5,2\n6,2.5\n7,3.5\n8,1.5\n9,2\n10,1\n")
            .code,
        0);
    for (const char* command : {"report", "fit", "validate", "front", "status", "export", "ask"}) {
      const Ended end = on_bench(command);
      EXPECT_EQ(end.code, 0) << command << " with " << absurd << "\n" << end.err;
      EXPECT_EQ(end.out.find("nan"), std::string::npos) << command;
    }
    EXPECT_TRUE(contains(on_bench("report").out, "caution: Run 3 is left out: \"wear\" is 1"));
    tell("run,wear\n3,2\n");
    ASSERT_EQ(on_bench("tell --replace --why 'typed wrongly' --file " + table().string()).code, 0);
    EXPECT_EQ(on_bench("report").out.find("left out"), std::string::npos);
  }
}

TEST_F(AskAndTell, AStudyWithoutASimulatorSaysSo) {
  for (const char* words : {"run", "confirm", "evaluate --x 2"})
    expect_refused(EXTERNAL_PROGRAM " " + (place_ / "bench.json").string() + " " + words, 2,
                   "bench has no simulator: its runs are made elsewhere; the command ask gives them");
  EXPECT_FALSE(std::filesystem::exists(place_ / "results"));
  std::ofstream(place_ / "bench.json")
      << R"({"name": "b", "attempts": 2, "variables": [{"name": "x", "lower": 0, "upper": 1}],
    "responses": [{"name": "y", "goal": "minimize"}]})";
  expect_refused(EXTERNAL_PROGRAM " " + (place_ / "bench.json").string() + " ask", 1,
                 "\"attempts\" is of a command");
}

// Points of the front are asked for as confirm would choose them.
TEST_F(AskAndTell, AsksForPointsOfTheFront) {
  on_bench("ask --runs 6");
  std::string text = "run,wear\n";
  for (int id = 1; id <= 7; ++id) {
    const double speed = std::stod(query("select speed from runs where id = " + std::to_string(id)));
    text += std::to_string(id) + "," + std::to_string((speed - 3) * (speed - 3)) + "\n";
  }
  ASSERT_EQ(tell(text).code, 0);
  const std::string named = "the command ask --confirm has";
  EXPECT_TRUE(contains(on_bench("front").out, named));
  ASSERT_EQ(on_bench("report").code, 0);
  EXPECT_TRUE(contains(contents(dir() / "report.html"), named));
  const Ended asked = on_bench("ask --confirm --points 1");
  ASSERT_EQ(asked.code, 0) << asked.err;
  EXPECT_EQ(count("kind = 'confirmation' and status = 'planned'"), 1);
  // The least wear is at 3 m/s. A model that is off by less than 0.01 mm, a thousandth of the range, has its
  // least within √0.01.
  EXPECT_NEAR(std::stod(query("select speed from runs where id = 8")), 3.0, 0.1);
  EXPECT_TRUE(contains(asked.out, "8,confirmation,1,0,"));
  EXPECT_TRUE(asked.out.starts_with("run,kind,")) << "the table alone, for a pipe: " << asked.out;
}

// Levels whose names are numbers, bounds that a spreadsheet rounds, quantities that are called as ask calls
// its own: the table that ask gives comes back as it is meant.
TEST_F(AskAndTell, TablesComeBackAsTheyAreMeant) {
  std::ofstream(place_ / "bench.json") << R"({"name": "bench",
    "variables": [{"name": "teeth", "kind": "categorical", "levels": ["1", "2", "3"]},
                  {"name": "run", "unit": "m", "lower": 0.33333333333333331, "upper": 0.66666666666666663}],
    "responses": [{"name": "seconds", "unit": "s", "goal": "minimize"}, {"name": "status", "goal": "record"}],
    "defaults": {"runs": 3, "validation": 0}})";
  const Ended asked = on_bench("ask");
  ASSERT_EQ(asked.code, 0) << asked.err;
  std::istringstream rows(asked.out);
  std::string row, told;
  std::getline(rows, row);
  EXPECT_EQ(row, "run,kind,point,replicate,seed,teeth [1],run [m]");
  told = row + ",seconds [s],status [1]\n";
  while (std::getline(rows, row)) {
    const auto f = fields_of(row);
    char length[32];
    std::snprintf(length, sizeof length, "%.9g", std::stod(f[6]));  // as a spreadsheet keeps it
    told += f[0] + "," + f[1] + "," + f[2] + "," + f[3] + "," + f[4] + "," + f[5] + "," + length + ",-0.5," +
            f[5] + "\n";
  }
  const Ended end = tell(told);
  ASSERT_EQ(end.code, 0) << end.err;
  // The response repeats the name of the level, 1 to 3; the store has its number, 0 to 2.
  EXPECT_EQ(count("status = 'done' and y_status = teeth + 1 and y_seconds = -0.5 and seconds = 0"), 3);
  EXPECT_EQ(tell("run,seconds,status\n1,2,3\n").code, 2)
      << "status is a quantity here, and the column of ask";
}

// A criterion that the problem does not allow is refused as run refuses it, and leaves no folder.
TEST_F(AskAndTell, ACriterionThatCannotBeIsRefused) {
  std::ofstream(place_ / "bench.json")
      << R"({"name": "bench", "variables": [{"name": "x", "lower": 0, "upper": 1}],
    "responses": [{"name": "y", "goal": "record"}]})";
  EXPECT_EQ(on_bench("ask --adaptive 2 --criteria improvement=1").code, 2);
  EXPECT_FALSE(std::filesystem::exists(dir()));
}

TEST_F(AskAndTell, AFolderIsNoTable) {
  on_bench("ask");
  const Ended end = on_bench("tell --file " + place_.string());
  EXPECT_EQ(end.code, 2);
  EXPECT_TRUE(contains(end.err, "cannot be read; give a table"));
}
