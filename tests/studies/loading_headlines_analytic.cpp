// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What the loading study says first, on logs whose cycles are known.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/loading/loading_headlines.h>
#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/log/responses.hpp>

#include <cmath>
#include <map>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

using engine::loading::CycleRecord;
using engine::loading::LoadingLog;
using engine::loading::Stage;
using engine::loading::StageEnd;

/// A cycle and what its bucket loses [kg].
struct Cycle {
  CycleRecord record;
  double lost;
};

/// Of 10 s, without torque.
Cycle cycle(double start, double loaded, double lost, StageEnd end) {
  CycleRecord record;
  record.t_start = start;
  record.t_end = start + 10;
  record.loaded_mass = loaded;
  record.stages.resize(1);
  record.stages[0].stage = Stage::drive_in;
  record.stages[0].reason = end;
  return {record, lost};
}

LoadingLog log_of(const std::vector<Cycle>& cycles) {
  LoadingLog log;
  log.completed = true;
  log.numbers = {{"payload", 20e3}, {"pile_mass", 120e3}, {"pile_crest", 2.5}, {"pile_angle_deg", 37}};
  log.signals.columns = {{"time", "s"},
                         {"cycle", "1"},
                         {"hinge_G_torque_x", "N m"},
                         {"hinge_G_torque_y", "N m"},
                         {"hinge_G_torque_z", "N m"}};
  for (const Cycle& cycle : cycles) {
    log.cycles.push_back(cycle.record);
    const int number = log.cycles.back().number = static_cast<int>(log.cycles.size());
    for (const double held : {cycle.lost, 0.0})
      log.scene.frames.push_back({.t = 0, .cycle = number, .label = "", .bucket_mass = held});
  }
  return log;
}

class LoadingHeadlines : public testing::Test {
 protected:
  std::map<std::string, Headline> told(const std::vector<LoadingLog>& logs,
                                       const OptionValues& options = {}) {
    std::vector<std::filesystem::path> files;
    for (const LoadingLog& log : logs) {
      files.push_back(place_ / (std::to_string(files.size()) + ".h5"));
      write_log(files.back(), log);
    }
    std::map<std::string, Headline> named;
    for (const Headline& headline : loading_headlines(files, options)) named[headline.name] = headline;
    return named;
  }
  test::TestFolder place_;
};

// Two runs of two cycles: 4 and 8 t, 6 and 6 t in 10 s. The rates' deviations from their run's mean, ±200 and 0
// kg/s, are ±100 from what the number of the cycle has in the mean: four of them over one degree of freedom are
// √(4 · 100²) = 200 kg/s per cycle, 200/√2 for a mean of two. Spill 0, 2 and 1, 1 t of 10: √(4 · 0.05²)/√2 =
// 0.1/√2. No torque, no damage, no noise of it.
TEST_F(LoadingHeadlines, SayFillStallsAndNoise) {
  const auto of = told({log_of({cycle(0, 4e3, 0, StageEnd::goal), cycle(20, 8e3, 2e3, StageEnd::timeout)}),
                        log_of({cycle(0, 6e3, 1e3, StageEnd::goal), cycle(20, 6e3, 1e3, StageEnd::goal)})});
  EXPECT_DOUBLE_EQ(of.at("fill_factor").value, 0.3);
  EXPECT_NE(of.at("fill_factor").note.find("0.30 in the run that loaded most"), std::string::npos);
  EXPECT_DOUBLE_EQ(of.at("stall_share").value, 0.25);
  EXPECT_NEAR(of.at("noise_of_production").value, 200 / std::sqrt(2.0), 1e-9);
  EXPECT_EQ(of.at("noise_of_production").unit, "kg/s");
  EXPECT_NEAR(of.at("noise_of_rock_spill").value, 0.1 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(of.at("noise_of_joint_damage").value, 0);
  EXPECT_EQ(of.at("pile_angle").value, 37);
  EXPECT_NE(of.at("pile_angle").note.find("120 t, crest 2.5 m"), std::string::npos);
}

// Means over cycles of 0 and 400 kg/s: the noise of 0 is 0 % of a range of 400.
TEST_F(LoadingHeadlines, NoiseIsSetAgainstTheRangeOfTheRuns) {
  const auto of = told({log_of({cycle(0, 0, 0, StageEnd::goal), cycle(20, 0, 0, StageEnd::goal)}),
                        log_of({cycle(0, 3e3, 0, StageEnd::goal), cycle(20, 5e3, 0, StageEnd::goal)})});
  // √(4 · 50²) / √2 = 70.7 of 400 kg/s
  EXPECT_NE(of.at("noise_of_production").note.find("18 % of the range"), std::string::npos)
      << of.at("noise_of_production").note;
}

TEST_F(LoadingHeadlines, OneCycleTellsNoNoise) {
  const auto of = told({log_of({cycle(0, 4e3, 0, StageEnd::goal)})});
  EXPECT_TRUE(std::isnan(of.at("noise_of_production").value));
  EXPECT_NE(of.at("noise_of_production").note.find("--cycles 2"), std::string::npos);
}

// What these logs know is told, what they lack is unknown with the reason: no signals of the drives.
TEST_F(LoadingHeadlines, MeasuresThatTheLogsLackAreUnknown) {
  const auto of = told({log_of({cycle(0, 4e3, 0, StageEnd::goal)})});
  EXPECT_DOUBLE_EQ(of.at("cycle_time").value, 10);
  for (const char* name : {"heaped_fill", "energy_per_tonne", "tracking_error", "drive_lag", "wheel_slip",
                           "peak_bucket_force", "peak_pin_force", "pin_load_range"}) {
    EXPECT_TRUE(std::isnan(of.at(name).value)) << name;
    EXPECT_NE(of.at(name).note.find("lack"), std::string::npos) << name;
  }
}

// The second cycle brings 200 kg/s more in every run: that is no noise. Of squares of 1e5 round-off leaves 1e-10.
TEST_F(LoadingHeadlines, WhatTheNumberOfACycleDoesIsNoNoise) {
  const auto of = told({log_of({cycle(0, 2e3, 0, StageEnd::goal), cycle(20, 4e3, 0, StageEnd::goal)}),
                        log_of({cycle(0, 3e3, 0, StageEnd::goal), cycle(20, 5e3, 0, StageEnd::goal)})});
  EXPECT_NEAR(of.at("noise_of_production").value, 0, 1e-5);
}

// Two runs of three cycles and one of a single cycle, which lost two. Rates 200, 400, 600 and 400, 400, 400 kg/s:
// ±100 from what their numbers have in the mean, 4 · 100² over 4 − 2 degrees; the variances of the three means
// are a third, a third and all of it.
TEST_F(LoadingHeadlines, RunsThatLostCyclesTellTheNoiseOfTheirOwn) {
  const auto of = told({log_of({cycle(0, 2e3, 0, StageEnd::goal), cycle(20, 4e3, 0, StageEnd::goal),
                                cycle(40, 6e3, 0, StageEnd::goal)}),
                        log_of({cycle(0, 4e3, 0, StageEnd::goal), cycle(20, 4e3, 0, StageEnd::goal),
                                cycle(40, 4e3, 0, StageEnd::goal)}),
                        log_of({cycle(0, 4e3, 0, StageEnd::goal)})});
  EXPECT_NEAR(of.at("noise_of_production").value, std::sqrt(2e4 * 5 / 9), 1e-9);
  EXPECT_NE(of.at("noise_of_production").note.find("its 1 to 3 cycles"), std::string::npos);
}

// Damage is that of eight cycles, of which two were run: 8 times the mean of two that scatter by s, so 8 s/√2.
// The other run has none in either, so that s is half of how far the first run's two are apart.
TEST_F(LoadingHeadlines, DamageOfCyclesThatWereLeftOutIsNoBetterKnown) {
  LoadingLog none = log_of({cycle(0, 4e3, 0, StageEnd::goal), cycle(20, 4e3, 0, StageEnd::goal)});
  none.numbers["left_out_cycles"] = 6;
  LoadingLog log = none;
  for (int k = 1; k <= 100; ++k) log.signals.append_row(std::vector<double>{0.1 * k, 1, 0, 290e3, 0});
  for (int k = 1; k <= 100; ++k) log.signals.append_row(std::vector<double>{20 + 0.1 * k, 2, 0, 580e3, 0});
  const std::vector<double> damage = joint_damage_by_cycle(log);
  ASSERT_GT(std::abs(damage[0] - damage[1]), 5);
  const double s = std::abs(damage[0] - damage[1]) / 2;
  EXPECT_NEAR(told({log, none}).at("noise_of_joint_damage").value, 8 * s / std::sqrt(2.0), 1e-12);
}

// Only where it happened: one run of two with three such steps, 50 kg and two lost cycles.
TEST_F(LoadingHeadlines, TellWhereTheSolutionBrokeDown) {
  const LoadingLog fine = log_of({cycle(0, 4e3, 0, StageEnd::goal)});
  LoadingLog broken = fine;
  EXPECT_FALSE(told({fine}).contains("solution_broke_down"));
  broken.numbers["repeated_steps"] = 3;
  broken.numbers["escaped_mass"] = 50;
  broken.numbers["lost_cycles"] = 2;
  const Headline headline = told({fine, broken}).at("solution_broke_down");
  EXPECT_EQ(headline.value, 1);
  EXPECT_NE(headline.note.find("3 steps"), std::string::npos) << headline.note;
  EXPECT_NE(headline.note.find("50 kg"), std::string::npos) << headline.note;
  EXPECT_NE(headline.note.find("2 cycles were lost"), std::string::npos) << headline.note;
}

TEST_F(LoadingHeadlines, FillStallsAndNoiseComeFirst) {
  write_log(place_ / "run.h5", log_of({cycle(0, 4e3, 0, StageEnd::goal)}));
  const auto said = loading_headlines({place_ / "run.h5"});
  EXPECT_EQ(said[0].name, "fill_factor");
  EXPECT_EQ(said[1].name, "stall_share");
  EXPECT_EQ(said[2].name, "noise_of_production");
}

TEST_F(LoadingHeadlines, TellThatTheMaterialsNeedTheirSolver) {
  const auto note = [&](const char* materials, const char* solver) {
    OptionValues options = {{"materials", materials}, {"solver", solver}};
    for (const StudyOption& option : loading_options()) options.try_emplace(option.name, option.value);
    return told({log_of({cycle(0, 4e3, 0, StageEnd::goal)})}, options).at("fill_factor").note;
  };
  const std::string remedy = "with --solver lindmark2016 too";
  EXPECT_NE(note("lindmark2016", "scene").find(remedy), std::string::npos);
  EXPECT_EQ(note("lindmark2016", "lindmark2016").find(remedy), std::string::npos);
  EXPECT_EQ(note("calibrated", "scene").find(remedy), std::string::npos);
}

TEST_F(LoadingHeadlines, NoRunsNoHeadlines) { EXPECT_TRUE(told({}).empty()); }

}  // namespace
