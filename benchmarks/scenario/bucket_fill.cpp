// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/engine/loading/pile_shape.hpp>
#include <filesystem>
#include <optional>

#include "cycle_run.hpp"
#include "each_seed.hpp"
#include "estimate.hpp"
#include "interrupt.hpp"
#include "loading_flags.hpp"
#include "setting.hpp"

/// How much a bucket loads, over wanted fill and piles: the first thing to look at after a change of machine,
/// rock or solver. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using namespace drawpoint::engine::loading;

namespace {

constexpr const char* about =
    "Loading cycles of the LHD, one pile per seed, for several wanted fills alpha. Prints, per alpha, what "
    "the\n"
    "bucket loads (mean and standard deviation over all cycles), how deep the drive-in came beyond the toe, "
    "how many\n"
    "drive-ins and lifts reached their goal before the stuck rule ended them, and the responses (means of "
    "the runs).\n"
    "Piles are poured with the materials given and kept in FOLDER. After Ctrl-C the runs that are done are "
    "printed.\n\n"
    "  bucket_fill --piles /tmp/piles                        alpha 0.3, 1 and 1.6 on six piles\n"
    "  bucket_fill --piles /tmp/old --materials lindmark2016 the same with the tables of Lindmark (2016)\n"
    "  bucket_fill --piles /tmp/old --materials lindmark2016 --setting 10x1x150 --cold\n"
    "                                                        and solved as loosely as there";

struct Settings {
  std::string piles, logs, materials = "calibrated", setting;
  OperationFlags operation;
  PileFlags pile;
  std::vector<double> alphas = {0.3, 1.0, 1.6};
  Strategy strategy = {.alpha = 1, .beta = 0.4, .gamma = 0.5, .kappa = 0.5};
  std::optional<double> rolling, spinning, steel_friction, rock_friction;
  int seeds = 6, cycles = 1, jobs = 1;
  bool cold = false, json = false;
};

struct Cycle {
  double loaded = 0, depth = 0, wanted_depth = 0, time = 0;
  int rocks = 0;
  bool drive_in_done = false, lift_done = false;
};

// Without failure and without cycles: not made.
struct Result {
  std::string failure;  // why there is nothing else
  std::vector<Cycle> cycles;
  double production = 0, damage = 0, spill = 0;
};

Scenario scenario_of(const Settings& s) {
  Scenario scenario = s.pile.scenario();
  scenario.cycles = s.cycles;
  scenario.strategy = s.strategy;
  scenario.materials = materials_named(s.materials);
  scenario.materials = with_resistance(scenario.materials, s.rolling, s.spinning);
  if (s.steel_friction) scenario.materials.rock_steel.friction = *s.steel_friction;
  if (s.rock_friction) scenario.materials.rock_rock.friction = *s.rock_friction;
  s.operation.apply(scenario);
  return scenario;
}

// How it is solved is no part of what the pile was poured with.
void solve_as_told(Scenario& scenario, const Settings& s) {
  if (!s.setting.empty()) scenario.world = with(scenario.world, setting_of(s.setting));
  if (s.cold) scenario.world.warm_start = 0;
}

// Empty: none is kept.
std::filesystem::path log_file(const Settings& s, int seed, double alpha) {
  if (s.logs.empty()) return {};
  char name[64];
  std::snprintf(name, sizeof name, "alpha_%g_seed_%d.h5", alpha, seed);
  return std::filesystem::path(s.logs) / name;
}

Result result_of(const LoadingLog& log) {
  Result result;
  if (!log.completed) {
    if (!interrupted()) result.failure = log.message;
    return result;
  }
  for (const CycleRecord& c : log.cycles)
    result.cycles.push_back({.loaded = c.loaded_mass,
                             .depth = c.stages.front().end.x - c.plan.toe,
                             .wanted_depth = c.plan.depth,
                             .time = c.seconds(),
                             .rocks = static_cast<int>(c.loaded_rock_masses.size()),
                             .drive_in_done = reached_goal(c, Stage::drive_in),
                             .lift_done = reached_goal(c, Stage::lift)});
  result.production = production(log);
  result.damage = joint_damage(log);
  result.spill = rock_spill(log);
  return result;
}

void tell(int seed, double alpha, const Result& result) {
  if (!result.failure.empty())
    std::fprintf(stderr, "seed %d, alpha %g failed: %s\n", seed, alpha, result.failure.c_str());
  else if (!result.cycles.empty())
    std::fprintf(stderr, "seed %d, alpha %g: %.0f kg in the first cycle, %.1f kg/s\n", seed, alpha,
                 result.cycles.front().loaded, result.production);
}

struct Study {
  std::vector<PileShape> piles;              // that were poured
  std::vector<std::vector<Result>> results;  // by alpha, by seed
};

// One pile and its runs, into the place of its seed.
void run_pile(const Settings& s, int seed, Study& out) {
  if (interrupted()) return;
  const auto k = static_cast<std::size_t>(seed - 1);
  Scenario scenario = with_pile(scenario_of(s), s.piles, seed);
  const SettledPile pile = prepared_pile(scenario, [](double) { end_if_interrupted(); });
  out.piles[k] = pile_shape(pile, scenario);
  solve_as_told(scenario, s);
  SimulationHooks hooks;
  hooks.on_step = [](const engine::StepReport&) { end_if_interrupted(); };
  for (std::size_t a = 0; a < s.alphas.size() && !interrupted(); ++a) {
    scenario.strategy.alpha = s.alphas[a];
    scenario.seed = static_cast<std::uint64_t>(seed);
    scenario.log_file = log_file(s, seed, s.alphas[a]);
    out.results[a][k] = result_of(simulate(scenario, pile, hooks));
    tell(seed, s.alphas[a], out.results[a][k]);
  }
}

Study study(const Settings& s) {
  const auto n = static_cast<std::size_t>(s.seeds);
  Study out{std::vector<PileShape>(n), std::vector(s.alphas.size(), std::vector<Result>(n))};
  if (!s.logs.empty()) std::filesystem::create_directories(s.logs);  // before anything is poured
  each_seed(s.seeds, s.jobs, [&](int seed) {
    try {
      run_pile(s, seed, out);
    } catch (const std::exception&) {
      if (!interrupted()) throw;
    }
  });
  std::erase_if(out.piles, [](const PileShape& pile) { return pile.mass == 0; });
  if (out.piles.empty()) throw std::runtime_error("interrupted before a pile was poured; nothing is kept");
  return out;
}

double deviation(const std::vector<double>& values) {
  return values.size() < 2 ? 0 : standard_error(values) * std::sqrt(static_cast<double>(values.size()));
}

nlohmann::json row(double alpha, const std::vector<Result>& runs) {
  std::vector<double> loaded, depth, wanted, time, production, damage, spill, rocks;
  int drive_ins = 0, lifts = 0, failed = 0;
  for (const Result& run : runs) {
    failed += !run.failure.empty();
    if (run.cycles.empty()) continue;
    for (const Cycle& c : run.cycles) {
      loaded.push_back(c.loaded);
      depth.push_back(c.depth);
      wanted.push_back(c.wanted_depth);
      time.push_back(c.time);
      rocks.push_back(c.rocks);
      drive_ins += c.drive_in_done;
      lifts += c.lift_done;
    }
    production.push_back(run.production);
    damage.push_back(run.damage);
    spill.push_back(run.spill);
  }
  if (loaded.empty()) return {{"alpha", alpha}, {"failed", failed}, {"cycles", 0}};
  return {{"alpha", alpha},
          {"failed", failed},
          {"cycles", loaded.size()},
          {"loaded_kg", mean_of(loaded)},
          {"loaded_deviation_kg", deviation(loaded)},
          {"rocks", mean_of(rocks)},
          {"depth_m", mean_of(depth)},
          {"wanted_depth_m", mean_of(wanted)},
          {"drive_ins_done", drive_ins},
          {"lifts_done", lifts},
          {"cycle_s", mean_of(time)},
          {"production_kg_s", mean_of(production)},
          {"production_deviation_kg_s", deviation(production)},
          {"joint_damage_s", mean_of(damage)},
          {"rock_spill", mean_of(spill)}};
}

// What decides the rows, as it came out of the flags.
nlohmann::json described(const Settings& s) {
  Scenario scenario = scenario_of(s);
  nlohmann::json out{{"poured", in_words(benchmarks::described(scenario.world))}};
  solve_as_told(scenario, s);
  const MineMaterials& m = scenario.materials;
  out.update({{"materials", s.materials},
              {"rolling", m.rock_rock.rolling},
              {"spinning", m.rock_rock.spinning},
              {"rock_friction", m.rock_rock.friction},
              {"steel_friction", m.rock_steel.friction},
              {"steel_rolling", m.rock_steel.rolling},
              {"beta", s.strategy.beta},
              {"gamma", s.strategy.gamma},
              {"kappa", s.strategy.kappa},
              {"scene", s.pile.scene},
              {"sizes", s.pile.sizes},
              {"cycles", s.cycles},
              {"speeds", s.operation.speeds},
              {"curl", s.operation.curl},
              {"lift", s.operation.lift},
              {"operator", in_words(s.operation)},
              {"solved", in_words(benchmarks::described(scenario.world)) + (s.cold ? ", cold" : "")}});
  return out;
}

nlohmann::json as_json(const Settings& s, const Study& study) {
  nlohmann::json out{
      {"seeds", study.piles.size()}, {"scenario", described(s)}, {"rows", nlohmann::json::array()}};
  std::vector<double> angle, crest, mass;
  for (const PileShape& p : study.piles) {
    angle.push_back(p.surface.mean * 180 / M_PI);
    crest.push_back(p.surface.crest);
    mass.push_back(p.mass);
  }
  out["pile"] = {{"angle_deg", mean_of(angle)},
                 {"angle_deviation_deg", deviation(angle)},
                 {"angle_least_deg", *std::min_element(angle.begin(), angle.end())},
                 {"angle_most_deg", *std::max_element(angle.begin(), angle.end())},
                 {"crest_m", mean_of(crest)},
                 {"mass_kg", mean_of(mass)}};
  for (std::size_t a = 0; a < s.alphas.size(); ++a) out["rows"].push_back(row(s.alphas[a], study.results[a]));
  return out;
}

double number(const nlohmann::json& j, const char* key) { return j.at(key).get<double>(); }

void print_table(const nlohmann::json& j) {
  const nlohmann::json& pile = j.at("pile");
  std::printf("%d piles of %.1f t: crest %.2f m, surface at %.1f +- %.1f deg (%.1f to %.1f)\n",
              j.at("seeds").get<int>(), number(pile, "mass_kg") / 1e3, number(pile, "crest_m"),
              number(pile, "angle_deg"), number(pile, "angle_deviation_deg"), number(pile, "angle_least_deg"),
              number(pile, "angle_most_deg"));
  const nlohmann::json& of = j.at("scenario");
  std::printf(
      "%s: rocks %s, rolling %g (steel %g), spinning %g, friction %g (steel %g); beta %g, gamma %g, kappa "
      "%g; %s "
      "speeds, "
      "curl about the %s, lift by the %s, operator: %s\nsolved with %s\n",
      of.at("materials").get<std::string>().c_str(), of.at("sizes").get<std::string>().c_str(),
      number(of, "rolling"), number(of, "steel_rolling"), number(of, "spinning"), number(of, "rock_friction"),
      number(of, "steel_friction"), number(of, "beta"), number(of, "gamma"), number(of, "kappa"),
      of.at("speeds").get<std::string>().c_str(), of.at("curl").get<std::string>().c_str(),
      of.at("lift").get<std::string>().c_str(), of.at("operator").get<std::string>().c_str(),
      of.at("solved").get<std::string>().c_str());
  for (const nlohmann::json& r : j.at("rows"))
    if (const int failed = r.at("failed").get<int>())
      std::printf("alpha %g: %d of %d runs failed and are left out\n", number(r, "alpha"), failed,
                  j.at("seeds").get<int>());
  std::printf("%6s %6s %14s %6s %13s %9s %6s %7s %16s %8s %8s\n", "alpha", "cycles", "loaded t", "rocks",
              "depth (of) m", "drive-ins", "lifts", "cycle s", "production kg/s", "damage s", "spill");
  for (const nlohmann::json& r : j.at("rows")) {
    const int cycles = r.at("cycles").get<int>();
    if (cycles == 0) {
      std::printf("%6.2f no run came to its end\n", number(r, "alpha"));
      continue;
    }
    std::printf(
        "%6.2f %6d %6.2f +- %4.2f %6.0f %5.2f (%5.2f) %5d/%-3d %2d/%-3d %7.1f %8.0f +- %4.0f %8.2f %8.3f\n",
        number(r, "alpha"), cycles, number(r, "loaded_kg") / 1e3, number(r, "loaded_deviation_kg") / 1e3,
        number(r, "rocks"), number(r, "depth_m"), number(r, "wanted_depth_m"),
        r.at("drive_ins_done").get<int>(), cycles, r.at("lifts_done").get<int>(), cycles,
        number(r, "cycle_s"), number(r, "production_kg_s"), number(r, "production_deviation_kg_s"),
        number(r, "joint_damage_s"), number(r, "rock_spill"));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "bucket_fill");
  app.add_option("--piles", s.piles, "FOLDER of the piles; made when missing")->required();
  app.add_option("--logs", s.logs, "FOLDER for the log of each run (HDF5)");
  app.add_option("--alphas", s.alphas, "wanted fills, with commas between")
      ->delimiter(',')
      ->check(between(0, 5, "", "0.2 to 2 are studied"))
      ->capture_default_str();
  add_shares_of_strategy(app, s.strategy);
  app.add_option("--seeds", s.seeds, "number of piles, seeds 1, 2, ...")
      ->check(between(1, 1000, "", "6 and more show the scatter"))
      ->capture_default_str();
  app.add_option("--cycles", s.cycles, "cycles per run")
      ->check(between(1, 1000, "", "1 to 30"))
      ->capture_default_str();
  app.add_option("--materials", s.materials, "preset of the coefficients")
      ->check(one_of(material_names))
      ->capture_default_str();
  const auto coefficient = between(0, 2, "", "leave it out for the preset's");
  app.add_option("--rolling", s.rolling, "rolling resistance of the rocks [1]")->check(coefficient);
  app.add_option("--spinning", s.spinning, "spinning resistance of the rocks [1]")->check(coefficient);
  app.add_option("--rock-friction", s.rock_friction, "friction of rock on rock [1]")->check(coefficient);
  app.add_option("--steel-friction", s.steel_friction, "friction of rock on steel [1]")->check(coefficient);
  add_pile_flags(app, s.pile);
  add_operation_flags(app, s.operation);
  app.add_option(
         "--setting", s.setting,
         "how cycles are solved: STEPxSUBSTEPSxITERATIONS with the step in ms, +BUDGET for iteration budget "
         "(default: the study's; piles are always poured with that)")
      ->check(taken_by(setting_of));
  app.add_flag("--cold", s.cold, "begin each step's solve from nothing");
  app.add_option("--jobs", s.jobs, "piles at a time")
      ->check(between(1, 256, "", "no more than there are cores"))
      ->capture_default_str();
  add_json_flag(app, s.json);
  return run_command(app, argc, argv, [&] {
    watch_for_interrupt();
    const int code = show(as_json(s, study(s)), s.json, print_table);
    return interrupted() ? interrupted_exit : code;
  });
}
