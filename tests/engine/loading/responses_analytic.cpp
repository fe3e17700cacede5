// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The responses on hand-made logs whose values are known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <numbers>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

constexpr double h = 0.01;

CycleRecord cycle(double t_start, double t_end, double loaded) {
  CycleRecord record;
  record.t_start = t_start;
  record.t_end = t_end;
  record.loaded_mass = loaded;
  return record;
}

/// Numbers the cycles and gives each pictures in which the bucket fills, loses so much [kg], and ends with 2 t.
void lose(LoadingLog& log, const std::vector<double>& lost) {
  log.scene.frames.clear();
  for (std::size_t k = 0; k < log.cycles.size(); ++k) {
    const int number = log.cycles[k].number = static_cast<int>(k) + 1;
    for (const double mass : {0.0, 2000 + lost[k] / 2, 2000 + lost[k], 2000.0})
      log.scene.frames.push_back({.t = 0, .cycle = number, .label = "", .bucket_mass = mass});
  }
}

record::Table empty_signals() {
  record::Table table;
  table.columns = {{"time", "s"},
                   {"cycle", "1"},
                   {"hinge_G_torque_x", "N m"},
                   {"hinge_G_torque_y", "N m"},
                   {"hinge_G_torque_z", "N m"}};
  return table;
}

// One cycle of 1 s with a constant torque.
LoadingLog constant_torque(double x, double y, double z) {
  LoadingLog log;
  log.signals = empty_signals();
  for (int k = 1; k <= 100; ++k) log.signals.append_row(std::vector<double>{k * h, 1, x, y, z});
  log.cycles = {cycle(0, 1, 0)};
  return log;
}

/// Two cycles of 1 s, with an excess of one yield torque and of two.
LoadingLog log_of_two_torques() {
  LoadingLog log;
  log.signals = empty_signals();
  for (int c = 1; c <= 2; ++c)
    for (int k = 1; k <= 100; ++k)
      log.signals.append_row(std::vector<double>{10.0 * c + k * h, 1.0 * c, 0, 0, (1.0 + c) * 145e3});
  log.cycles = {cycle(10, 11, 100), cycle(20, 21, 300)};
  lose(log, {1000, 4000});
  return log;
}

DamageOptions unfiltered(double tau_y = 145e3) { return {.tau_y = tau_y, .lowpass_hz = 0}; }

template <class F>
std::string thrown_by(F&& f) {
  try {
    f();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Production, MeanOfRatiosAndRatioOfSums) {
  LoadingLog log;
  log.cycles = {cycle(0, 20, 8000), cycle(30, 40, 2000)};
  EXPECT_DOUBLE_EQ(production(log), (400.0 + 200.0) / 2);
  EXPECT_DOUBLE_EQ(production(log, {.mean = ProductionMean::ratio_of_sums}), 10000.0 / 30.0);
}

// 8 t in 20 s beat 3 t in 10 s by a third; with 40 s of haul per cycle, 133 to 60 kg/s, by more than twice.
TEST(Production, AHaulMakesLargeLoadsCount) {
  LoadingLog log;
  log.cycles = {cycle(0, 20, 8000), cycle(30, 40, 3000)};
  EXPECT_EQ(production_by_cycle(log, {.haul = 40}), (std::vector<double>{8000.0 / 60, 60}));
  EXPECT_DOUBLE_EQ(production(log, {.haul = 40}), (8000.0 / 60 + 60) / 2);
  EXPECT_DOUBLE_EQ(production(log, {.mean = ProductionMean::ratio_of_sums, .haul = 40}), 11000.0 / 110);
  EXPECT_THROW(production(log, {.haul = -1}), std::invalid_argument);
}

TEST(RockSpill, MeanOverCycles) {
  LoadingLog log;
  log.cycles = {cycle(0, 20, 0), cycle(30, 40, 0)};
  lose(log, {1500, 2500});
  EXPECT_EQ(lost_mass_by_cycle(log), (std::vector<double>{1500, 2500}));
  EXPECT_DOUBLE_EQ(rock_spill(log), 0.2);
  EXPECT_DOUBLE_EQ(rock_spill(log, {.m_max = 1000}), 2.0);
}

// Time that was not simulated counts as the other does.
TEST(Production, CountsWhatWasLeftOut) {
  LoadingLog log;
  log.cycles = {cycle(0, 6, 8000)};
  log.cycles[0].left_out_time = 4;
  EXPECT_DOUBLE_EQ(production(log), 800);
}

// |T| = 145 kNm * 5/3 for 1 s: excess 2/3 of τ_y. 100 summands of a few units in the last place.
TEST(JointDamage, ConstantTorque) {
  const LoadingLog log = constant_torque(145e3, 0, 145e3 * 4 / 3);
  EXPECT_NEAR(joint_damage(log, unfiltered()), 2.0 / 3, 1e-13);
  EXPECT_NEAR(joint_damage(log), 2.0 / 3, 1e-13);  // a filter leaves a constant alone
  EXPECT_EQ(joint_damage(constant_torque(100e3, 0, 100e3), unfiltered()), 0);
}

TEST(JointDamage, TwistingLeavesThePinAxisOut) {
  const LoadingLog log = constant_torque(0, 580e3, 290e3);
  DamageOptions options = unfiltered();
  options.component = TorqueComponent::twisting;
  EXPECT_NEAR(joint_damage(log, options), 1.0, 1e-13);
  options.component = TorqueComponent::all;
  EXPECT_NEAR(joint_damage(log, options), std::sqrt(20.0) - 1, 1e-13);
}

// A ramp T = 2 τ k/n over n samples: Σ max(2k/n - 1, 0) = m (m + 1) / n over the m = n/2 upper samples.
TEST(JointDamage, ARampCountsOnlyAboveTheYieldTorque) {
  LoadingLog log = constant_torque(0, 0, 0);
  for (std::size_t k = 0; k < 100; ++k)
    log.signals.values[k * 5 + 4] = -2 * 145e3 * static_cast<double>(k + 1) / 100;
  EXPECT_NEAR(joint_damage(log, unfiltered()), h * 50 * 51 / 100, 1e-13);
}

// A step from 0 to T after the first sample. Filtered: T (1 - q^k), q = exp(-2π f h); with the yield torque
// T/2 the excess over it sums to h/τ Σ max(T/2 - T q^k, 0) = h Σ max(1 - 2 q^k, 0).
TEST(JointDamage, LowPassOfAStep) {
  LoadingLog log = constant_torque(0, 0, 200e3);
  log.signals.values[4] = 0;
  const double f = 2, q = std::exp(-2 * std::numbers::pi * f * h);
  double expected = 0;
  for (int k = 1; k < 100; ++k) expected += h * std::max(1 - 2 * std::pow(q, k), 0.0);
  EXPECT_NEAR(joint_damage(log, {.tau_y = 100e3, .lowpass_hz = f}), expected, 1e-12);
  EXPECT_NEAR(joint_damage(log, unfiltered(100e3)), 99 * h, 1e-12);
}

// A spike of one sample: its damage unfiltered does not shrink with the step if the peak grows as 1/Δt, but
// is filtered away.
TEST(JointDamage, LowPassRemovesASpike) {
  LoadingLog log = constant_torque(0, 0, 0);
  log.signals.values[50 * 5 + 4] = 1e6;
  EXPECT_NEAR(joint_damage(log, unfiltered()), h * (1e6 - 145e3) / 145e3, 1e-13);
  EXPECT_EQ(joint_damage(log, {.lowpass_hz = 2}), 0);  // peak 1e6 (1 - q) = 118 kNm
}

// What happens between cycles, such as putting the machine back, is not the strategy's doing.
TEST(JointDamage, OnlyCyclesCount) {
  LoadingLog log;
  log.signals = empty_signals();
  for (int k = 1; k <= 100; ++k) log.signals.append_row(std::vector<double>{k * h, 1, 0, 0, 290e3});
  for (int k = 101; k <= 200; ++k) log.signals.append_row(std::vector<double>{k * h, 1, 0, 0, 9e6});
  for (int k = 301; k <= 350; ++k) log.signals.append_row(std::vector<double>{k * h, 2, 0, 0, 290e3});
  log.cycles = {cycle(0, 100 * h, 0), cycle(300 * h, 350 * h, 0)};
  EXPECT_NEAR(joint_damage(log, unfiltered()), 1.5,
              1e-13);  // and the gap of 1 s before the second is no sample
  DamageOptions options = unfiltered();
  options.sum = DamageSum::per_cycle;
  EXPECT_NEAR(joint_damage(log, options), 0.75, 1e-13);
  log.numbers["lost_cycles"] = 1;  // of three: the lost one counts with the mean of the others
  EXPECT_NEAR(joint_damage(log, options), 0.75, 1e-13);
  EXPECT_NEAR(joint_damage(log, unfiltered()), 3 * 0.75, 1e-13);
  log.numbers["left_out_cycles"] = 4;  // and so do those that were not needed
  EXPECT_NEAR(joint_damage(log, options), 0.75, 1e-13);
  EXPECT_NEAR(joint_damage(log, unfiltered()), 7 * 0.75, 1e-13);
}

// Rates 400, 500, 600 and 700 kg/s: deviations of 50 and 150 about 550, so s² = 50 000/3 and the error of the
// mean √(50 000/3/4)/550.
TEST(Production, KnowsItsErrorByTheScatterOfTheCycles) {
  LoadingLog log;
  for (const double rate : {400, 500, 600, 700}) log.cycles.push_back(cycle(0, 10, 10 * rate));
  EXPECT_NEAR(relative_production_error(log), std::sqrt(50e3 / 12) / 550, 1e-15);
  EXPECT_NEAR(relative_production_error(log, {.haul = 10}), std::sqrt(50e3 / 12) / 550, 1e-15)
      << "of cycles that take the same time, a haul halves rate and scatter";
  log.cycles.resize(1);
  EXPECT_EQ(relative_production_error(log), std::numeric_limits<double>::infinity());
  log.cycles = {cycle(0, 10, 0), cycle(20, 30, 0)};
  EXPECT_EQ(relative_production_error(log), std::numeric_limits<double>::infinity()) << "empty buckets";
}

// Rates 400, 500, 600 and 700 kg/s: the first cycle meets a fresh pile and tells nothing, the others have a variance of
// 100², so that the mean of four has 100²/4. Of damages of 1 and 2 s the error of the mean is 0.5 and that of the run,
// which is their sum, twice that. Four cycles that were lost count with the mean of the others, so the sum of six has
// thrice that of two.
TEST(StandardErrors, AreTheScatterOfTheCycles) {
  LoadingLog log;
  for (const double rate : {400, 500, 600, 700}) log.cycles.push_back(cycle(0, 10, 10 * rate));
  lose(log, {400, 500, 600, 700});
  EXPECT_NEAR(production_standard_error(log), 50, 1e-12);
  EXPECT_NEAR(rock_spill_standard_error(log), 50 / 1e4, 1e-16);
  log.cycles.pop_back();  // of 500 and 600 the mean of three has 100²/2 · 1/2 · 2/3
  EXPECT_NEAR(production_standard_error(log), 100 / std::sqrt(6.0), 1e-12);
  log.cycles.pop_back();  // and two are all that there is
  EXPECT_NEAR(production_standard_error(log), 50, 1e-12);

  LoadingLog damaged = log_of_two_torques();
  EXPECT_NEAR(joint_damage_standard_error(damaged, unfiltered()), 1.0, 1e-12);
  damaged.numbers["lost_cycles"] = 4;
  EXPECT_NEAR(joint_damage_standard_error(damaged, unfiltered()), 3.0, 1e-12);
  DamageOptions per_cycle = unfiltered();
  per_cycle.sum = DamageSum::per_cycle;
  EXPECT_NEAR(joint_damage_standard_error(damaged, per_cycle), 0.5, 1e-12);
}

TEST(StandardErrors, OfOneCycleAreNoneAndOfOneThatIsLeftAll) {
  LoadingLog log;
  log.cycles = {cycle(0, 10, 5000)};
  lose(log, {100});
  EXPECT_EQ(production_standard_error(log), 0);
  EXPECT_EQ(rock_spill_standard_error(log), 0);
  log.numbers["lost_cycles"] = 1;
  EXPECT_EQ(production_standard_error(log), 500);
  EXPECT_EQ(rock_spill_standard_error(log), 0.01);
  EXPECT_EQ(
      thrown_by([&] { production_standard_error(log, {.mean = ProductionMean::ratio_of_sums}); }),
      "loading::production_standard_error: of the ratio of sums it is not known; take the mean of ratios");
}

TEST(Responses, SayWhatIsMissing) {
  const LoadingLog nothing;
  EXPECT_NE(thrown_by([&] { production(nothing); }).find("the log has no cycle"), std::string::npos);
  EXPECT_NE(thrown_by([&] { rock_spill(nothing); }).find("the log has no cycle"), std::string::npos);
  LoadingLog log = constant_torque(0, 0, 0);
  log.signals.columns[3].name = "something";
  EXPECT_EQ(thrown_by([&] { joint_damage(log); }),
            "record::Table: no column \"hinge_G_torque_y\"; there are: time, cycle, hinge_G_torque_x, "
            "something, hinge_G_torque_z");
  log.cycles = {cycle(5, 5, 1000)};
  EXPECT_NE(thrown_by([&] { rock_spill(log); }).find("does not say what the bucket held in cycle 0"),
            std::string::npos);
  EXPECT_NE(thrown_by([&] { production(log); }).find("t_end"), std::string::npos);
  EXPECT_NE(thrown_by([&] { rock_spill(log, {.m_max = 0}); }).find("m_max"), std::string::npos);
  EXPECT_NE(thrown_by([&] { joint_damage(log, {.tau_y = -1}); }).find("tau_y"), std::string::npos);
}

CycleRecord driven_in(StageEnd end, double loaded) {
  CycleRecord record = cycle(0, 1, loaded);
  record.stages.resize(2);
  record.stages[0].stage = Stage::drive_in;
  record.stages[0].reason = end;
  record.stages[1].stage = Stage::lift;
  record.stages[1].reason = StageEnd::timeout;
  return record;
}

TEST(FillAndStalls, AreSharesOfPayloadAndCycles) {
  LoadingLog log;
  log.cycles = {driven_in(StageEnd::goal, 21e3), driven_in(StageEnd::slow_actuator, 0),
                driven_in(StageEnd::timeout, 10.5e3), driven_in(StageEnd::goal, 10.5e3)};
  EXPECT_EQ(thrown_by([&] { fill_factor(log); }),
            "loading::fill_factor: the log names no payload [kg] above 0; give the log of a simulated run");
  log.numbers["payload"] = 21e3;
  EXPECT_DOUBLE_EQ(fill_factor(log), 0.5);
  EXPECT_DOUBLE_EQ(stall_share(log), 0.5);  // a lift that is late is no stalled drive-in
}

// A run's responses are the means, and damage the sum, of what its cycles say.
TEST(ByCycle, AddsUpToTheRun) {
  const LoadingLog log = log_of_two_torques();
  EXPECT_EQ(production_by_cycle(log), (std::vector<double>{100, 300}));
  EXPECT_EQ(rock_spill_by_cycle(log), (std::vector<double>{0.1, 0.4}));
  const std::vector<double> damage = joint_damage_by_cycle(log, unfiltered());
  ASSERT_EQ(damage.size(), 2u);
  EXPECT_NEAR(damage[0], 1.0, 1e-12);  // excess of one yield torque for 1 s, then of two
  EXPECT_NEAR(damage[1], 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(joint_damage(log, unfiltered()), damage[0] + damage[1]);
}

}  // namespace
