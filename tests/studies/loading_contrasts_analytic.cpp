// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Which cycles of a loading study are set against each other: the tip keeps a known distance from a straight
/// plan, and the loads and times are known.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/loading/loading_contrasts.h>
#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/studies/model/haul_choice.h>
#include <drawpoint/engine/loading/log/loading_log.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

using engine::loading::CycleRecord;
using engine::loading::LoadingLog;

struct Cycle {
  double off = 0;     ///< of the tip, above the plan at height 0 [m]
  double loaded = 0;  ///< [kg], in 10 s
};

LoadingLog log_of(const std::vector<Cycle>& cycles) {
  LoadingLog log;
  log.completed = true;
  for (const char* name : {"time", "cycle", "stage", "tip_x", "tip_y", "tip_z", "hinge_G_torque_x",
                           "hinge_G_torque_y", "hinge_G_torque_z"})
    log.signals.columns.push_back({name, "1"});
  for (std::size_t c = 0; c < cycles.size(); ++c) {
    CycleRecord cycle;
    cycle.number = static_cast<int>(c) + 1;
    cycle.t_start = 10.0 * static_cast<double>(c);
    cycle.t_end = cycle.t_start + 10;
    cycle.loaded_mass = cycles[c].loaded;
    cycle.planned_x = {0, 1, 2};
    cycle.planned_z = {0, 0, 0};
    cycle.contour_x = {-5, -1.5, -1, 0, 3};
    cycle.contour_z = {0, 0, 0, 0, 2};
    for (int i = 0; i < 100; ++i)
      log.signals.append_row(std::vector<double>{cycle.t_start + 0.1 * i, 1.0 + static_cast<double>(c), 1.0,
                                                 0.01 * i, 0.0, cycles[c].off, 0.0, 0.0, 0.0});
    log.cycles.push_back(cycle);
    log.scene.frames.push_back({cycle.t_start, cycle.number, "curl", 0.0});
  }
  return log;
}

std::string caption(const nlohmann::json& panel) { return panel["caption"]; }

bool begins(const std::string& text, const std::string& part) { return text.rfind(part, 0) == 0; }

// Ten runs: the second best and the last but one are shown.
TEST(LoadingContrasts, AreTypicalAndTrackedCyclesOfAllRuns) {
  const test::TestFolder place;
  std::vector<std::filesystem::path> logs = {place / "run_0007.h5", place / "run_0012.h5",
                                             place / "run_0013.h5", place / "run_0014.h5"};
  write_log(logs[0], log_of({{0.5, 4000}, {0.1, 1000}}));
  write_log(logs[1], log_of({{0.3, 6200}, {0.9, 5000}}));
  write_log(logs[2], log_of({{0.4, 7000}, {0.4, 7000}}));
  write_log(logs[3], log_of({{0.4, 500}, {0.4, 500}}));
  for (int run = 21; run <= 26; ++run) {
    logs.push_back(place / ("run_00" + std::to_string(run) + ".h5"));
    write_log(logs.back(), log_of({{0.4, 3000}, {0.4, 3000}}));
  }
  const auto panels = loading_contrasts(logs);
  ASSERT_EQ(panels.size(), 4u);
  EXPECT_EQ(panels[0]["type"], "scene");
  EXPECT_TRUE(
      begins(caption(panels[0]),
             "Run 12, cycle 2, of median production in a run of rank 2 of 10: 5.0 t in 10.0 s, 500 kg/s"))
      << caption(panels[0]);
  EXPECT_TRUE(
      begins(caption(panels[1]),
             "Run 7, cycle 2, of median production in a run of rank 9 of 10: 1.0 t in 10.0 s, 100 kg/s"))
      << caption(panels[1]);
  EXPECT_EQ(panels[1]["frames"].size(), 1u) << "of that cycle alone";
  EXPECT_EQ(panels[2]["type"], "path");
  EXPECT_TRUE(
      begins(caption(panels[2]), "Run 7, cycle 2, the best tracked of 20 cycles, its edge 0.10 m off"))
      << caption(panels[2]);
  EXPECT_TRUE(
      begins(caption(panels[3]), "Run 12, cycle 2, the worst tracked of 20 cycles, its edge 0.90 m off"))
      << caption(panels[3]);
  EXPECT_EQ(panels[2]["contour"]["x"], nlohmann::json({-1.0, 0.0, 3.0})) << "from a metre before the plan";
  const auto hauled = loading_contrasts(logs, {{"haul", "40"}});
  EXPECT_NE(caption(hauled[0]).find("100 kg/s with a haul of 40 s"), std::string::npos) << caption(hauled[0]);
}

// Of twenty runs the luckiest has one cycle beyond all others; shown is the median cycle of the third run from the top.
TEST(LoadingContrasts, ShowATypicalCycleAndNotTheLuckiest) {
  const test::TestFolder place;
  std::vector<std::filesystem::path> logs;
  for (int i = 1; i <= 20; ++i) {
    logs.push_back(place / ("run_00" + std::to_string(10 + i) + ".h5"));
    const double load = 100.0 * i;
    write_log(logs.back(), log_of({{0, 9000.0 * (i == 3)}, {0, load}, {0, load + 50}}));
  }
  const auto panels = loading_contrasts(logs);
  ASSERT_EQ(panels.size(), 2u) << "all are tracked alike";
  // By the mean of three: run 13 (9000 and 300 and 350) first, then 30, 29, 28; so rank 3 of 20 is run 29.
  EXPECT_TRUE(begins(caption(panels[0]), "Run 29, cycle 2, of median production in a run of rank 3 of 20"))
      << caption(panels[0]);
  EXPECT_TRUE(begins(caption(panels[1]), "Run 14, cycle 2, of median production in a run of rank 18 of 20"))
      << caption(panels[1]);
}

// The rate that cycles give is the response, whatever the haul.
TEST(LoadingCycles, GiveTheProductionOfTheRun) {
  const test::TestFolder place;
  const LoadingLog log = log_of({{0.5, 4000}, {0.1, 1000}, {0.1, 2500}});
  write_log(place / "run_0003.h5", log);
  for (const char* haul : {"0", "37", "600"}) {
    const OptionValues options{{"haul", haul}};
    const CycleWork work = loading_cycles(place / "run_0003.h5", options);
    const WorkOfRun run{3, {}, work.loads, work.seconds};
    EXPECT_EQ(work.rate, "production");
    EXPECT_NEAR(run.rate(work.haul), production(log, production_options(options)), 1e-12);
  }
  EXPECT_EQ(typical_cycle(log, {}), 2u) << "2500 kg lie between 1000 and 4000";
}

TEST(LoadingContrasts, AreNoneOfOneCycleOrOfEqualOnes) {
  const test::TestFolder place;
  write_log(place / "run_0001.h5", log_of({{0.5, 4000}}));
  EXPECT_TRUE(loading_contrasts({}).empty());
  EXPECT_TRUE(loading_contrasts({place / "run_0001.h5"}).empty());
  EXPECT_TRUE(loading_contrasts({place / "run_0001.h5", place / "run_0001.h5"}).empty());
  write_log(place / "run_0002.h5", log_of({{0.5, 6000}}));
  EXPECT_TRUE(loading_contrasts({place / "run_0001.h5", place / "run_0002.h5"}).empty())
      << "of two runs none is good or bad, nor tracked better";
}

// A log without plans still has loads.
TEST(LoadingContrasts, LeaveOutWhatALogLacks) {
  const test::TestFolder place;
  LoadingLog log = log_of({{0.5, 4000}, {0.1, 1000}});
  for (CycleRecord& cycle : log.cycles) cycle.planned_x = cycle.planned_z = {};
  std::vector<std::filesystem::path> logs;
  for (int run = 11; run <= 20; ++run) {
    log.cycles[0].loaded_mass = 100 * run;
    logs.push_back(place / ("run_00" + std::to_string(run) + ".h5"));
    write_log(logs.back(), log);
  }
  const auto panels = loading_contrasts(logs);
  ASSERT_EQ(panels.size(), 2u);
  EXPECT_EQ(panels[0]["type"], "scene");
}

}  // namespace
