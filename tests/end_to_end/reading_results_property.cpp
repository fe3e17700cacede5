// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Results in other programs: docs/reading-results.md, followed to the letter.

#include <drawpoint/tests/end_to_end/documents.hpp>

#include <algorithm>
#include <cstdio>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <nlohmann/json.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

class ReadingResults : public StudyTest {};

// Ten samples and two frames of a log.
void write_short_log(const std::filesystem::path& file) {
  engine::loading::LoadingLog log;
  log.numbers = {{"pile_mass", 120e3}};
  log.signals.columns = {{"time", "s", "end of the step"},
                         {"hinge_G_torque_x", "N m", "about the long axis"}};
  for (int k = 0; k < 10; ++k) log.signals.append_row(std::vector<double>{0.01 * k, 1e4 * k});
  log.scene.frames = {{0.0, 1, "drive in", 0.0}, {0.05, 1, "lift", 1200.0}};
  engine::loading::write_log(file, log);
}

// Of the table that export gives as JSON.
double most_production(const std::string& table) {
  const auto front = nlohmann::json::parse(table);
  std::size_t column = 0;
  while (front["columns"][column]["name"] != "production") ++column;
  double most = 0;
  for (const auto& row : front["rows"]) most = std::max(most, row[column].get<double>());
  return most;
}

}  // namespace

TEST_F(ReadingResults, TheDocumentsCommandsWorkAsTyped) {
  write_short_log(place_ / "run_0001.h5");
  const std::vector<std::string> printed = follow(contents(READING_RESULTS), place_);
  ASSERT_EQ(printed.size(), 5u);

  const Ended table = run(FORMULA_DEMO " export --what front --format json --out " +
                          (place_ / "results/formula_demo").string());
  char most[64];
  std::snprintf(most, sizeof most, "most production: %.0f kg/s", most_production(table.out));
  EXPECT_TRUE(contains(printed[1], most));
  EXPECT_TRUE(contains(printed[3], std::string(most) + ", standard error "));

  EXPECT_TRUE(contains(printed[4], "numbers/pile_mass () [kg] rock at first"));
  EXPECT_TRUE(contains(printed[4], "signals/values (10, 2) [signals/units] a row per step"));
  EXPECT_TRUE(contains(printed[4], "descriptions ['end of the step', 'about the long axis']"));
  EXPECT_GT(std::filesystem::file_size(place_ / "run.png"), 1000u);

  for (const char* file : {"study.h5", "run_0001.h5"}) {
    const Ended octave = run("env PATH=/usr/bin:/bin python3 " OCTAVE_NEEDS " " + (place_ / file).string());
    EXPECT_EQ(octave.code, 0) << file << ": " << octave.out << octave.err;
  }
}
