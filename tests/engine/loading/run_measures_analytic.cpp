// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The measures of a run on hand-made logs whose values are known in closed form. Sums of 100 to 200 terms of
// order 1 are off by some 1e-14; 1e-12 leaves room.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/log/energy_balance.hpp>
#include <drawpoint/engine/loading/log/run_measures.hpp>
#include <drawpoint/tests/support/told.hpp>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

constexpr double h = 0.01, round_off = 1e-12;
constexpr const char* names[] = {"time",
                                 "cycle",
                                 "stage",
                                 "tip_x",
                                 "tip_z",
                                 "drive_set",
                                 "drive_speed",
                                 "lift_speed",
                                 "lift_force",
                                 "tilt_speed",
                                 "tilt_force",
                                 "wheel_torque",
                                 "hinge_G_force_x",
                                 "hinge_G_force_y",
                                 "hinge_G_force_z",
                                 "hinge_G_torque_x",
                                 "hinge_G_torque_y",
                                 "hinge_G_torque_z",
                                 "wheel_power",
                                 "wheel_speed",
                                 "bucket_force_x",
                                 "bucket_force_y",
                                 "bucket_force_z",
                                 "machine_energy",
                                 "rock_energy"};
using Row = std::map<std::string, double>;

// Two cycles of 1 s, from 0 and from 10 s, of 100 samples each; `of` gives the signals at a time within a
// cycle, those it leaves out are 0.
LoadingLog log_with(const std::function<Row(double t, int cycle)>& of) {
  LoadingLog log;
  log.numbers = {{"tyre_radius", 1.0}, {"density", 4500}, {"bucket_struck_volume", 6}, {"pin_spacing", 2}};
  for (const char* name : names) log.signals.columns.push_back({name, "1"});
  for (int c = 1; c <= 2; ++c) {
    CycleRecord cycle;
    cycle.number = c;
    cycle.t_start = 10 * (c - 1);
    cycle.t_end = cycle.t_start + 1;
    cycle.loaded_mass = 1000 * c;
    cycle.planned_x = {0, 1, 1, 0};  // in, up, and out again
    cycle.planned_z = {0, 0, 1, 1};
    log.cycles.push_back(cycle);
    for (int k = 1; k <= 100; ++k) {
      Row row = of(k * h, c);
      row["time"] = cycle.t_start + k * h;
      row["cycle"] = c;
      std::vector<double> values;
      for (const char* name : names) values.push_back(row[name]);
      log.signals.append_row(values);
    }
    log.cycles.back().t_end = log.signals.at(log.signals.rows() - 1, 0);
  }
  return log;
}

TEST(RunMeasures, CycleTimeAndSolidFill) {
  LoadingLog log = log_with([](double, int) { return Row{}; });
  EXPECT_DOUBLE_EQ(cycle_time(log), 1);
  EXPECT_DOUBLE_EQ(solid_fill_by_cycle(log)[1], 2000.0 / (4500 * 6));
  EXPECT_DOUBLE_EQ(solid_fill(log), 1500.0 / (4500 * 6));
  EXPECT_DOUBLE_EQ(struck_fill(log), 1500.0 / (4500 * 6) / 0.59);
  log.numbers["bucket_heaped_volume"] = 8;
  EXPECT_DOUBLE_EQ(heaped_fill(log), 1500.0 / (4500 * 8) / 0.59);
  log.cycles[0].left_out_time = log.cycles[1].left_out_time = 3;
  EXPECT_DOUBLE_EQ(cycle_time(log), 4) << "what was not simulated counts";
}

// Drive 30 kN m over a radius of 1 m at 1 m/s, lift 20 kN at 0.5 m/s: 40 kJ in the first cycle of 1 s. The
// second lowers the arm, which costs nothing, and tilts with 5 kN at 2 m/s: 30 + 10 kJ. 1 and 2 t.
TEST(RunMeasures, EnergyIsThePositiveWorkOfEachDrive) {
  LoadingLog log = log_with([](double, int cycle) {
    return Row{{"wheel_torque", 30e3}, {"drive_speed", 1},
               {"lift_force", 20e3},   {"lift_speed", cycle == 1 ? 0.5 : -0.5},
               {"tilt_force", -5e3},   {"tilt_speed", cycle == 1 ? 2.0 : -2.0}};
  });
  EXPECT_NEAR(energy_by_cycle(log)[0], 40, 40 * round_off);
  EXPECT_NEAR(energy_by_cycle(log)[1], 40, 40 * round_off);
  EXPECT_NEAR(energy_per_tonne_by_cycle(log)[1], 20, 20 * round_off);
  EXPECT_NEAR(energy_per_tonne(log), 80.0 / 3, 40 * round_off);
  log.numbers["tyre_radius"] = 0.5;
  EXPECT_NEAR(energy_by_cycle(log)[0], 70, 70 * round_off);
  log.cycles[0].loaded_mass = log.cycles[1].loaded_mass = 0;
  EXPECT_TRUE(std::isinf(energy_per_tonne(log)));
}

// 0.3 m above the first leg for half of the time, 0.4 m beyond the second for the rest: √((0.09 + 0.16) / 2).
// What the fourth stage does, and the leg on which it backs out, do not count.
TEST(RunMeasures, TrackingErrorIsTheDistanceFromThePath) {
  const LoadingLog log = log_with([](double t, int cycle) {
    if (cycle == 2)
      return t < 0.5 + h / 2 ? Row{{"stage", 2}, {"tip_z", 1}} : Row{{"stage", 4}, {"tip_z", 9}};
    if (t < 0.5 + h / 2) return Row{{"stage", 1}, {"tip_x", t}, {"tip_z", 0.3}};
    return Row{{"stage", 3}, {"tip_x", 1.4}, {"tip_z", 0.5}};
  });
  EXPECT_NEAR(tracking_error_by_cycle(log)[0], std::sqrt(0.125), round_off);
  EXPECT_NEAR(tracking_error_by_cycle(log)[1], 1, round_off);  // (0, 1) is on the last leg, 1 m from the rest
  EXPECT_NEAR(tracking_error(log), (1 + std::sqrt(0.125)) / 2, round_off);
}

// Half the set speed for half of the time, all of it for the rest; a set speed that is next to nothing, or
// backward, is left out.
TEST(RunMeasures, LagIsTheSetSpeedThatIsMissing) {
  const LoadingLog log = log_with([](double t, int cycle) {
    if (cycle == 2) return Row{{"drive_set", t < 0.5 ? 0.04 : -1.0}};
    return Row{{"drive_set", 2}, {"drive_speed", t < 0.5 + h / 2 ? 1.0 : 2.0}};
  });
  EXPECT_NEAR(drive_lag_by_cycle(log)[0], 0.25, round_off);
  EXPECT_EQ(drive_lag_by_cycle(log)[1], 0);
}

// Rims that run at 2 m/s on a machine at 1.5 slip by a quarter; wheels that are held up by the rock, at 0.5 m/s as the
// machine, or stand, do not, however much the set speed is missed.
TEST(RunMeasures, SlipIsTheRimsSpeedThatIsMissing) {
  const LoadingLog log = log_with([](double t, int cycle) {
    const bool first = t < 0.5 + h / 2;
    if (cycle == 2)
      return Row{{"drive_set", 2}, {"wheel_speed", first ? 0.0 : 0.5}, {"drive_speed", first ? 0.0 : 0.5}};
    return Row{{"drive_set", 2}, {"wheel_speed", 2}, {"drive_speed", first ? 1.5 : 2.0}};
  });
  EXPECT_NEAR(wheel_slip_by_cycle(log)[0], 0.125, round_off);
  EXPECT_EQ(wheel_slip_by_cycle(log)[1], 0);
  EXPECT_NEAR(wheel_slip(log), 0.0625, round_off);
  EXPECT_NEAR(drive_lag(log), (0.125 + 0.875) / 2, round_off);
}

// The largest of 13 = √(3² + 4² + 12²) kN and of 5 kN before it.
TEST(RunMeasures, BucketForceIsItsMagnitude) {
  const LoadingLog log = log_with([](double t, int) {
    if (t < 0.5) return Row{{"bucket_force_y", -5e3}};
    return Row{{"bucket_force_x", -3e3}, {"bucket_force_y", 4e3}, {"bucket_force_z", -12e3}};
  });
  EXPECT_NEAR(peak_bucket_force_by_cycle(log, 0)[0], 13, 13 * round_off);
  EXPECT_NEAR(peak_bucket_force(log, 0), 13, 13 * round_off);
}

// Of a step from 0 to (30, 0, 40) kN after the first sample: 50 (1 − qⁿ) after n = 99 samples, q = exp(−2π f h).
TEST(RunMeasures, PinForceIsLowPassed) {
  const LoadingLog log = log_with([](double t, int) {
    return t < 1.5 * h ? Row{} : Row{{"hinge_G_force_x", 30e3}, {"hinge_G_force_z", -40e3}};
  });
  EXPECT_NEAR(peak_pin_force(log, 0), 50, 50 * round_off);
  EXPECT_NEAR(peak_pin_force(log, 0.5), 50 * (1 - std::exp(-2 * std::numbers::pi * 0.5 * 99 * h)),
              50 * round_off);
  EXPECT_NEAR(peak_pin_force_by_cycle(log)[1], 50, 50 * round_off);  // the default forgets within the cycle
}

TEST(RunMeasures, SayWhatIsMissing) {
  LoadingLog log = log_with([](double, int) { return Row{}; });
  log.numbers.erase("tyre_radius");
  support::expect_told<std::invalid_argument>([&] { energy_per_tonne(log); }, {"tyre_radius [m]"});
  log.numbers.erase("bucket_struck_volume");
  support::expect_told<std::invalid_argument>([&] { solid_fill(log); }, {"bucket_struck_volume [m3]"});
  log.cycles[1].planned_x.clear();
  support::expect_told<std::invalid_argument>([&] { tracking_error(log); }, {"planned path"});
  support::expect_told<std::invalid_argument>([&] { peak_pin_force(log, -1); }, {"lowpass_hz [Hz] is -1"});
  log.signals.columns[5].name = "something";
  support::expect_told<std::invalid_argument>([&] { drive_lag(log); }, {"no column \"drive_set\""});
  log.signals.columns[19].name = "other";
  support::expect_told<std::invalid_argument>([&] { wheel_slip(log); }, {"no column \"wheel_speed\""});
  support::expect_told<std::invalid_argument>([] { cycle_time(LoadingLog()); }, {"the log has no cycle"});
}

// One load of 60 kN down and off again is a range of 30 kN in each of two pins; twice in a cycle is 2^(1/m) of it.
// A torque of 20 kN m about the long axis, over 2 m, adds 10 kN in one pin and takes it from the other.
TEST(RunMeasures, PinLoadRangeOfKnownHistories) {
  const PinFatigueOptions raw{.exponent = 3, .lowpass_hz = 0};
  const auto on_and_off = [](double t, int times) {
    for (int k = 1; k <= times; ++k)
      if (std::abs(t - 0.3 * k) < 0.05) return true;
    return false;
  };
  const LoadingLog once = log_with([&](double t, int) {
    return Row{{"hinge_G_force_z", on_and_off(t, 1) ? -60e3 : 0.0}};
  });
  EXPECT_NEAR(pin_load_range(once, raw), 30, 30 * round_off);
  const LoadingLog twice = log_with([&](double t, int) {
    return Row{{"hinge_G_force_x", on_and_off(t, 2) ? 60e3 : 0.0}};
  });
  EXPECT_NEAR(pin_load_range(twice, raw), 30 * std::cbrt(2.0), 40 * round_off);
  EXPECT_NEAR(pin_load_range(twice, {.exponent = 5, .lowpass_hz = 0}), 30 * std::pow(2, 0.2), 40 * round_off);
  const LoadingLog twisted = log_with([&](double t, int cycle) {
    const double on = on_and_off(t, 1) && cycle == 1 ? 1 : 0;
    return Row{{"hinge_G_force_z", -60e3 * on}, {"hinge_G_torque_x", 20e3 * on}};
  });
  EXPECT_NEAR(pin_load_range(twisted, raw), 40 / std::cbrt(2.0), 40 * round_off);  // in one cycle of two
}

// Forces F at the pins (0, ±1 m, 0): their sum is the force, Σ y F_z the torque about x, −Σ y F_x that about z. With
// 60 kN and 20 kN m in both they carry (x, z) = (20, 40) and (40, 20) kN; a wrong sign would make that 40, 40.
// Directions 15° apart find all but 1 − cos 7.5° of it.
TEST(RunMeasures, PinsShareForceAndTorqueAsSupportsDo) {
  const LoadingLog log = log_with([&](double t, int) {
    const double on = std::abs(t - 0.5) < 0.1 ? 1 : 0;
    return Row{{"hinge_G_force_x", 60e3 * on},
               {"hinge_G_force_z", 60e3 * on},
               {"hinge_G_torque_x", 20e3 * on},
               {"hinge_G_torque_z", 20e3 * on}};
  });
  const double range = pin_load_range(log, {.exponent = 3, .lowpass_hz = 0}), most = std::hypot(20, 40);
  EXPECT_LE(range, most * (1 + round_off));
  EXPECT_GE(range, most * std::cos(7.5 * std::numbers::pi / 180));
}

// A swing along any direction, ±25 kN per pin: over two cycles of one period half a range of 25 kN, one and a half of
// 50 and half a range of 25. Samples begin at 6 % of the amplitude, which takes 0.3 % off the cube root.
TEST(RunMeasures, PinLoadRangeSeesEveryDirection) {
  const double expected = std::cbrt((0.5 * 25 * 25 * 25 * 2 + 1.5 * 50 * 50 * 50) / 2);
  for (const double degrees : {0.0, 7.5, 33.0, 90.0, 171.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const LoadingLog log = log_with([&](double t, int) {
      const double swing = 50e3 * std::sin(2 * std::numbers::pi * t);
      return Row{{"hinge_G_force_x", swing * std::cos(angle)}, {"hinge_G_force_z", swing * std::sin(angle)}};
    });
    const double range = pin_load_range(log, {.exponent = 3, .lowpass_hz = 0});
    EXPECT_GT(range, expected * std::cos(7.5 * std::numbers::pi / 180) * 0.997) << degrees;
    EXPECT_LT(range, expected * (1 + round_off)) << degrees;
  }
}

TEST(RunMeasures, PinLoadRangeNamesWhatItLacks) {
  LoadingLog log = log_with([](double, int) { return Row{}; });
  EXPECT_EQ(pin_load_range(log), 0);
  EXPECT_THROW(pin_load_range(log, {.exponent = 0.5}), std::invalid_argument);
  EXPECT_THROW(pin_load_range(log, {.lowpass_hz = -1}), std::invalid_argument);
  log.numbers.erase("pin_spacing");
  EXPECT_THROW(pin_load_range(log), std::invalid_argument);
}

// 10 kW of the wheels, 2 kN at 1.5 m/s of the lift and 1 kN at -1 m/s of the tilt, which holds back: 12 kW over the 99
// steps after the first sample. The machine gains 3 kJ/s, the rock 5 kJ/s.
TEST(EnergyBalance, IsWorkLessWhatMachineAndRockGain) {
  LoadingLog log = log_with([](double t, int) {
    return Row{{"lift_force", 2e3},     {"lift_speed", 1.5},   {"tilt_force", 1e3},
               {"tilt_speed", -1},      {"wheel_power", 10e3}, {"machine_energy", 600e3 + 3e3 * t},
               {"rock_energy", 5e3 * t}};
  });
  for (const EnergyBalance& end : energy_balance_by_cycle(log)) {
    EXPECT_NEAR(end.work, 12 * 0.99, 12 * round_off);
    EXPECT_NEAR(end.machine, 3 * 0.99, 600 * round_off);
    EXPECT_NEAR(end.rock, 5 * 0.99, 5 * round_off);
    EXPECT_NEAR(end.dissipated, 4 * 0.99, 600 * round_off);
  }
  EXPECT_EQ(energy_balances(log).at(1).size(), 100u);
  log.signals.columns.pop_back();
  EXPECT_THROW(energy_balances(log), std::exception);
}

}  // namespace
