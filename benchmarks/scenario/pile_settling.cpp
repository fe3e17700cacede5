// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>
#include <drawpoint/engine/loading/drift.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <exception>

#include "step_times.hpp"

/// Pours a pile of MASS tonnes (default 80) into the drift of the default scenario and lets it settle.
/// usage: pile_settling [MASS_t]
using namespace drawpoint;
using namespace drawpoint::engine::loading;

int main(int argc, char** argv) try {
  Scenario scenario = lh621_in_a_drift();
  if (argc > 1) scenario.pile.mass = 1e3 * std::atof(argv[1]);
  benchmarks::StepTimes times;
  const SettledPile pile = pour_pile(scenario, {}, [&](const auto& report) { times.add(report); });
  times.print("pile settling", pile.poured_s);
  std::printf("  %zu rocks, %s\n", pile.rocks.size(),
              pile.timed_out ? "still creeping at the rest criterion's cap" : "at rest");
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "pile_settling: %s\n", error.what());
  return 1;
}
