// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstring>
#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <exception>

#include "step_times.hpp"

/// One loading cycle, with where its steps spend their time. The pile is poured once and kept in PILE_FILE.
/// usage: loading_cycle PILE_FILE [--lindmark2016-scale]
using namespace drawpoint;
using namespace drawpoint::engine::loading;

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: loading_cycle PILE_FILE [--lindmark2016-scale]\n");
    return 2;
  }
  const bool lindmark2016_scale = argc > 2 && std::strcmp(argv[2], "--lindmark2016-scale") == 0;
  Scenario scenario = lindmark2016_scale ? lh621_at_lindmark2016_scale() : lh621_in_a_drift();
  scenario.cycles = 1;
  scenario.strategy = {1.2, 0.8, 0.8, 0.2};
  scenario.pile_file = argv[1];
  prepared_pile(scenario);
  benchmarks::StepTimes times;
  const LoadingLog log = simulate(scenario, {[&](const auto& report) { times.add(report); }});
  if (!log.completed) {
    std::fprintf(stderr, "loading_cycle: %s\n", log.message.c_str());
    return 1;
  }
  const CycleRecord& cycle = log.cycles.front();
  times.print("loading cycle", cycle.t_end);
  std::printf(
      "  %.0f rocks; cycle %.1f s, loaded %.0f kg, production %.1f kg/s, damage %.2f s, spill %.3f\n"
      "  at most %.0f contact points, with up to %.0f iterations per substep while rocks move\n",
      log.numbers.at("rocks"), cycle.t_end - cycle.t_start, cycle.loaded_mass, production(log),
      joint_damage(log), rock_spill(log), log.numbers.at("most_contact_points"),
      log.numbers.at("most_iterations_per_substep"));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "loading_cycle: %s\n", error.what());
  return 1;
}
