// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Results in other programs: docs/how-to/reading-results.md, followed to the letter.

#include <drawpoint/tests/end_to_end/documents.hpp>

#include <algorithm>
#include <cstdio>
#include <drawpoint/doe/detail/csv.hpp>
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

/// The first fields of each line of a table, all but `less` of them.
std::vector<std::vector<std::string>> fields_of(const std::string& table, std::size_t less) {
  std::vector<std::vector<std::string>> rows;
  doe::detail::CsvReader reader(table);
  while (auto record = reader.next()) {
    record->resize(record->size() - less);
    rows.push_back(*record);
  }
  return rows;
}

}  // namespace

TEST_F(ReadingResults, TheDocumentsCommandsWorkAsTyped) {
  write_short_log(place_ / "run_0001.h5");
  const std::vector<std::string> printed = follow(contents(READING_RESULTS), place_);
  ASSERT_EQ(printed.size(), 9u);

  // The same models at the same points: the same numbers, but for the chance of being non-dominated and of success.
  EXPECT_EQ(fields_of(contents(place_ / "expected.csv"), 1), fields_of(contents(place_ / "front.csv"), 2));

  const Ended table = run(FORMULA_DEMO " export --what front --format json --out " +
                          (place_ / "results/formula_demo").string());
  char most[64];
  std::snprintf(most, sizeof most, "most production: %.0f kg/s", most_production(table.out));
  for (const std::size_t table_of : {1, 2}) EXPECT_TRUE(contains(printed[table_of], most));
  const std::string sure = std::string(most) + ", standard error ";
  for (const std::size_t whole : {4, 5}) EXPECT_TRUE(contains(printed[whole], sure));
  EXPECT_EQ(printed[4], printed[5].substr(0, printed[5].find('\n') + 1)) << "Python and Octave differ";
  EXPECT_TRUE(contains(printed[5], "50 runs, the fastest in "));

  EXPECT_TRUE(contains(printed[6], "50 runs; most production in run "));
  EXPECT_GT(std::filesystem::file_size(place_ / "runs.png"), 1000u);
  EXPECT_TRUE(contains(printed[7], "numbers/pile_mass () [kg] rock at first"));
  EXPECT_TRUE(contains(printed[7], "signals/values (10, 2) [signals/units] a row per step"));
  EXPECT_TRUE(contains(printed[7], "descriptions ['end of the step', 'about the long axis']"));
  EXPECT_GT(std::filesystem::file_size(place_ / "run.png"), 1000u);
  EXPECT_EQ(printed[8], "120 t of rock, 0.09 s, at most 90 kN m\n");

  for (const char* file : {"study.h5", "run_0001.h5"}) {
    const Ended octave = run("env PATH=/usr/bin:/bin python3 " OCTAVE_NEEDS " " + (place_ / file).string());
    EXPECT_EQ(octave.code, 0) << file << ": " << octave.out << octave.err;
  }
}
