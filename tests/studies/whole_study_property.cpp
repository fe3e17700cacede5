// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A study in one HDF5 file: all of it, bit for bit, with units; equal studies give equal files, and what goes
// wrong leaves the old one.
#include <drawpoint/studies/say/export.h>
#include <drawpoint/studies/say/whole_study.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <drawpoint/engine/record/file.hpp>
#include <drawpoint/tests/studies/support.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;
using namespace drawpoint::studies::test;

namespace {

namespace fs = std::filesystem;
namespace record = drawpoint::engine::record;

// Names that files cannot have as they are, a level's name, a unit beyond ASCII.
Identity awkward_study() {
  Identity study = identity();
  study.problem = {
      .variables = {{"seed", "µm", 0.0, 1.0},
                    {"mass/time", "kg/s", -1.0, 3.0},
                    doe::categorical_variable("bucket", {"wide", "deep é"})},
      .responses = {{"production", "kg/s", doe::Goal::maximize}, {"spill", "1", doe::Goal::at_most, 0.25}}};
  study.problem.variables[1].description = "of the belt";
  study.options = {{"rock", "ore"}};
  return study;
}

// Every third of them a validation run, the last one failed; smooth responses with a trade-off.
std::vector<Run> made_runs(int count) {
  std::vector<Run> runs;
  for (int k = 0; k < count; ++k) {
    Run run;
    run.id = k + 1;
    run.point = k + 1;
    run.kind = k % 3 == 2 ? Kind::validation : Kind::training;
    run.seed = 18446744073709551615ull - static_cast<doe::Seed>(k);
    run.x = Eigen::Vector3d(std::fmod(0.618 * k, 1.0), -1 + 4 * std::fmod(0.414 * k, 1.0), k % 2);
    run.y = Eigen::Vector2d(run.x[0] + 0.1 * run.x[1] + 0.2 * run.x[2], run.x[0] * run.x[0]);
    run.predicted = run.lower = run.upper = Eigen::Vector2d::Constant(std::nan(""));
    run.status = Status::done;
    run.seconds = 0.1 * k;
    runs.push_back(run);
  }
  runs.back().status = Status::failed;
  runs.back().reason = "stuck “fast”";
  runs.back().y.setConstant(std::nan(""));
  return runs;
}

// Paths of all data below a group.
std::vector<std::string> data_below(const record::Reader& file, const std::string& group) {
  std::vector<std::string> paths;
  for (const std::string& name : file.children(group)) {
    const std::string path = group.empty() ? name : group + "/" + name;
    const auto said = file.attributes(path);
    if (!said.empty()) {
      paths.push_back(path);
      EXPECT_EQ(said, (std::vector<std::string>{"description", "unit"})) << path;
      EXPECT_NE(file.text(path, "description"), "") << path;
      continue;
    }
    const auto below = data_below(file, path);
    EXPECT_FALSE(below.empty()) << path << " is data without attributes, or an empty group";
    paths.insert(paths.end(), below.begin(), below.end());
  }
  return paths;
}

record::Reader opened(const fs::path& file) { return {file, {"drawpoint study", 1}, record::Form::plain}; }

}  // namespace

TEST(WholeStudy, HoldsTheProblemAndEveryRun) {
  const TestFolder folder;
  const fs::path path = folder / "study.h5";
  const Identity study = awkward_study();
  const auto runs = made_runs(30);
  EXPECT_EQ(write_whole_study(path, study, runs), "");
  const record::Reader file = opened(path);
  EXPECT_EQ(file.texts("study/seed"), std::vector<std::string>{"18446744073709551557"});
  EXPECT_EQ(file.texts("options/rock"), std::vector<std::string>{"ore"});
  EXPECT_EQ(file.texts("variables/name"), (std::vector<std::string>{"seed", "mass/time", "bucket"}));
  EXPECT_EQ(file.texts("variables/unit"), (std::vector<std::string>{"µm", "kg/s", "1"}));
  EXPECT_EQ(file.doubles("variables/lower").values, (std::vector<double>{0, -1, 0}));
  EXPECT_EQ(file.texts("levels/bucket"), (std::vector<std::string>{"wide", "deep é"}));
  EXPECT_EQ(file.texts("responses/goal"), (std::vector<std::string>{"maximize", "at_most"}));
  EXPECT_TRUE(std::isnan(file.doubles("responses/limit").values[0]));
  EXPECT_EQ(file.doubles("responses/limit").values[1], 0.25);
  EXPECT_EQ(file.doubles("responses/upper").values[1], std::numeric_limits<double>::infinity());

  const auto seeds = file.texts("runs/seed"), buckets = file.texts("runs/bucket");
  const auto kinds = file.texts("runs/kind"), reasons = file.texts("runs/reason");
  const auto x = file.doubles("runs/seed_").values, belt = file.doubles("runs/mass_time").values;
  const auto production = file.doubles("runs/production").values;
  ASSERT_EQ(x.size(), runs.size());
  EXPECT_EQ(file.integers("runs/run").values.back(), 30);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    EXPECT_EQ(seeds[k], std::to_string(runs[k].seed));
    EXPECT_EQ(kinds[k], name_of(runs[k].kind));
    EXPECT_EQ(x[k], runs[k].x[0]);
    EXPECT_EQ(belt[k], runs[k].x[1]);
    EXPECT_EQ(buckets[k], k % 2 ? "deep é" : "wide");
    if (runs[k].status == Status::done) {
      EXPECT_EQ(production[k], runs[k].y[0]);
    }
  }
  EXPECT_TRUE(std::isnan(production.back()));
  EXPECT_EQ(reasons.back(), "stuck “fast”");
  EXPECT_EQ(file.text("runs/mass_time", "unit"), "kg/s");
  EXPECT_EQ(file.text("runs/mass_time", "description"), "of the belt");
  data_below(file, "");
}

// What CSV and JSON have of the front, and the standard error: of these smooth responses less than the
// interval of one run.
TEST(WholeStudy, HoldsTheFrontOfTheTable) {
  const TestFolder folder;
  const Identity study = awkward_study();
  const auto runs = made_runs(30);
  write_whole_study(folder / "study.h5", study, runs);
  const record::Reader file = opened(folder / "study.h5");
  const ExportTable front = front_table(study, runs);
  ASSERT_GT(front.rows.size(), 0u);
  EXPECT_EQ(file.children("front").size(), front.columns.size());
  const auto mean = file.doubles("front/production").values;
  const auto lower = file.doubles("front/production_lower").values;
  const auto upper = file.doubles("front/production_upper").values;
  const auto error = file.doubles("front/production_standard_error").values;
  const auto on_front = file.doubles("front/non_dominated").values;
  ASSERT_EQ(mean.size(), front.rows.size());
  EXPECT_GT(*std::max_element(on_front.begin(), on_front.end()), 0);
  for (std::size_t i = 0; i < mean.size(); ++i) {
    EXPECT_EQ(mean[i], front.rows[i][3].get<double>());
    EXPECT_GE(error[i], 0);
    EXPECT_TRUE(on_front[i] >= 0 && on_front[i] <= 1) << on_front[i];
    EXPECT_LE(error[i], upper[i] - lower[i]);
  }
}

TEST(WholeStudy, SaysWhyThereIsNoFront) {
  const TestFolder folder;
  const std::string why = write_whole_study(folder / "study.h5", awkward_study(), made_runs(1));
  EXPECT_NE(why.find("there are no models"), std::string::npos) << why;
  const record::Reader file = opened(folder / "study.h5");
  EXPECT_EQ(file.texts("study/no_front"), std::vector<std::string>{why});
  EXPECT_FALSE(file.has("front"));
  Identity records_only = awkward_study();
  for (doe::Response& response : records_only.problem.responses) response.goal = doe::Goal::record;
  EXPECT_NE(write_whole_study(folder / "records.h5", records_only, made_runs(12)), "");
  EXPECT_TRUE(opened(folder / "records.h5").has("study/no_front"));
  write_whole_study(folder / "none.h5", awkward_study(), {});
  EXPECT_TRUE(opened(folder / "none.h5").doubles("runs/production").values.empty());
}

TEST(WholeStudy, EqualStudiesAreEqualFiles) {
  const TestFolder folder;
  for (const char* name : {"a.h5", "b.h5"}) write_whole_study(folder / name, awkward_study(), made_runs(12));
  EXPECT_EQ(contents(folder / "a.h5"), contents(folder / "b.h5"));
}

// A limit on the size of files acts as a full disk does.
TEST(WholeStudy, AFullDiskLeavesTheOldFile) {
  const TestFolder folder;
  const fs::path file = folder / "study.h5";
  write_file(file, "old");
  rlimit old_limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, old_limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string told = complaint([&] { write_whole_study(file, awkward_study(), made_runs(2)); });
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(told.find(file.string()), std::string::npos) << told;
  EXPECT_NE(told.find("check the folder and the free space"), std::string::npos) << told;
  EXPECT_EQ(contents(file), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}
