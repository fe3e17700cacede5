// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Which cycles of a loading study are set against each other: the tip keeps a known distance from a straight
/// plan, and the loads and times are known.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/loading_contrasts.h>
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

TEST(LoadingContrasts, AreTheExtremeCyclesOfAllRuns) {
  const test::TestFolder place;
  write_log(place / "run_0007.h5", log_of({{0.5, 4000}, {0.1, 1000}}));
  write_log(place / "run_0012.h5", log_of({{0.3, 6200}, {0.9, 5000}}));
  const auto panels = loading_contrasts({place / "run_0007.h5", place / "run_0012.h5"});
  ASSERT_EQ(panels.size(), 4u);
  EXPECT_EQ(panels[0]["type"], "path");
  EXPECT_TRUE(begins(caption(panels[0]), "Run 7, cycle 2, the best tracked of 4 cycles, its edge 0.10 m off"))
      << caption(panels[0]);
  EXPECT_TRUE(
      begins(caption(panels[1]), "Run 12, cycle 2, the worst tracked of 4 cycles, its edge 0.90 m off"))
      << caption(panels[1]);
  EXPECT_EQ(panels[0]["contour"]["x"], nlohmann::json({-1.0, 0.0, 3.0})) << "from a metre before the plan";
  EXPECT_EQ(panels[2]["type"], "scene");
  EXPECT_TRUE(begins(caption(panels[2]),
                     "Run 12, cycle 1, the highest production of 4 cycles: 6.2 t in 10.0 s, 620 kg/s"))
      << caption(panels[2]);
  EXPECT_TRUE(begins(caption(panels[3]),
                     "Run 7, cycle 2, the lowest production of 4 cycles: 1.0 t in 10.0 s, 100 kg/s"))
      << caption(panels[3]);
  EXPECT_EQ(panels[3]["frames"].size(), 1u) << "of that cycle alone";
  const auto hauled = loading_contrasts({place / "run_0007.h5", place / "run_0012.h5"}, {{"haul", "52"}});
  EXPECT_TRUE(begins(caption(hauled[2]),
                     "Run 12, cycle 1, the highest production of 4 cycles: 6.2 t in 10.0 s, 100 "
                     "kg/s with a haul of 52 s"))
      << caption(hauled[2]);
}

TEST(LoadingContrasts, AreNoneOfOneCycleOrOfEqualOnes) {
  const test::TestFolder place;
  write_log(place / "run_0001.h5", log_of({{0.5, 4000}}));
  EXPECT_TRUE(loading_contrasts({}).empty());
  EXPECT_TRUE(loading_contrasts({place / "run_0001.h5"}).empty());
  EXPECT_TRUE(loading_contrasts({place / "run_0001.h5", place / "run_0001.h5"}).empty());
}

// A log without plans still has loads.
TEST(LoadingContrasts, LeaveOutWhatALogLacks) {
  const test::TestFolder place;
  LoadingLog log = log_of({{0.5, 4000}, {0.1, 1000}});
  for (CycleRecord& cycle : log.cycles) cycle.planned_x = cycle.planned_z = {};
  write_log(place / "run_0003.h5", log);
  const auto panels = loading_contrasts({place / "run_0003.h5"});
  ASSERT_EQ(panels.size(), 2u);
  EXPECT_EQ(panels[0]["type"], "scene");
}

}  // namespace
