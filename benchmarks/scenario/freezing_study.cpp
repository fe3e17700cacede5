// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <drawpoint/engine/loading/pile_store.hpp>

#include "accuracy_run.hpp"
#include "cycle_run.hpp"
#include "estimate.hpp"
#include "freezing_cost.hpp"
#include "loading_flags.hpp"
#include "setting.hpp"

/// What freezing changes: cost beside rocks that move, force on a blade, load of a bucket. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;

namespace {

constexpr const char* about =
    "Runs the same scenes with freezing on and off.\n\n"
    "  freezing_study --cost                  3000 rocks of which 300 move, against the 300 alone\n"
    "  freezing_study --blade --seeds 10      the blade of pile_scenario, pile by pile\n"
    "  freezing_study --cycle FOLDER --seeds 5  a loading cycle of the LHD on another pile per seed (poured "
    "and\n"
    "                                         kept in FOLDER when missing)\n\n"
    "Blade and cycle print the mean of on minus off over the seeds, relative to the mean of off, with its 95 "
    "%\n"
    "interval (Student's t on the paired differences). Rows \"replicate\": a second run without freezing "
    "that "
    "starts\n"
    "a micrometre off: what chaos alone does. A change is resolved only when its interval is narrower than "
    "the\n"
    "change that is asked about. Both sides are solved with as many iterations: with iteration budget, the "
    "fewer "
    "rocks\n"
    "that stay awake would be solved better than all of them, and feel stiffer for that alone. A setting is\n"
    "STEPxSUBSTEPSxITERATIONS with the step in milliseconds, and +BUDGET for iteration budget.";

struct Settings {
  bool cost = false, blade = false;
  std::string folder, setting = "10x1x100";
  MaterialFlags material;
  int rocks = 300, seeds = 5, repeats = 3;
};

struct Paired {
  std::vector<double> off, on, replicate;
};

void print_change(const char* what, const std::vector<double>& changed, const std::vector<double>& off) {
  const double scale = std::abs(mean_of(off));
  const Estimate d = paired_difference(changed, off);
  std::printf("%-28s %9.4g off, change %+.2f %% +- %.2f %%\n", what, mean_of(off), 100 * d.mean / scale,
              100 * d.half_width / scale);
}

void print_change(const std::string& what, const Paired& p) {
  print_change(what.c_str(), p.on, p.off);
  if (!p.replicate.empty()) print_change((what + ", replicate").c_str(), p.replicate, p.off);
}

// Least of the repeats.
FreezingCost least_cost(CostScene scene, const Settings& s) {
  scene.material = s.material.pile();
  FreezingCost least;
  for (int k = 0; k < s.repeats; ++k) {
    const FreezingCost cost = freezing_cost(scene, {});
    if (k == 0) least = cost;
    least.fall_ms = std::min(least.fall_ms, cost.fall_ms);
    least.dig_ms = std::min(least.dig_ms, cost.dig_ms);
    least.still_ms = std::min(least.still_ms, cost.still_ms);
  }
  return least;
}

int study_cost(const Settings& s) {
  struct Row {
    const char* name;
    CostScene scene;
    FreezingCost cost;
  };
  std::vector<Row> rows{{"300 alone, all awake", {.bed = 0, .freeze = false}, {}},
                        {"300 alone", {.bed = 0}, {}},
                        {"300 beside 2700 frozen", {}, {}}};
  for (Row& row : rows) {
    row.cost = least_cost(row.scene, s);
    std::printf(
        "%-24s ms per step: fall %.3f (%.0f awake), dig %.3f (%.0f awake), before them %.4f; %d frozen, "
        "%d solved again\n",
        row.name, row.cost.fall_ms, row.cost.fall_awake, row.cost.dig_ms, row.cost.dig_awake,
        row.cost.still_ms, row.cost.frozen, row.cost.solved_again);
    std::fflush(stdout);
  }
  const FreezingCost& with = rows.back().cost;
  for (const Row& row : {rows[0], rows[1]})
    std::printf("ratio to %-24s fall %.2f, dig %.2f, both %.2f\n", row.name, with.fall_ms / row.cost.fall_ms,
                with.dig_ms / row.cost.dig_ms,
                (with.fall_ms + with.dig_ms) / (row.cost.fall_ms + row.cost.dig_ms));
  return 0;
}

int study_blade(const Settings& s) {
  Progress progress;
  const engine::WorldOptions off = with({}, setting_of(s.setting));
  engine::WorldOptions on = off;
  on.freezing.on = true;
  Paired drag, moved;
  for (int seed = 1; seed <= s.seeds; ++seed) {
    const SettledState start = settled(
        support::rock_pile(s.rocks, static_cast<std::uint64_t>(seed), s.material.pile()), {}, progress);
    const auto add = [&](std::vector<double> Paired::*which, const AccuracySample& sample) {
      (drag.*which).push_back(sample.drag);
      (moved.*which).push_back(sample.mass_moved);
    };
    add(&Paired::off, accuracy_sample(start, off, 0, progress));
    add(&Paired::on, accuracy_sample(start, on, 0, progress));
    add(&Paired::replicate, accuracy_sample(start, off, 1e-6, progress));
  }
  std::printf("blade through %d rocks, %d piles, %s, rolling resistance %g, spinning %g\n", s.rocks, s.seeds,
              s.setting.c_str(), s.material.rolling, s.material.spinning);
  print_change("drag on the blade [N]", drag);
  print_change("mass moved [kg]", moved);
  return 0;
}

int study_cycle(const Settings& s) {
  using namespace engine::loading;
  const Setting setting = setting_of(s.setting);
  Paired force, mass, ms;
  for (int seed = 1; seed <= s.seeds; ++seed) {
    Scenario scenario = with_pile(lh621_in_a_drift(), s.folder, seed);
    scenario.materials = with_resistance(scenario.materials, s.material.rolling, s.material.spinning);
    const SettledPile pile = prepared_pile(scenario);
    const auto run = [&](std::vector<double> Paired::*which, bool freeze, double offset) {
      Scenario chosen = scenario;
      chosen.world = with(scenario.world, setting);
      chosen.world.freezing.on = freeze;
      const CycleSample sample = cycle_run(chosen, displaced(pile, 1, offset));
      (force.*which).push_back(sample.bucket_force);
      (mass.*which).push_back(sample.loaded_mass);
      (ms.*which).push_back(sample.contact_ms);
      std::fprintf(stderr, "seed %d, freezing %s: %.1f kN, %.0f kg\n", seed, freeze ? "on" : "off",
                   sample.bucket_force / 1e3, sample.loaded_mass);
    };
    run(&Paired::off, false, 0);
    run(&Paired::on, true, 0);
    run(&Paired::replicate, false, 1e-6);
  }
  std::printf("loading cycle, %d piles, %s, rolling resistance %g, spinning %g\n", s.seeds, s.setting.c_str(),
              s.material.rolling, s.material.spinning);
  print_change("force in the bucket pin [N]", force);
  print_change("loaded mass [kg]", mass);
  print_change("time in contacts [ms]", ms);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "freezing_study");
  auto* what = app.add_option_group("what", "one of these");
  auto* cost = what->add_flag("--cost", s.cost, "time of rocks that stand beside rocks that move");
  what->add_flag("--blade", s.blade, "change of the force on a blade");
  what->add_option("--cycle", s.folder, "change of bucket force and loaded mass; where the piles are kept");
  what->require_option(1);
  app.add_option("--rocks", s.rocks, "of the blade's piles")
      ->check(between(1, 100'000, "", "200 to 500 are usual"))
      ->capture_default_str();
  app.add_option("--seeds", s.seeds, "pairs of runs")
      ->check(between(1, 10'000, "", "2 and more give intervals"))
      ->capture_default_str();
  app.add_option("--setting", s.setting, "step and work of blade and cycle")
      ->check(taken_by(setting_of))
      ->capture_default_str()
      ->excludes(cost);
  app.add_option("--repeats", s.repeats, "of the cost; the least counts")
      ->check(between(1, 100, "", "3 and more on a busy machine"))
      ->capture_default_str();
  add_material_flags(app, s.material);
  return run_command(app, argc, argv, [&] {
    if (s.cost) return study_cost(s);
    if (!s.blade) take_mine_materials(app, s.material);
    return s.blade ? study_blade(s) : study_cycle(s);
  });
}
