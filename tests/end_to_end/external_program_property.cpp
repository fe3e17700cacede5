// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A simulator that is a program of its own: what it is told, what of its answers is taken, and that nothing
/// of it is left running.

#include <drawpoint/tests/end_to_end/support.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

namespace fs = std::filesystem;

class ExternalProgram : public StudyTest {
 protected:
  /// A study of one variable x and one response y whose simulator is this shell script; $1 is the request, $2
  /// the reply.
  std::string study(const std::string& script, const std::string& more = "") const {
    std::ofstream(place_ / "simulate.sh") << script << "\n";
    return study_file(R"("variables": [{"name": "x", "lower": 0, "upper": 1}],)"
                      R"("responses": [{"name": "y", "goal": "minimize"}],)"
                      R"("command": ["sh", "simulate.sh"])" +
                      more);
  }

  std::string study_file(const std::string& content) const {
    std::ofstream(place_ / "study.json") << R"({"name": "study", )" << content << "}\n";
    return EXTERNAL_PROGRAM + std::string(" ") + (place_ / "study.json").string();
  }

  /// Why a run fails.
  std::string reason(const std::string& script, const std::string& more = "") const {
    const Ended end = run(study(script, more) + " evaluate --x=0.5 --json");
    EXPECT_EQ(end.code, 1) << end.out << end.err;
    return end.json().value("reason", "");
  }

  std::string complaint(const std::string& content) const {
    const Ended end = run(study_file(content));
    EXPECT_EQ(end.code, 1);
    return end.err;
  }
};

const std::string half = R"(echo '{"values": {"y": 0.5}}' > $2)";

/// Of a process that a test's script has started; zombies count as gone.
bool runs(const std::string& pid) {
  const std::string stat = contents("/proc/" + pid + "/stat");
  return !stat.empty() && stat.find(") Z") == std::string::npos;
}

/// A second is a hundred times what ending takes.
testing::AssertionResult ends_soon(const std::string& pid) {
  for (int i = 0; i < 100; ++i) {
    if (!runs(pid)) return testing::AssertionSuccess();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return testing::AssertionFailure() << pid << " still runs";
}

}  // namespace

TEST_F(ExternalProgram, IsTheSimulatorOfAWholeStudy) {
  const Ended end = run("env -C / " THROW_STUDY " --runs 8 --validation 2 --jobs 2 --json" + out());
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(count("status = 'done'"), 10);
  EXPECT_TRUE(contains(contents(dir() / "logs" / "run_0003.txt"), "a lump of"));
  const Ended again = run(THROW_STUDY " evaluate --run 3" + out());
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(contains(again.err, "as stored, bit for bit"));
  EXPECT_TRUE(contains(run(THROW_STUDY " --help").out, "speed (1 to 6 m/s): of the belt"));
  for (const std::string command : {"status", "front", "export", "ask"})
    EXPECT_TRUE(contains(run(THROW_STUDY " " + command + " --help").out,
                         "Example: external_program " THROW_JSON " " + command))
        << command;
  EXPECT_TRUE(contains(contents(dir() / "report.html"), "energy of a tonne as it lands"));
}

TEST_F(ExternalProgram, IsToldThePointByNameTheSeedAndItsFiles) {
  const std::string program =
      study_file(R"("variables": [{"name": "x", "unit": "m", "lower": 0, "upper": 1},)"
                 R"({"name": "n", "lower": 1, "upper": 9, "kind": "integer"},)"
                 R"({"name": "rock", "kind": "categorical", "levels": ["ore", "waste"]}],)"
                 R"("responses": [{"name": "y", "goal": "record"}], "command": ["sh", "-c", "cp $0 )" +
                 (place_ / "seen").string() + R"(; echo '{\"values\": {\"y\": 1, \"z\": 2}}' > $1"])");
  const Ended end = run(program + " evaluate --x=0.1,7,1 --seed 18446744073709551615 --json");
  ASSERT_EQ(end.code, 0) << end.err;
  const auto seen = nlohmann::json::parse(contents(place_ / "seen"));
  EXPECT_EQ(seen["x"], nlohmann::json({{"x", 0.1}, {"n", 7}, {"rock", "waste"}}));
  EXPECT_TRUE(seen["x"]["n"].is_number_integer());
  EXPECT_EQ(seen["seed"].get<std::uint64_t>(), 18446744073709551615u);
  EXPECT_TRUE(seen["log"].get<std::string>().starts_with("/"));
  EXPECT_EQ(seen["shared"], "");
  EXPECT_EQ(end.json()["values"], nlohmann::json({{"y", 1.0}})) << "what is no response is left alone";
}

TEST_F(ExternalProgram, FailsWithAReason) {
  EXPECT_EQ(reason(R"(echo '{"failure": "stuck"}' > $2)"), "stuck");
  EXPECT_EQ(reason("exit 3"), "the program \"sh\" gave no result: it ended with exit code 3");
  EXPECT_TRUE(contains(reason("kill -SEGV $$"), "SIGSEGV"));
  EXPECT_TRUE(contains(reason("true"), "it wrote no reply"));
  EXPECT_TRUE(contains(reason("echo nonsense > $2"), "is no JSON"));
  EXPECT_TRUE(contains(reason("echo '[1]' > $2"), "is not one of"));
  EXPECT_TRUE(contains(reason(R"(echo '{"values": {"y": 1}, "failure": "no"}' > $2)"), "is not one of"));
  EXPECT_TRUE(contains(reason(R"(echo '{"failure": ""}' > $2)"), "no text as failure"));
  EXPECT_TRUE(contains(reason(R"(echo '{"values": {"why": 1}}' > $2)"), "no value for \"y\""));
  EXPECT_TRUE(contains(reason(R"(echo '{"values": {"y": "1"}}' > $2)"), "which is no number"));
  EXPECT_TRUE(contains(reason(R"(echo '{"values": {"y": NaN}}' > $2)"), "whose numbers are finite"));
  EXPECT_TRUE(contains(reason(half + "; exit 1"), "exit code 1")) << "a reply of a crash is not taken";
  EXPECT_TRUE(contains(reason("sleep 30", R"(, "time_limit": 0.1)"), "stopped after 0.1 s"));
}

TEST_F(ExternalProgram, IsTriedAgainAfterACrashAlone) {
  const std::string marker = (place_ / "tries").string();
  const std::string flaky =
      "echo x >> " + marker + "; [ $(wc -l < " + marker + ") -ge 3 ] || exit 1\n" + half;
  const Ended end = run(study(flaky, R"(, "attempts": 3)") + " evaluate --x=0.5 --json");
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(contains(end.err, "attempt 2 of 3: it ended with exit code 1"));
  fs::remove(marker);
  EXPECT_TRUE(contains(reason(flaky, R"(, "attempts": 2)"), "in each of 2 attempts"));
  fs::remove(marker);
  EXPECT_EQ(reason("echo x >> " + marker + R"(; echo '{"failure": "no"}' > $2)", R"(, "attempts": 3)"), "no");
  EXPECT_EQ(contents(marker), "x\n") << "a failure is an answer";
}

// What one study exports trains another one, alone or beside runs of its own; the same command again adds
// nothing.
TEST_F(ExternalProgram, PointsMadeElsewhereTrainTheModels) {
  const std::string here = (place_ / "other").string(), table = (place_ / "points.csv").string();
  ASSERT_EQ(run(THROW_STUDY " --runs 12 --validation 0 --jobs 2 --out " + here).code, 0);
  ASSERT_EQ(run(THROW_STUDY " export --out " + here + " --file " + table).code, 0);
  const std::string import = THROW_STUDY " --json --runs 0 --validation 3 --import " + table + out();
  for (int i = 0; i < 2; ++i) {
    const Ended end = run(import);
    ASSERT_EQ(end.code, 0) << end.err;
    EXPECT_EQ(end.json()["imported"], 12);
    EXPECT_EQ(end.json()["training"], 0);
    EXPECT_TRUE(end.json()["nrmse"]["reach"].is_number()) << "there are models";
  }
  const Ended repeat = run(THROW_STUDY " evaluate --run 5" + out());
  EXPECT_EQ(repeat.code, 2);
  EXPECT_TRUE(contains(repeat.err, "it was made elsewhere"));
  EXPECT_EQ(run(THROW_STUDY " --runs 4" + out()).code, 0);
  EXPECT_EQ(count("kind = 'training' AND status = 'done'"), 4);
}

TEST_F(ExternalProgram, AWrongTableChangesNothing) {
  std::ofstream(place_ / "points.csv") << "speed,angle\n1,2\n";
  const Ended end = run(THROW_STUDY " --import " + (place_ / "points.csv").string() + out());
  EXPECT_EQ(end.code, 2);
  EXPECT_TRUE(contains(end.err, "there is no column \"reach\""));
  EXPECT_FALSE(fs::exists(database()));
  EXPECT_TRUE(contains(run(THROW_STUDY " --runs 1" + out()).err, "allowed is 2 or more together"));
}

// The program has started another one when it is stopped: by the time limit of the run, by Ctrl-C, and by the
// death of the study, which no handler sees.
TEST_F(ExternalProgram, IsStoppedWithAllThatItStarted) {
  const fs::path started = place_ / "started";
  const std::string slow = study("sleep 60 & echo $! > " + started.string() + "; wait") +
                           " --runs 2 --validation 0 --jobs 1" + out();
  const auto pid = [&] {
    while (contents(started).find('\n') == std::string::npos)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const std::string text = contents(started);
    fs::remove(started);
    return text.substr(0, text.find('\n'));
  };
  for (const int signal : {SIGINT, SIGKILL}) {
    Command running(slow, place_);
    const std::string child = pid();
    EXPECT_TRUE(runs(child));
    running.send(signal);
    running.wait();
    EXPECT_TRUE(ends_soon(child)) << "signal " << signal;
  }
  Command limited(slow + " --time-limit 0.3", place_);
  const std::string child = pid();
  EXPECT_TRUE(runs(child));
  limited.wait();
  EXPECT_TRUE(ends_soon(child));
}

TEST_F(ExternalProgram, HasTimeToEndAndLeavesNoFiles) {
  const fs::path started = place_ / "started", ended = place_ / "ended";
  Command running(study("trap 'echo bye > " + ended.string() + "; exit 0' TERM; echo x > " +
                        started.string() + "; while true; do sleep 0.05; done") +
                      " --runs 2 --validation 0 --jobs 1" + out(),
                  place_);
  while (!fs::exists(started)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  running.send(SIGINT);
  EXPECT_EQ(running.wait().code, 130);
  EXPECT_EQ(contents(ended), "bye\n");
  for (const auto& entry : fs::recursive_directory_iterator(dir()))
    EXPECT_NE(entry.path().extension(), ".json") << entry.path();
  // A time limit leaves no time; what is left then goes with the study.
  EXPECT_EQ(run(study("sleep 60") + " --runs 2 --validation 0 --time-limit 0.2 --out " +
                (place_ / "limited").string())
                .code,
            1);
  EXPECT_FALSE(fs::exists(place_ / "limited" / "logs" / "unfinished"));
}

TEST_F(ExternalProgram, ThatCannotStartIsNotTriedAgain) {
  const std::string program = study_file(
      R"("variables": [{"name": "x", "lower": 0, "upper": 1}], "responses": [{"name": "y", "goal": "record"}],)"
      R"("command": ["no_such_program"], "attempts": 3)");
  const Ended end = run(program + " evaluate --x=0.5 --json");
  EXPECT_EQ(
      end.json()["reason"],
      "the program \"no_such_program\" could not be started: No such file or directory (it is not in the "
      "PATH)");
  EXPECT_EQ(end.err, "");
}

// Two simulators would train one model: neither between two commands nor within one.
TEST_F(ExternalProgram, ThatChangesEndsTheStudy) {
  const std::string first = study(half) + " --runs 4 --validation 0" + out();
  ASSERT_EQ(run(first).code, 0);
  const Ended other = run(study(half + " # other") + " --runs 5" + out());
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.err, "were made by \"sh simulate.sh (checksum "));
  EXPECT_TRUE(contains(other.err, "for new runs begin a study with another --out"));
  EXPECT_EQ(run(study(half + " # other") + " report" + out()).code, 0) << "what is there may be read";
  EXPECT_EQ(run(study(half) + " --runs 5" + out()).code, 0);
  const fs::path changed = place_ / "changed";
  const Ended within = run(study("echo >> $0; " + half) + " --runs 4 --validation 0 --jobs 1 --json --out " +
                           changed.string());
  EXPECT_EQ(within.code, 1);
  EXPECT_TRUE(contains(within.err, "no run can be made: run 2: "));
  EXPECT_TRUE(contains(within.err, "changed while the study ran"))
      << "run 1 has ended when the script changed itself";
}

// Nobody said whether chance is at work: one run more tells, once. Who says so, or has few runs, is not asked.
TEST_F(ExternalProgram, IsAskedOnceWhetherChanceIsAtWork) {
  const auto training = [&](const fs::path& folder) {
    return SQLite::Database((folder / "study.db").string())
        .execAndGet("SELECT count(*) FROM runs WHERE kind = 'training'")
        .getInt();
  };
  ASSERT_EQ(run(study(half) + " --runs 20 --validation 1" + out()).code, 0);
  EXPECT_EQ(training(dir()), 21);
  EXPECT_EQ(count("replicate = 1 AND kind = 'training'"), 1);
  ASSERT_EQ(run(study(half) + " --runs 22 --validation 1" + out()).code, 0);
  EXPECT_EQ(training(dir()), 23);
  const fs::path few = place_ / "few", told = place_ / "told";
  ASSERT_EQ(run(study(half) + " --runs 19 --validation 0 --out " + few.string()).code, 0);
  EXPECT_EQ(training(few), 19);
  ASSERT_EQ(run(study(half) + " --runs 20 --validation 0 --out " + few.string()).code, 0);
  EXPECT_EQ(training(few), 21) << "a study that has grown to twenty is asked, too";
  ASSERT_EQ(run(study(half) + " --out " + few.string()).code, 0);
  EXPECT_EQ(training(few), 21);
  ASSERT_EQ(
      run(study(half, R"(, "deterministic": false)") + " --runs 20 --validation 0 --out " + told.string())
          .code,
      0);
  EXPECT_EQ(training(told), 20);
}

// Who opens what somebody shares has neither study file nor program, and may read all and run nothing.
TEST_F(ExternalProgram, IsSharedWithItsStudyFile) {
  const std::string ours = study(half, R"(, "version": "2", "files": ["simulate.sh"])");
  ASSERT_EQ(run(ours + " --runs 4 --validation 1" + out()).code, 0);
  const fs::path file = place_ / "one.drawpoint", there = place_ / "far" / "away";
  const Ended shared = run(ours + " share " + dir().string() + " --output " + file.string());
  EXPECT_TRUE(contains(shared.out, "external_program open one.drawpoint --out FOLDER")) << shared.err;
  const std::string rows = run(ours + " export" + out()).out;
  fs::remove(place_ / "study.json");
  fs::remove(place_ / "simulate.sh");
  const Ended opened = run(EXTERNAL_PROGRAM " open " + file.string() + " " + there.string());
  ASSERT_EQ(opened.code, 0) << opened.err;
  EXPECT_TRUE(contains(run(EXTERNAL_PROGRAM " open --help").out, "what the command share wrote"));
  EXPECT_EQ(
      run(EXTERNAL_PROGRAM " open --json --out " + (place_ / "third").string() + " " + file.string()).code,
      0);
  const std::string theirs = EXTERNAL_PROGRAM " " + (there / "study.json").string(),
                    of_it = " --out " + there.string();
  EXPECT_EQ(run(theirs + " export" + of_it).out, rows);
  EXPECT_EQ(run(theirs + " report" + of_it).code, 0);
  EXPECT_TRUE(contains(run(theirs + " run --runs 9" + of_it).err, "runs are made elsewhere"));
  const Ended again = run(theirs + " share" + of_it + " --output " + (place_ / "two.drawpoint").string());
  EXPECT_EQ(again.code, 0) << again.err;
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("DELETE FROM sqlar WHERE name = 'study.json'");
  EXPECT_TRUE(contains(run(EXTERNAL_PROGRAM " open " + file.string()).err, "holds no study file"));
}

TEST_F(ExternalProgram, StudyFilesAreReadStrictly) {
  const std::string x = R"("variables": [{"name": "x", "lower": 0, "upper": 1}],)";
  const std::string y = R"("responses": [{"name": "y", "goal": "minimize"}],)";
  const std::string command = R"("command": ["true"])";
  EXPECT_TRUE(contains(complaint(x + y + R"("comand": ["true"])"), "there is no \"comand\"; the keys are"));
  EXPECT_TRUE(contains(complaint(x + y + R"("command": ["true"], "marks": [{"name": "today", "x": [2]}])"),
                       "\"today\": x = 2 is outside its range 0 to 1"));
  EXPECT_TRUE(contains(complaint(x + y + R"("command": ["true"], "marks": [{"name": "today", "x": ["a"]}])"),
                       "marks[0]: \"x\" is \"a\"; give numbers alone in this list"));
  EXPECT_TRUE(contains(
      complaint(x + R"("responses": [{"name": "y", "unit": "k\ng", "goal": "minimize"}],)" + command),
      "the unit of \"y\" holds a control character"));
  EXPECT_TRUE(contains(complaint(x + x + y + command), "the key \"variables\" stands twice"));
  EXPECT_TRUE(contains(complaint(x + y + R"("command": ["true"], "files": ["/usr"])"),
                       "\"/usr\" and those before it name more than 10000 files or 1 GB"));
  EXPECT_TRUE(contains(complaint(y + command), "\"variables\" is missing"));
  EXPECT_TRUE(contains(complaint(R"("variables": [{"name": "x", "lower": "0", "upper": 1}],)" + y + command),
                       "variables[0]: \"lower\" is \"0\"; give a number"));
  EXPECT_TRUE(contains(complaint(x + R"("responses": [{"name": "y", "goal": "least"}],)" + command),
                       "responses[0]: \"goal\" is \"least\"; give one of minimize, maximize"));
  EXPECT_TRUE(contains(complaint(x + y + R"("command": [])"), "\"command\" is []; give a list of texts"));
  EXPECT_TRUE(contains(complaint(x + y + command + R"(, "attempts": 0)"), "a whole number from 1"));
  EXPECT_TRUE(contains(complaint(x + y + command + R"(, "time_limit": -1)"), "time_limit is -1"));
  EXPECT_TRUE(contains(complaint(x + y + command + R"(, "deterministic": 1)"),
                       "\"deterministic\" is 1; give true or false"));
  EXPECT_TRUE(contains(complaint(R"("variables": [{"name": "x", "lower": 1, "upper": 0}],)" + y + command),
                       "swap them"));
  EXPECT_TRUE(contains(run(EXTERNAL_PROGRAM " " + (place_ / "none.json").string()).err, "cannot be read"));
  EXPECT_EQ(run(EXTERNAL_PROGRAM).code, 2);
  EXPECT_TRUE(contains(run(EXTERNAL_PROGRAM " --version").out, "Drawpoint "));
  EXPECT_TRUE(contains(run(EXTERNAL_PROGRAM " --help").out, "docs/tutorials/first-study.md"));
}
