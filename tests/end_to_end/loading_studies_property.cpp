// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The studies of loading as programs, on a pile of one bucket: what they store is what their logs say, a
/// run can be made again, and report and replay show it.

#include <drawpoint/tests/end_to_end/support.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

class LoadingStudies : public StudyTest {
 protected:
  /// Three runs of one cycle, none of which fails.
  void make(const std::string& program) const {
    const Ended made =
        run(program + " run --runs 3 --validation 0 --cycles 1 --pile-mass 20 --jobs 2" + out());
    ASSERT_EQ(made.code, 0) << made.err;
    ASSERT_EQ(count("status = 'done'"), 3) << made.err;
    EXPECT_TRUE(contains(made.out, "fill_factor"));
  }
  /// The program takes the same responses from the logs, to the bit.
  void expect_equal_from_logs(const std::string& program, const std::string& responses) const {
    const auto anew = place_ / "anew";
    ASSERT_EQ(run(program + " rerun-responses --from " + dir().string() + " --out " + anew.string()).code, 0);
    EXPECT_EQ(values_in(anew / "study.db", responses), values_in(database(), responses));
  }
  static std::string values_in(const std::filesystem::path& store, const std::string& responses) {
    SQLite::Database database(store.string(), SQLite::OPEN_READONLY, 10000);
    return database
        .execAndGet("SELECT group_concat(id || ' ' || " + responses + " || ' ' || log, ', ') FROM runs")
        .getString();
  }
};

TEST_F(LoadingStudies, APresetIsShownWithItsValuesAndTheFolderKnowsIt) {
  const Ended help = run(LHD_LOADING " run --help");
  std::string line;  // as wide as it is printed, without its breaks
  for (const char c : help.out)
    if (c != '\n' && (c != ' ' || line.empty() || line.back() != ' '))
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  for (const char* part :
       {"--materials lindmark2016", "--pile-mass 800", "--cycles 30", "--spill before_front"})
    EXPECT_TRUE(contains(line, part));
  const std::string ask = LHD_LOADING " ask --runs 6 --validation 0 --file " + (place_ / "runs.csv").string();
  const auto status = [&] { return run(LHD_LOADING " status" + out()); };
  ASSERT_EQ(run(ask + " --preset lindmark2016" + out()).code, 0);
  EXPECT_TRUE(contains(status().out, "options: --preset lindmark2016\n"));
  std::filesystem::remove_all(dir());
  ASSERT_EQ(run(ask + " --preset lindmark2016 --cycles 4" + out()).code, 0);
  EXPECT_TRUE(contains(status().out, "options: --preset lindmark2016 --cycles 4\n"));
  std::filesystem::remove_all(dir());
  ASSERT_EQ(run(ask + " --haul 60" + out()).code, 0);
  EXPECT_TRUE(contains(status().out, "options: --haul 60\n"));
}

TEST_F(LoadingStudies, TheStrategyOfALoader) {
  ASSERT_NO_FATAL_FAILURE(make(LHD_LOADING));
  expect_equal_from_logs(LHD_LOADING, "quote(production) || quote(joint_damage) || quote(rock_spill)");
  EXPECT_EQ(count("production > 0 AND joint_damage >= 0 AND rock_spill >= 0"), 3);
  const std::string report = contents(dir() / "report.html");
  for (const char* part : {"Planned and actual path of the cutting edge", "The machine in the drift",
                           "Drive forces and the torque in hinge G", "Rock in the bucket"})
    EXPECT_TRUE(report.find(part) != std::string::npos) << part;
  const Ended again = run(LHD_LOADING " evaluate --run 2 --json" + out());
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(again.json()["as_stored"].get<bool>()) << again.out;
  EXPECT_NE(again.err.find("cycle 1 of 1: "), std::string::npos) << again.err;
  const Ended replay = run(LHD_LOADING " replay --run 2" + out());
  EXPECT_EQ(replay.code, 0) << replay.err;
  EXPECT_TRUE(std::filesystem::exists(dir() / "replay_0002.html"));
}

TEST_F(LoadingStudies, BucketSpeedsAndStrategy) {
  ASSERT_NO_FATAL_FAILURE(make(LHD_BUCKET_AND_SPEED));
  expect_equal_from_logs(LHD_BUCKET_AND_SPEED,
                         "quote(production) || quote(energy) || quote(pin_load) || quote(load)");
  EXPECT_EQ(count("production > 0 AND energy > 0 AND pin_load > 0 AND load > 0 AND load < 30"), 3);
}

TEST_F(LoadingStudies, FamiliesOfStrategies) {
  ASSERT_NO_FATAL_FAILURE(make(LHD_STRATEGIES));
  expect_equal_from_logs(LHD_STRATEGIES,
                         "quote(production) || quote(energy) || quote(pin_load) || quote(rock_spill)");
  EXPECT_EQ(count("production > 0 AND energy > 0 AND load > 0 AND load < 30 AND cycle_time > 5"), 3);
}

}  // namespace
