// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <optional>

#include "pile_run.hpp"

/// The pile of tests/support/rock_pile.hpp: how long a step takes at rest and while a blade digs, and how
/// true the pile is. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using support::RockPile;

namespace {

struct Settings {
  EngineFlags engine;
  MaterialFlags material;
  int rocks = 500;
  std::uint64_t seed = 1;
  std::optional<int> settle, steps, dig;
  bool json = false;
};

constexpr const char* about =
    "Drops rocks into a box of 7 m x 6 m, lets them settle, times the pile at rest, then drags a blade 3 m "
    "wide\n"
    "through it at 1.5 m/s. Prints milliseconds per step and how true the pile is.\n\n"
    "  pile_scenario                                 500 rocks, the engine's defaults\n"
    "  pile_scenario --rocks 3000 --dt 0.01 --json   the scene on which engines are compared, for a "
    "script\n"
    "  pile_scenario --rolling 0                     friction alone, as the engines that it is compared "
    "with\n\n"
    "Fields of --json:\n"
    "  ms_rest      median wall time of a step at rest; ms_dig: mean while the blade moves. Parts: means.\n"
    "  contacts     contact points in the last step at rest; manifolds: pairs with such points; dig_*: in "
    "the\n"
    "               last step of digging\n"
    "  computed     pairs whose contact was computed anew, refused: of these, answers of FCL that were "
    "wrong\n"
    "               (--narrow), over the rest phase; dig_*: while digging\n"
    "  complementarity, cone   the solver's largest residual at rest, relative to the normal load\n"
    "  overlap_*    of rock pairs that touch (deeper than 10 um), after the rest phase: penetration depth by "
    "the "
    "separating-axis\n"
    "               theorem on the true hulls, over the longest dimension of the smaller rock;\n"
    "               wall_overlap_max: of a rock in floor or wall; dig_*: the same at the end of digging\n"
    "  drift_mm_s   distance between a rock's centres before and after the rest phase over its time\n"
    "               (drift_window_s), mean over rocks; drift_median_mm_s, drift_p99_mm_s,\n"
    "               drift_worst_mm_s: of the median rock, of the fastest of 99 % and of the fastest\n"
    "               (a median far below the mean: few rocks move)\n"
    "  kinetic_energy_per_rock_j, mean_height_m (of the rocks' centres)   at the end of the rest phase\n"
    "  blade_drag_n mean over the last 0.6 s of digging; with 3000 rocks some MN: the blade yields to "
    "nothing "
    "and\n"
    "               presses the heap, which friction holds to it, against the far wall and the floor\n"
    "  hash         of the bits of all poses and velocities at the end: equal for equal runs, whatever the\n"
    "               number of threads";

nlohmann::json overlaps(const std::string& prefix, const support::OverlapStatistics& s) {
  return {{prefix + "overlap_max", s.max},
          {prefix + "overlap_p99", s.p99},
          {prefix + "overlap_mean", s.mean},
          {prefix + "touching_pairs", s.pairs}};
}

void measure_rest(nlohmann::json& out, const support::PileWorld& world,
                  const std::vector<support::RockState>& before, double seconds) {
  const auto states = world.states();
  const support::Drift drift = support::drift(before, states, seconds);
  out.update(overlaps("", support::rock_overlaps(world.pile(), states)));
  out["wall_overlap_max"] = support::wall_overlaps(world.pile(), states).max;
  out["drift_mm_s"] = 1e3 * drift.mean;
  out["drift_median_mm_s"] = 1e3 * drift.median;
  out["drift_p99_mm_s"] = 1e3 * drift.p99;
  out["drift_worst_mm_s"] = 1e3 * drift.worst;
  out["drift_window_s"] = seconds;
  out["kinetic_energy_per_rock_j"] = support::kinetic_energy_per_rock(world.pile(), states);
  out["mean_height_m"] = support::mean_height(states);
}

void measure_dig(nlohmann::json& out, support::PileWorld& world, int steps, Progress& progress) {
  const int last = std::min(steps, steps_in(0.6, world.world().options().step));
  double drag = 0;
  int step = 0;
  world.dig();
  const PhaseTimes times = run_phase(world, "dig", steps, progress, [&](const auto&) {
    if (++step > steps - last) drag -= world.blade().contact_wrench().force.x() / last;
  });
  const auto states = world.states();
  const support::Vector3d blade = world.blade().part_pose(0).translation();
  out["ms_dig"] = times.mean();
  out["ms_dig_parts"] = times.parts();
  out["dig_contacts"] = times.points;
  out["dig_computed"] = times.computed;
  out["dig_refused"] = times.refused;
  out["blade_drag_n"] = drag;
  out.update(overlaps("dig_", support::rock_overlaps(world.pile(), states)));
  out["dig_blade_overlap_max"] = support::blade_overlaps(world.pile(), states, blade).max;
}

nlohmann::json run(const Settings& s) {
  const auto options = world_options(s.engine);
  const int settle = s.settle.value_or(steps_in(RockPile::settle_time, options.step)),
            steps = s.steps.value_or(steps_in(RockPile::rest_time, options.step)),
            dig = s.dig.value_or(steps_in(RockPile::dig_time, options.step));
  Progress progress;
  support::PileWorld world(support::rock_pile(s.rocks, s.seed, s.material.pile()), options);
  nlohmann::json out = described(options);
  out.update({{"rolling", s.material.rolling}, {"spinning", s.material.spinning}});
  out.update({{"rocks", s.rocks}, {"seed", s.seed}, {"mass_kg", world.pile().mass()}});
  out.update({{"settle_steps", settle}, {"rest_steps", steps}, {"dig_steps", dig}});

  run_phase(world, "settle", settle, progress);
  const auto before = world.states();
  const PhaseTimes rest = run_phase(world, "rest", steps, progress);
  out["ms_rest"] = rest.median();
  out["ms_rest_parts"] = rest.parts();
  out["contacts"] = rest.points;
  out["manifolds"] = rest.manifolds;
  out["computed"] = rest.computed;
  out["refused"] = rest.refused;
  out["complementarity"] = rest.complementarity;
  out["cone"] = rest.cone;
  measure_rest(out, world, before, steps * options.step);
  measure_dig(out, world, dig, progress);
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx",
                static_cast<unsigned long long>(support::state_hash(world.states())));
  out["hash"] = hash;
  return out;
}

double number(const nlohmann::json& j, const char* key) { return j.at(key).get<double>(); }

void print_times(const char* what, double ms, const nlohmann::json& parts) {
  std::printf(
      "%-6s %9.3f ms per step; means: broad %.3f, narrow %.3f, solver %.3f, machine %.3f, rest %.3f\n", what,
      ms, number(parts, "broad"), number(parts, "narrow"), number(parts, "solver"), number(parts, "machine"),
      number(parts, "rest"));
}

void print_table(const nlohmann::json& j) {
  std::printf("%d rocks, %.1f t, rolling resistance %g, spinning %g; %s\n", j.at("rocks").get<int>(),
              number(j, "mass_kg") / 1e3, number(j, "rolling"), number(j, "spinning"), in_words(j).c_str());
  print_times("rest", number(j, "ms_rest"), j.at("ms_rest_parts"));
  print_times("dig", number(j, "ms_dig"), j.at("ms_dig_parts"));
  std::printf("contact points %d in %d manifolds at rest; %d while digging\n", j.at("contacts").get<int>(),
              j.at("manifolds").get<int>(), j.at("dig_contacts").get<int>());
  std::printf("pairs computed by %s: %ld at rest, %ld while digging; FCL wrong in %ld and %ld\n",
              j.at("narrow").get<std::string>().c_str(), j.at("computed").get<long>(),
              j.at("dig_computed").get<long>(), j.at("refused").get<long>(), j.at("dig_refused").get<long>());
  for (const std::string prefix : {"", "dig_"})
    std::printf("%-6s overlap max %.3f %%, p99 %.3f %%, mean %.4f %% of the smaller rock, %d pairs\n",
                prefix.empty() ? "rest" : "dig", 100 * number(j, (prefix + "overlap_max").c_str()),
                100 * number(j, (prefix + "overlap_p99").c_str()),
                100 * number(j, (prefix + "overlap_mean").c_str()),
                j.at(prefix + "touching_pairs").get<int>());
  std::printf(
      "drift %.4f mm/s (median %.5f, 99 %% below %.4f, worst rock %.3f), kinetic energy %.2e J per rock\n",
      number(j, "drift_mm_s"), number(j, "drift_median_mm_s"), number(j, "drift_p99_mm_s"),
      number(j, "drift_worst_mm_s"), number(j, "kinetic_energy_per_rock_j"));
  std::printf("drag on the blade %.1f kN\nhash %s\n", number(j, "blade_drag_n") / 1e3,
              j.at("hash").get<std::string>().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "pile_scenario");
  app.add_option("--rocks", s.rocks, "number of rocks")
      ->check(between(1, 100'000, "", "500 to 3000 are usual"))
      ->capture_default_str();
  app.add_option("--seed", s.seed, "of sizes, shapes and start poses")
      ->check(between(0, 1e9, "", "any number names a pile"))
      ->capture_default_str();
  app.add_option("--settle", s.settle, "steps of settling (default: 5 s)")
      ->check(between(1, 1e7, "steps", "leave it out for 5 s"));
  app.add_option("--steps", s.steps, "steps at rest, timed; drift is over these (default: 2 s)")
      ->check(between(1, 1e7, "steps", "leave it out for 2 s"));
  app.add_option("--dig", s.dig, "steps of digging (default: 1 s)")
      ->check(between(1, 1e7, "steps", "leave it out for 1 s; the blade meets the wall after 3.6 s"));
  add_engine_flags(app, s.engine);
  add_material_flags(app, s.material);
  add_json_flag(app, s.json);
  return run_command(app, argc, argv, [&] { return show(run(s), s.json, print_table); });
}
