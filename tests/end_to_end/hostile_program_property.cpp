// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Whatever a program leaves, prints, replies or does not start with, it fails its run and nothing else, or stops
/// the study with a word on what to mend.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

namespace fs = std::filesystem;

const std::string good_reply = R"(echo '{"values": {"y": 0.5}}' > $2)";

constexpr int asking = 1;  // run more in a design of twenty: whether chance is at work

class HostileProgram : public StudyTest {
 protected:
  /// A study of x from 0 to 1 and a response y whose simulator is this shell script.
  std::string study(const std::string& script, const std::string& more = "",
                    const std::string& command = R"(["sh", "simulate.sh"])") const {
    std::ofstream(place_ / "simulate.sh") << script << "\n";
    std::ofstream(place_ / "study.json")
        << R"({"name": "study", "variables": [{"name": "x", "lower": 0, "upper": 1}],)"
        << R"("responses": [{"name": "y", "goal": "minimize", "lower": 0}], "command": )" << command << more
        << "}\n";
    return EXTERNAL_PROGRAM + std::string(" ") + (place_ / "study.json").string();
  }

  /// The script does it where x is below a half, then replies as it should.
  static std::string at_low_x(const std::string& what) {
    return R"(log=${1%.request.json}; printed=$(dirname "$log")/../$(basename "${log%.h5}").txt
if grep -q '"x": 0\.[0-4]' "$1"; then )" +
           what + "; fi\n[ -e \"$2\" ] || [ -L \"$2\" ] || " + good_reply;
  }

  std::string reason_of(const std::string& script, const std::string& more = "") const {
    return run(study(script, more) + " evaluate --x=0.5 --json").json().value("reason", "");
  }
};

}  // namespace

TEST_F(HostileProgram, WhatItLeavesFailsItsRunAlone) {
  const std::string socket =
      R"x(cd "$(dirname "$log")" && python3 -c "import socket; socket.socket(socket.AF_UNIX).bind('$(basename "$log")')")x";
  for (const std::string& what :
       {std::string(R"(mkdir "$log"; touch "$log/a")"), std::string(R"(mkfifo "$log")"),
        std::string(R"(ln -s /dev/zero "$log")"), std::string(R"(ln -s /etc/passwd "$log")"),
        std::string(R"(ln -s /none "$log")"), std::string(R"(truncate -s 5T "$log")"), socket,
        std::string(R"(mkdir "$2"; touch "$2/a")"), std::string(R"(mkfifo "$2")"),
        std::string(R"(ln -s /dev/zero "$2")"), std::string(R"(truncate -s 5T "$2")")}) {
    fs::remove_all(dir());
    const std::string command =
        study(at_low_x(what)) + " --runs 8 --validation 0 --jobs 2 --no-spot-check" + out();
    for (int k = 0; k < 2; ++k) {
      Command running(command, place_);
      const Ended end = running.wait();
      EXPECT_EQ(end.code, 0) << what << "\n" << end.err;
      EXPECT_EQ(count("status = 'done'"), 4) << what;
      EXPECT_EQ(count("status = 'failed'"), 4) << what;
      EXPECT_TRUE(k > 0 || !fs::exists(dir() / "logs" / "unfinished")) << what;
    }
    EXPECT_EQ(run(study(at_low_x(what)) + " status" + out()).code, 0);
  }
}

TEST_F(HostileProgram, WhatIsInTheWayOfItsFilesGoes) {
  for (const char* what :
       {R"(rm -f "$printed"; mkdir "$printed"; touch "$printed/a"; exit 1)",
        R"(rm -f "$printed"; mkfifo "$printed"; exit 1)",
        R"(rm -f "$printed"; ln -s /dev/zero "$printed"; exit 1)",
        R"(d=$(dirname "$log"); rm -rf "$d"; touch "$d"; exit 1)", R"(rm -rf "$(dirname "$log")/.."; exit 1)",
        R"(mkdir -p "$(dirname "$log")/../run_0001.h5/a" "$(dirname "$log")/../run_0008.h5/a"; exit 1)"}) {
    fs::remove_all(dir());
    const std::string options = " --runs 8 --validation 0 --jobs 1 --no-spot-check" + out();
    const Ended first = run(study(at_low_x(what)) + options);
    EXPECT_EQ(first.code, 0) << what << "\n" << first.err;
    EXPECT_EQ(count("status = 'failed'"), 4) << what;
    const Ended again = run(study(at_low_x(what)) + options + " --retry-failed");
    EXPECT_EQ(again.code, 0) << what << "\n" << again.err;
    EXPECT_EQ(count("status = 'failed'"), 4) << what;
  }
}

TEST_F(HostileProgram, ThatCannotStartStopsTheStudyAtOnce) {
  const std::string command = R"(["./simulate"])";
  const auto begin = [&](const std::string& text, fs::perms perms) {
    fs::remove_all(dir());
    std::ofstream(place_ / "simulate") << text;
    fs::permissions(place_ / "simulate", perms);
    const Ended end = run(study("", "", command) + " --runs 50 --validation 0 --jobs 2" + out());
    EXPECT_EQ(end.code, 1);
    EXPECT_EQ(count("status = 'planned'"), 50 + asking) << end.err;
    return end.err;
  };
  EXPECT_TRUE(
      contains(begin("#!/bin/sh\n", fs::perms::owner_read), "it may not be run; allow it with chmod +x"));
  EXPECT_TRUE(contains(begin("#!/bin/sh\r\ntrue\r\n", fs::perms::owner_all), "ends in a carriage return"));
  EXPECT_TRUE(contains(begin("#!/usr/bin/env sh\r\n", fs::perms::owner_all), "ends in a carriage return"));
  EXPECT_TRUE(contains(begin("#!/no/such/shell\n", fs::perms::owner_all), "its interpreter /no/such/shell"));
  std::ofstream(place_ / "simulate") << "#!/bin/sh\n" << good_reply << "\n";
  const Ended mended = run(study("", "", command) + " --runs 50 --validation 0 --jobs 2" + out());
  EXPECT_EQ(mended.code, 2) << "another program than the one of before";
  fs::remove_all(dir());
  EXPECT_EQ(run(study("", "", command) + " --runs 5 --validation 0" + out()).code, 0);
}

TEST_F(HostileProgram, WhoseFirstRunsAllFailAlikeStopsTheStudy) {
  const std::string wrong = "echo begun; echo \"KeyError: 'x' at 0x7f$$\" >&2; exit 1";
  const std::string options = " --runs 30 --validation 0 --jobs 1" + out();
  const Ended end = run(study(wrong) + options);
  EXPECT_EQ(end.code, 1);
  EXPECT_TRUE(
      contains(end.err,
               "the first 5 runs all failed alike: the program \"sh\" gave no result: it ended with exit "
               "code 1; it printed last \"KeyError: 'x' at 0x7f"));
  EXPECT_TRUE(contains(end.err, "(logs/run_0001.txt)"));
  EXPECT_TRUE(contains(end.err, "the command check makes one run"));
  EXPECT_EQ(count("status = 'failed'"), 5);
  EXPECT_EQ(count("status = 'planned'"), 25 + asking);
  run(study(wrong) + options + " --keep-going");
  EXPECT_EQ(count("status = 'failed'"), 30 + asking);
  EXPECT_TRUE(contains(run(study(wrong) + " run --help").out, "--keep-going"));
}

TEST_F(HostileProgram, ThatFailsHereAndThereGoesOn) {
  const Ended end =
      run(study(at_low_x("echo no mesh; exit 3")) + " --runs 20 --validation 0 --jobs 1" + out());
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(count("status = 'failed' AND replicate = 0"), 10);
  EXPECT_TRUE(contains(query("SELECT reason FROM runs WHERE status = 'failed' LIMIT 1"),
                       "it ended with exit code 3; it printed last \"no mesh\" (logs/run_00"));
}

TEST_F(HostileProgram, AnExitCodeOf127IsACrash) {
  const std::string tries = (place_ / "tries").string();
  EXPECT_EQ(
      reason_of("echo x >> " + tries + "; no_such_command", R"(, "attempts": 2)"),
      "the program \"sh\" gave no result in each of 2 attempts, at last: it ended with exit code 127, a "
      "shell's for a "
      "program that it does not find");
  EXPECT_EQ(contents(tries), "x\nx\n");
}

TEST_F(HostileProgram, CheckShowsAllOfARun) {
  const Ended end = run(study("echo thinking; " + good_reply) + " check");
  EXPECT_EQ(end.code, 0) << end.err;
  const std::size_t request = end.out.find("--- request\n{\n  \"log\""),
                    printed = end.out.find("--- printed\nthinking\n"),
                    reply = end.out.find("--- reply\n{\"values\": {\"y\": 0.5}}\n");
  EXPECT_TRUE(request < printed && printed < reply && reply != std::string::npos) << end.out;
  EXPECT_TRUE(contains(end.out, "y = 0.5"));
  EXPECT_FALSE(fs::exists(place_ / "results"));
  const Ended failed = run(study("exit 4") + " check --x=0.25");
  EXPECT_EQ(failed.code, 1);
  EXPECT_TRUE(contains(failed.out, "x = 0.25"));
  EXPECT_TRUE(contains(failed.err, "it ended with exit code 4"));
}

TEST_F(HostileProgram, StreamsAreTakenForFiles) {
  const std::string program =
      R"(grep -q '"seed": 7' || exit 9; echo thinking; echo '{"values": {"y": 0.25}}')";
  const std::string streams = R"(, "exchange": "streams")";
  EXPECT_EQ(run(study(program, streams) + " evaluate --x=0.5 --seed 7 --json").json()["values"]["y"], 0.25);
  EXPECT_TRUE(contains(reason_of("echo no JSON", streams), "gave no result: its reply is no JSON"));
  EXPECT_EQ(reason_of("true", streams), "the program \"sh\" gave no result: it wrote no reply");
  EXPECT_EQ(run(study(R"(grep -q '"seed": 7' && )" + good_reply) + " evaluate --x=0.5 --seed 7").code, 0)
      << "the request is on standard input with files, too";
}

TEST_F(HostileProgram, RepliesAreReadStrictly) {
  EXPECT_TRUE(contains(reason_of(R"(echo '{"values": {"y": 0.1, "y": 0.9}}' > $2)"),
                       "the key \"y\" stands twice in one object"));
  EXPECT_TRUE(contains(reason_of(R"(echo '{"values": {"y": 1}, "values": {"y": 2}}' > $2)"), "stands twice"));
  EXPECT_TRUE(contains(reason_of(R"(head -c 20000000 /dev/zero | tr '\0' ' ' > $2)"),
                       "its reply has 20000000 bytes; allowed are 16777216"));
}

TEST_F(HostileProgram, ItsWordsCommandNoTerminal) {
  const std::string red = R"(printf '{"failure": "\\u001b[31mred\\u0007\\u009b2J \342\200\256gnp"}' > $2)";
  const Ended end = run(study(red) + " --runs 3 --validation 0" + out());
  const Ended status = run(study(red) + " status" + out());
  for (const std::string& text :
       {end.out, end.err, status.out, query("SELECT reason FROM runs WHERE id = 1")}) {
    EXPECT_EQ(text.find('\033'), std::string::npos);
    EXPECT_EQ(text.find('\a'), std::string::npos);
    EXPECT_EQ(text.find("\xC2\x9B"), std::string::npos);
    EXPECT_EQ(text.find("\xE2\x80\xAE"), std::string::npos);
  }
  EXPECT_TRUE(contains(status.out, "\xE2\x90\x9B[31mred"));
  const std::string escapes = "printf '\\033]0;owned\\007last' >&2; exit 1";
  fs::remove_all(dir());
  EXPECT_EQ(run(study(escapes) + " --runs 3 --validation 0" + out()).err.find('\033'), std::string::npos);
  const std::string much =
      R"((printf '{"failure": "'; head -c 10000000 /dev/zero | tr '\0' x; printf '"}') > $2)";
  fs::remove_all(dir());
  run(study(much) + " --runs 3 --validation 0" + out());
  EXPECT_EQ(query("SELECT length(reason) FROM runs WHERE id = 1"),
            std::to_string(2000 + std::string(" ... (cut: it has 10000000 bytes)").size()));
}

TEST_F(HostileProgram, RoundOffBelowABoundIsTheBound) {
  EXPECT_EQ(run(study(R"(echo '{"values": {"y": -1.1e-16}}' > $2)") + " evaluate --x=0.5 --json")
                .json()["values"]["y"],
            0.0);
  EXPECT_TRUE(contains(reason_of(R"(echo '{"values": {"y": -1e-9}}' > $2)"), "outside its range"));
}

TEST_F(HostileProgram, FewFileDescriptorsMeanFewerRunsAtATime) {
  const std::string command = study(good_reply) + " --runs 100 --validation 0 --jobs 100" + out();
  const Ended end = run("sh -c 'ulimit -n 80; exec " + command + "'");
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(contains(end.out, "leaves room for 16 runs at a time"));
  EXPECT_EQ(count("status = 'done'"), 100 + asking);
}

// The model K is read from a module beside the program: its file is part of the fingerprint. What lies elsewhere is
// found by a run that is made again.
TEST_F(HostileProgram, AChangedSimulatorDoesNotMixIn) {
  const std::string by_module =
      ". " + (place_ / "model.sh").string() + R"(; echo "{\"values\": {\"y\": $K}}" > $2)";
  const auto with = [&](const std::string& value) {
    std::ofstream(place_ / "model.sh") << "K=" << value << "\n";
  };
  with("1");
  const std::string options = " --validation 0 --jobs 1" + out();
  const Ended first = run(study(by_module) + " --runs 3" + options);
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_TRUE(contains(first.out, "those beside it that end alike: model.sh (checksum "));
  const Ended same = run(study(by_module) + " --runs 4" + options);
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_TRUE(contains(same.out, "as stored, bit for bit"));
  EXPECT_EQ(same.out.find("that end alike"), std::string::npos) << "said once";
  with("1000");
  const Ended other = run(study(by_module) + " --runs 5" + options);
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.err, "one model does not take both"));
  const Ended unseen = run(study(by_module, R"(, "files": [])") + " --runs 3 --validation 0 --out " +
                           (place_ / "unseen").string());
  ASSERT_EQ(unseen.code, 0) << unseen.err;
  with("7");
  const std::string more =
      study(by_module, R"(, "files": [])") + " --runs 5 --validation 0 --out " + (place_ / "unseen").string();
  const Ended spot = run(more);
  EXPECT_EQ(spot.code, 1);
  EXPECT_TRUE(contains(spot.err, "does not come out as it is stored"));
  EXPECT_TRUE(contains(spot.err, "y 1000 then, 7 now"));
  EXPECT_EQ(run(more + " --no-spot-check").code, 0);
}

TEST_F(HostileProgram, FilesAndVersionAreOfTheSimulator) {
  std::ofstream(place_ / "table.dat") << "1";
  const std::string options = " --runs 3 --validation 0" + out();
  const std::string named = R"(, "files": ["*.dat"], "version": "2")";
  ASSERT_EQ(run(study(good_reply, named) + options).code, 0);
  EXPECT_EQ(run(study(good_reply, R"(, "files": ["*.dat"], "version": "3")") + options).code, 2);
  EXPECT_EQ(run(study(good_reply, named) + options).code, 0);
  std::ofstream(place_ / "table.dat") << "2";
  const Ended changed = run(study(good_reply, named) + options);
  EXPECT_EQ(changed.code, 2);
  EXPECT_TRUE(contains(changed.err, "; version 2; files table.dat (checksum "));
  EXPECT_TRUE(
      contains(run(study(good_reply, R"(, "files": ["none.*"])") + options).err, "\"none.*\" names nothing"));
}

// The program changes while run 2 is made: what that run gives belongs to neither.
TEST_F(HostileProgram, ARunWhileTheSimulatorChangesIsNotKept) {
  const std::string changes = "n=$(cat " + (place_ / "count").string() +
                              " 2>/dev/null || echo 0); echo $((n + 1)) >" + (place_ / "count").string() +
                              "; [ $n != 1 ] || echo '# changed' >>" + (place_ / "model.sh").string() + "; " +
                              good_reply;
  std::ofstream(place_ / "model.sh") << "K=1\n";
  const Ended end = run(study(changes) + " --runs 4 --validation 0 --jobs 1" + out());
  EXPECT_NE(end.code, 0);
  EXPECT_TRUE(contains(query("select reason from runs where id = 2"), "changed while the run was made"));
  EXPECT_EQ(query("select count(*) from runs where status = 'done'"), "1");
}

// A folder of results below the study file, where programs write, is no file of the simulator.
TEST_F(HostileProgram, ItsFilesAreNotItsResults) {
  for (const char* pattern : {"*", "."}) {
    study(good_reply, R"(, "files": [")" + std::string(pattern) + R"("])");
    const fs::path own = place_ / ("of_" + std::to_string(pattern[0]));
    fs::create_directories(own);
    for (const char* file : {"study.json", "simulate.sh"}) fs::copy_file(place_ / file, own / file);
    const std::string line = EXTERNAL_PROGRAM + std::string(" ") + (own / "study.json").string() +
                             " --validation 0 --out " + (own / "results" / "study").string();
    EXPECT_EQ(run(line + " --runs 3").code, 0) << pattern;
    EXPECT_EQ(run(line + " --runs 4").code, 0) << pattern;
  }
}

// What somebody has put right is no run that the simulator could give again.
TEST_F(HostileProgram, ACorrectedRunIsNotComparedWithTheSimulator) {
  const std::string options = " --validation 0 --jobs 1" + out();
  ASSERT_EQ(run(study(good_reply) + " --runs 3" + options).code, 0);
  std::ofstream(place_ / "right.csv") << "run,y\n1,0.25\n2,0.3\n3,0.35\n";
  const Ended told = run(study(good_reply) + " tell --replace --why measured --file " +
                         (place_ / "right.csv").string() + out());
  ASSERT_EQ(told.code, 0) << told.err;
  const Ended more = run(study(good_reply) + " --runs 5" + options);
  EXPECT_EQ(more.code, 0) << more.err;
}

TEST_F(HostileProgram, AStoreThatIsNoFileIsRefused) {
  fs::create_directories(dir());
  ASSERT_EQ(mkfifo((dir() / "study.db").c_str(), 0600), 0);
  const Ended end = run(study(good_reply) + " status" + out());
  EXPECT_EQ(end.code, 1);
  EXPECT_TRUE(contains(end.err, "is no regular file"));
}
