// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A full disk: each command that writes says so and what to do, and what was there stays as it was.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <map>
#include <sstream>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string study = TROUBLED_STUDY;

std::string with(const std::string& trouble) { return "env TROUBLE=" + trouble + " " + study + " "; }

/// Commands in a mount namespace of their own, with a small file system at dir(); skipped where the system
/// allows none.
class SmallDisk : public StudyTest {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(dir());
    if (run(inside("true", "3m")).code != 0) GTEST_SKIP() << "no mount namespaces here";
  }
  std::string inside(const std::string& script, const std::string& size) const {
    return std::string("unshare ") + (geteuid() == 0 ? "-m" : "-rm") +
           " sh -c 'mount -t tmpfs -o size=" + size + " tmpfs " + dir().string() + " && " + script + "'";
  }
  std::filesystem::path file(const std::string& name) const { return place_ / name; }
};

/// What a command tried on the full disk ended with, and what it said.
struct Tried {
  int code = -1;
  std::string said;
};

/// Of lines NAME CODE WORDS.
std::map<std::string, Tried> tried_in(const std::string& out) {
  std::map<std::string, Tried> all;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    Tried tried;
    if (words >> name >> tried.code && std::getline(words, tried.said)) all[name] = tried;
  }
  return all;
}

/// Shell functions: try NAME COMMAND... prints a line NAME CODE WORDS; fill N leaves N KiB of the disk free.
constexpr const char* functions = R"sh(
try() { name=$1; shift; "$@" >/dev/null 2>"$PLACE/err"; echo "$name $? $(tr '\n' ' ' <"$PLACE/err")"; }
fill() {
  rm -f "$DIR/fill"; dd if=/dev/zero of="$DIR/fill" bs=1k 2>/dev/null
  truncate -s $(($(stat -c %s "$DIR/fill") - 1024 * $1)) "$DIR/fill"
}
)sh";

/// A study with a page of a run, tables and a film; then a full disk, on which every command is tried.
constexpr const char* full_disk = R"sh(
set -e; cd "$DIR"; export TROUBLE=filmed TMPDIR="$PLACE"
$STUDY --runs 12 --validation 0 --out . >/dev/null 2>&1
$STUDY export --out . --file runs.csv 2>/dev/null
$STUDY export --out . --format hdf5 --file study.h5 2>/dev/null
for id in 1 2 3 4 5 6; do $STUDY replay --run $id --out . >/dev/null 2>&1 && break; done
$STUDY ask --runs 14 --out . --file "$PLACE/asked.csv" 2>/dev/null
awk 'NR == 1 {print $0 ",cost,wear"} NR > 1 {print $0 ",1,2"}' "$PLACE/asked.csv" > "$PLACE/told.csv"
echo old > film.mp4
find . -type f ! -name .lock | sort > "$PLACE/names"; xargs md5sum < "$PLACE/names" > "$PLACE/sums"
set +e; fill 0
try tell $STUDY tell --out . --file "$PLACE/told.csv"
try ask $STUDY ask --runs 20 --out . --file asked.csv
try csv $STUDY export --out . --file runs.csv
try hdf5 $STUDY export --out . --format hdf5 --file study.h5
try front $STUDY export --out . --what front --format json --file front.json
try report $STUDY report --out .
try replay $STUDY replay --run $id --out .
try frames $STUDY replay --run $id --out . --frames "$DIR" --size 64x64 --fps 1
fill 4
try video $STUDY replay --run $id --out . --video film.mp4 --size 640x360 --fps 20
md5sum --quiet -c "$PLACE/sums" && echo same 0 files
rm fill; find . -type f ! -name .lock | sort | diff - "$PLACE/names" && echo no 0 others
)sh";

/// 3 MiB, of which 1 MiB must stay free. "large": logs of 0.3 MB, so the study stops before the disk is full.
/// "huge": logs of 2 MB, so the second run meets the full disk itself.
TEST_F(SmallDisk, AFullDiskStopsTheStudyAndMoreSpaceLetsItGoOn) {
  for (const std::string size : {"large", "huge"}) {
    const std::string command = with(size) + "--runs 8 --validation 2 --jobs 1" + out();
    const std::string status = study + " status --json" + out();
    const Ended end = run(inside(command + "; echo code $?; " + status + "; mount -o remount,size=90m " +
                                     dir().string() + " && " + command + " && " + status,
                                 "3m"));
    EXPECT_EQ(end.code, 0) << end.err;
    EXPECT_TRUE(contains(end.err,
                         "is full; free some space and give the same command again; finished runs are kept"));
    EXPECT_TRUE(contains(end.out, "code 1\n"));
    const std::size_t start = end.out.find('{', end.out.find("code 1"));
    const auto before =
        nlohmann::json::parse(end.out.substr(start, end.out.find('\n', start) - start), nullptr, false);
    EXPECT_GE(before["training"]["done"].get<int>(), size == "large" ? 5 : 1);
    EXPECT_EQ(before["training"]["failed"], 0);
    EXPECT_EQ(before["training"]["running"], 0);
    EXPECT_EQ(end.json()["training"]["done"], 8);
    EXPECT_EQ(end.json()["validation"]["done"], 2);
  }
}

TEST_F(SmallDisk, AReadOnlyFolder) {
  const Ended end = run(inside("mount -o remount,ro " + dir().string() + " && exec " + study + out(), "3m"));
  EXPECT_EQ(end.code, 1);
  EXPECT_TRUE(
      contains(end.err, "Read-only file system; allow writing there, or choose another folder with --out"));
}

// A film that ffmpeg could not end is no film, though what fails is its last write only.
TEST_F(SmallDisk, EveryCommandSaysSoAndLeavesWhatWasThere) {
  std::ofstream(file("script.sh")) << "STUDY=" << study << " DIR=" << dir().string()
                                   << " PLACE=" << place_.string() << functions << full_disk;
  const Ended end = run(inside("sh " + file("script.sh").string(), "24m"));
  const std::map<std::string, Tried> tried = tried_in(end.out);
  for (const char* name : {"tell", "ask", "csv", "hdf5", "front", "report", "replay", "frames", "video"}) {
    ASSERT_TRUE(tried.contains(name)) << name << "\n" << end.out << end.err;
    EXPECT_EQ(tried.at(name).code, 1) << name;
    EXPECT_TRUE(contains(tried.at(name).said, "No space left on device")) << name;
    EXPECT_TRUE(contains(tried.at(name).said, name == std::string("tell") || name == std::string("ask")
                                                  ? "free some space"
                                                  : "free space"))
        << name;
  }
  EXPECT_TRUE(contains(end.out, "same 0 files"));
  EXPECT_TRUE(contains(end.out, "no 0 others")) << "half a file, or a temporary one, is left";
}

}  // namespace
