// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/loading/loading_figures.h>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <drawpoint/tests/fuzz/hdf5_edits.hpp>
#include <drawpoint/tests/fuzz/own_folder.hpp>
#include <drawpoint/tests/support/contact_problems.hpp>

#include <cmath>

namespace drawpoint::fuzz {
namespace {

using engine::loading::LoadingLog;

/// Two cycles of ten samples, and a scene of two bodies, one of them a rock.
LoadingLog small_log() {
  LoadingLog log;
  log.completed = true;
  log.texts["arm_drive"] = "cylinders";
  for (const char* name : {"time", "cycle", "stage", "tip_x", "tip_y", "tip_z", "lift_force", "tilt_force",
                           "wheel_torque", "hinge_G_torque_x", "hinge_G_torque_y", "hinge_G_torque_z"})
    log.signals.columns.push_back({name, "1"});
  for (int i = 0; i < 20; ++i)
    log.signals.append_row(std::vector<double>{0.5 * i, 1.0 + i / 10, 1.0 + i % 10 / 3, 0.01 * i, 0.0, 0.0,
                                               1e3, 2e3, 3.0, 1e4 * i, 2e4, -1e4});
  for (int number = 1; number <= 2; ++number) {
    engine::loading::CycleRecord cycle;
    cycle.number = number;
    cycle.t_start = 5.0 * (number - 1);
    cycle.t_end = 5.0 * number;
    cycle.loaded_mass = 3000;
    cycle.loaded_rock_masses = {1000, 2000};
    cycle.planned_x = {0, 1, 2};
    cycle.planned_z = {0, 0.5, 1};
    cycle.contour_x = {0, 1};
    cycle.contour_z = {1, 0};
    cycle.columns_x = 2;
    cycle.columns_y = 1;
    cycle.column_heights = {1, 0.5};
    cycle.stages.resize(1);
    log.cycles.push_back(cycle);
  }
  return log;
}

const std::filesystem::path& sound_log() {
  static const OwnFolder folder;
  static const std::filesystem::path file = folder / "log.h5";
  if (!std::filesystem::exists(file)) write_log(file, small_log());
  return file;
}

const std::filesystem::path& sound_problem() {
  static const OwnFolder folder;
  static const std::filesystem::path file = folder / "problem.h5";
  if (!std::filesystem::exists(file)) {
    const support::PushedStack stack;
    engine::record::write_contact_problem(file, stack.problem, "fuzz");
  }
  return file;
}

}  // namespace

void read_run_log(Bytes bytes) {
  static const OwnFolder folder;
  const std::filesystem::path file = folder / "edited.h5";
  write_edited(sound_log(), file, bytes, true);
  taken_or_refused([&] { studies::loading_figures(file); });
  taken_or_refused([&] { studies::loading_replay(file); });
}

void read_contact_problem(Bytes bytes) {
  static const OwnFolder folder;
  const std::filesystem::path file = folder / "edited.h5";
  write_edited(sound_problem(), file, bytes, true);
  taken_or_refused([&] {
    const engine::record::RecordedProblem read = engine::record::read_contact_problem(file);
    for (const engine::ContactPair& pair : read.problem.pairs)
      if (pair.first < 0 || pair.count < 0 ||
          static_cast<std::size_t>(pair.first) + static_cast<std::size_t>(pair.count) >
              read.problem.points.size())
        __builtin_trap();
  });
}

}  // namespace drawpoint::fuzz
