// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Noise of loading runs by the scatter of their cycles, whose loads are known.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/loading/loading_noise.h>

#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

/// Cycles of 10 s with these loads [kg], an idle hinge, and nothing lost.
engine::loading::LoadingLog log_of(const std::vector<double>& loads) {
  engine::loading::LoadingLog log;
  log.completed = true;
  for (const char* name : {"time", "cycle", "stage", "tip_x", "tip_y", "tip_z", "hinge_G_torque_x",
                           "hinge_G_torque_y", "hinge_G_torque_z"})
    log.signals.columns.push_back({name, "1"});
  for (std::size_t c = 0; c < loads.size(); ++c) {
    engine::loading::CycleRecord cycle;
    cycle.number = static_cast<int>(c) + 1;
    cycle.t_start = 10.0 * static_cast<double>(c);
    cycle.t_end = cycle.t_start + 10;
    cycle.loaded_mass = loads[c];
    log.cycles.push_back(cycle);
    for (int i = 0; i < 10; ++i)
      log.signals.append_row(
          std::vector<double>{cycle.t_start + i, 1.0 + static_cast<double>(c), 1, 0, 0, 0, 0, 0, 0});
    for (const double mass : {0.0, 2000.0})
      log.scene.frames.push_back(
          {.t = cycle.t_start, .cycle = cycle.number, .label = "", .bucket_mass = mass});
  }
  return log;
}

// Rates of the second cycle less those of the first are 100, 200 and 600 kg/s: mean 300, so that a cycle has a variance
// of (200² + 100² + 300²)/2 over 2 degrees, 35 000, and the mean of two has half of it. What no cycle scatters, damage
// and spill here, has no known noise: that is not noise of 0.
TEST(LoadingNoise, IsTheScatterOfCyclesAndUnknownWhereNoneScatters) {
  const test::TestFolder place;
  const std::vector<std::filesystem::path> logs = {place / "1.h5", place / "2.h5", "", place / "3.h5",
                                                   place / "4.h5"};
  write_log(logs[0], log_of({4000, 5000}));
  write_log(logs[1], log_of({4000, 6000}));
  write_log(logs[3], log_of({1000, 7000}));
  std::ofstream(logs[4]) << "no log";
  const auto noise = noise_of_logs(logs, {{"haul", "0"}});
  EXPECT_NEAR(noise[0].variance, 17500, 1e-8);
  EXPECT_EQ(noise[0].degrees, 2);
  EXPECT_LT((noise[0].weights - Eigen::VectorXd::Ones(5)).norm(), 1e-12);
  for (const KnownNoise& none : {noise[1], noise[2]}) {
    EXPECT_EQ(none.degrees, 0);
    EXPECT_EQ(none.weights.size(), 0);
  }
}

// A mean of four cycles has half the variance of one of two.
TEST(LoadingNoise, GoesWithTheCyclesOfARun) {
  const test::TestFolder place;
  const std::vector<std::filesystem::path> logs = {place / "1.h5", place / "2.h5"};
  write_log(logs[0], log_of({4000, 5000}));
  write_log(logs[1], log_of({4000, 6000, 5000, 4500}));
  const auto noise = noise_of_logs(logs, {{"haul", "0"}});
  EXPECT_NEAR(noise[0].weights[0], 2 * noise[0].weights[1], 1e-12);
  EXPECT_NEAR(noise[0].weights.mean(), 1, 1e-12);
}

}  // namespace
