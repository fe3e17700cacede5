// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>
#include <drawpoint/engine/loading/pile_shape.hpp>

#include "command.hpp"
#include "step_times.hpp"

/// Heaps up piles in the drift of the default scenario: what that costs and how they lie. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using namespace drawpoint::engine::loading;

namespace {

constexpr const char* about =
    "Heaps up the pile of the loading study, one per seed, lets it settle, and prints what the steps cost "
    "and how\n"
    "the pile lies: mass, crest and the angle of its surface over the rows that the bucket can attack.\n\n"
    "  pile_settling                          the study's pile\n"
    "  pile_settling --seeds 6 --rolling 0.5  six piles of another rolling resistance";

int run(const Scenario& scenario, int seeds) {
  for (int seed = 1; seed <= seeds; ++seed) {
    Scenario of = scenario;
    of.pile.seed = static_cast<std::uint64_t>(seed);
    StepTimes times;
    const SettledPile pile = pour_pile(of, {}, [&](const auto& report) { times.add(report); });
    times.print("pile settling", pile.poured_s);
    const PileShape shape = pile_shape(pile, of);
    std::printf(
        "  seed %d: %zu rocks, %.1f t, %s; crest %.2f m, toe at %.2f m, surface at %.1f deg (rows %.1f to "
        "%.1f)\n",
        seed, pile.rocks.size(), shape.mass / 1e3,
        pile.timed_out ? "still creeping at the rest criterion's cap" : "at rest", shape.surface.crest,
        shape.surface.toe, shape.surface.mean * 180 / M_PI, shape.surface.least * 180 / M_PI,
        shape.surface.most * 180 / M_PI);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Scenario scenario = lh621_in_a_drift();
  double mass = scenario.pile.mass / 1e3;
  int seeds = 1;
  MaterialFlags materials{scenario.materials.rock_rock.rolling, scenario.materials.rock_rock.spinning};
  CLI::App app(about, "pile_settling");
  app.add_option("--mass", mass, "of the pile [t]")
      ->check(between(10, 1e4, "t", "120 is the study's"))
      ->capture_default_str();
  app.add_option("--seeds", seeds, "number of piles, seeds 1, 2, ...")
      ->check(between(1, 1000, "", "6 and more show the scatter"))
      ->capture_default_str();
  add_material_flags(app, materials);
  return run_command(app, argc, argv, [&] {
    scenario.pile.mass = 1e3 * mass;
    scenario.materials = with_resistance(scenario.materials, materials.rolling, materials.spinning);
    return run(scenario, seeds);
  });
}
