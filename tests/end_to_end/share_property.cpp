// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A folder in one file is the same folder elsewhere; a damaged or hostile file makes none.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <map>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

namespace fs = std::filesystem;
const std::string study = TROUBLED_STUDY;

class Sharing : public StudyTest {
 protected:
  fs::path shared() const { return place_ / "study.drawpoint"; }
  fs::path elsewhere() const { return place_ / "far" / "away"; }
  std::string opening() const { return study + " open " + shared().string() + " " + elsewhere().string(); }

  void make_study() const {
    ASSERT_EQ(run("env TROUBLE=large " + study + " --runs 6 --validation 2" + out()).code, 0);
  }
  static std::map<std::string, std::string> files_of(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && entry.path().filename() != ".lock")
        files[entry.path().lexically_relative(folder).string()] = contents(entry.path());
    return files;
  }
  void change_share(const std::string& sql) const {
    SQLite::Database(shared().string(), SQLite::OPEN_READWRITE).exec(sql);
  }
  /// Nothing is left of what was begun.
  void expect_unopened(const std::string& words) const {
    const Ended end = run(opening());
    EXPECT_EQ(end.code, 1) << end.out;
    EXPECT_TRUE(contains(end.err, words));
    EXPECT_FALSE(fs::exists(elsewhere()));
    EXPECT_TRUE(!fs::exists(elsewhere().parent_path()) || fs::is_empty(elsewhere().parent_path()));
    EXPECT_FALSE(fs::exists(place_ / "evil"));
  }
};

TEST_F(Sharing, WhatIsOpenedIsWhatWasShared) {
  make_study();
  const Ended made = run(study + " share " + dir().string());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(contains(made.out, " open study.drawpoint --out FOLDER"));
  const Ended opened = run(opening());
  ASSERT_EQ(opened.code, 0) << opened.err;
  EXPECT_TRUE(contains(opened.out, "every one with its checksum; shared on 20"));
  EXPECT_TRUE(contains(opened.out, "from " + dir().string() + " by "));
  EXPECT_EQ(files_of(elsewhere()), files_of(dir()));
  EXPECT_EQ(run(study + " --out " + elsewhere().string() + " --runs 9 --json").json()["training"], 9)
      << "goes on";
  // Nothing is written over, and other tools read it.
  expect_refused(opening(), 2, "is there already, and nothing is written over");
  const Ended again =
      run(study + " share " + dir().string() + " --no-logs --json --output " + (place_ / "b").string());
  EXPECT_EQ(again.json()["files"], static_cast<int>(files_of(dir()).size()) - 8);
  SQLite::Database archive(shared().string());
  EXPECT_EQ(archive.execAndGet("SELECT count(*) FROM sqlar WHERE sz = length(data)").getInt(),
            static_cast<int>(files_of(dir()).size()));
}

TEST_F(Sharing, ADamagedOrHostileFileMakesNothing) {
  make_study();
  const auto share_anew = [&] { ASSERT_EQ(run(study + " share --replace " + dir().string()).code, 0); };
  share_anew();
  change_share("UPDATE sqlar SET data = zeroblob(sz) WHERE name = 'report.html'");
  expect_unopened("\"report.html\" does not fit its checksum; nothing was unpacked");
  share_anew();
  change_share("DELETE FROM sqlar WHERE name = 'logs/run_0003.h5'");
  expect_unopened("is damaged: it holds");
  for (const char* name : {"../evil", "/tmp/evil", "logs/../../evil", "logs//x", ".lock", "shared/.x",
                           "logs/x/y", "study.db-journal"}) {
    share_anew();
    change_share("INSERT INTO sqlar SELECT '" + std::string(name) +
                 "', mode, mtime, sz, data FROM sqlar LIMIT 1");
    expect_unopened("\"" + std::string(name) + "\", which no folder of a study does");
  }
  share_anew();
  change_share("UPDATE drawpoint SET value = '2' WHERE key = 'version'");
  expect_unopened(
      "has version \"2\" of the format, and this program (1) cannot read it; take the program that made it");
  share_anew();
  fs::remove(shared());
  expect_unopened("open: " + shared().string() + " is not there; name the file that the command share made");
}

TEST_F(Sharing, WhatIsNoWholeFileOfTheCommandIsNamedWithWhatIsWrongAndWhatToDo) {
  make_study();
  ASSERT_EQ(run(study + " share " + dir().string()).code, 0);
  const auto whole = fs::file_size(shared());
  const std::string place = "open: " + shared().string() + " ",
                    again = "; copy it again from where it was made";
  for (const std::uintmax_t bytes :
       {whole - 1, whole - 4096, whole / 2, std::uintmax_t(5000), std::uintmax_t(101)}) {
    fs::resize_file(shared(), bytes);
    expect_unopened(place + "has " + std::to_string(bytes) + " of its " + std::to_string(whole) + " bytes" +
                    again);
  }
  for (const std::uintmax_t bytes : {60, 16}) {
    fs::resize_file(shared(), bytes);
    expect_unopened(place + "ends after " + std::to_string(bytes) + " bytes" + again);
  }
  fs::resize_file(shared(), 0);
  expect_unopened(place + "is empty" + again);
  const std::string name = "; name the file that the command share made";
  std::ofstream(shared()) << "run,x,y\n1,0.5,2\n";
  expect_unopened(place + "is no file of the command share (it does not begin as these do)" + name);
  fs::copy_file(database(), shared(), fs::copy_options::overwrite_existing);
  expect_unopened(
      place + "is the store of a study alone; give the folder in which it lies to --out of another command" +
      name);
  fs::remove(shared());
  SQLite::Database(shared().string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE t (a)");
  expect_unopened(place + "is an SQLite file, but none of the command share" + name);
  fs::remove(shared());
  fs::create_directory(shared());
  expect_unopened(place + "is a directory, no file" + name);
}

TEST_F(Sharing, AFileThatIsThereIsReplacedOnlyWhenAsked) {
  make_study();
  std::ofstream(shared()) << "somebody's";
  const std::string line = study + " share " + dir().string();
  for (const std::string& to : {std::string(), " --output " + shared().string()}) {
    expect_refused(line + to, 2,
                   "share: " + shared().string() +
                       " is there already; --replace writes over it, --output names another");
    EXPECT_EQ(contents(shared()), "somebody's");
  }
  EXPECT_EQ(run(line + " --replace").code, 0);
  EXPECT_EQ(run(opening()).code, 0);
}

TEST_F(Sharing, NothingIsSharedWhileADriverWritesAndDamageIsSaid) {
  make_study();
  const int lock = ::open((dir() / ".lock").c_str(), O_RDWR);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  const Ended busy = run(study + " share" + out());
  ::close(lock);
  EXPECT_EQ(busy.code, 1);
  EXPECT_TRUE(contains(busy.err, "is working in " + dir().string()));
  EXPECT_FALSE(fs::exists(shared()));
  std::ofstream(dir() / "logs" / "run_0002.h5") << "damage";
  fs::remove(dir() / "report.html");
  const Ended said = run(study + " share" + out());
  ASSERT_EQ(said.code, 0) << said.err;
  EXPECT_TRUE(contains(said.out, "Caution: the log of run 2 is damaged and left out"));
  EXPECT_TRUE(contains(said.out, "Caution: there is no report; the command report makes one"));
  EXPECT_TRUE(
      contains(run(std::string(FORMULA_DEMO) + " open " + shared().string() + " " + elsewhere().string()).err,
               "and this is the program of \"formula_demo\""));
}

}  // namespace
