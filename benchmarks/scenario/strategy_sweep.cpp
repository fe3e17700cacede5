// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/engine/loading/log/run_measures.hpp>
#include <functional>

#include "cycle_run.hpp"
#include "each_seed.hpp"
#include "estimate.hpp"
#include "estimate_json.hpp"
#include "interrupt.hpp"
#include "loading_flags.hpp"

/// What one variable of the strategy does to the responses, the others held. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using namespace drawpoint::engine::loading;

namespace {

constexpr const char* about =
    "Runs of loading cycles over one variable of the strategy, the others held, on several piles: means over "
    "the "
    "piles with\n"
    "95 % intervals (Student's t). Piles are poured when missing and kept in FOLDER. A run that fails is "
    "left out and\n"
    "counted; after Ctrl-C the runs that are done are printed.\n\n"
    "  strategy_sweep --piles /tmp/piles --vary alpha --values 0.2,0.6,1,1.4,2\n"
    "  strategy_sweep --piles /tmp/piles --vary kappa --alpha 1.4 --cycles 5 --seeds 6 --jobs 2\n\n"
    "Columns: production [kg/s], joint damage per cycle [s], rock spill, loaded mass over the rated\n"
    "payload and over what the struck volume holds, share of drive-ins that stalled, distance of the tip "
    "from\n"
    "its plan [m], energy per tonne [kJ/t], range of the bucket's pin load that fatigues as much [kN], cycle "
    "[s].";

struct Settings {
  std::string piles, variable = "alpha";
  OperationFlags operation;
  PileFlags pile;
  std::vector<double> values;
  Strategy strategy;
  int seeds = 3, cycles = 5, jobs = 1;
  bool json = false;
};

struct Measure {
  const char *key, *title;
  int digits;
  std::function<double(const LoadingLog&)> of;
};

const std::vector<Measure>& measures() {
  static const std::vector<Measure> all{
      {"production_kg_s", "production", 0, [](const LoadingLog& log) { return production(log); }},
      {"joint_damage_s", "damage", 2,
       [](const LoadingLog& log) { return joint_damage(log, {.sum = DamageSum::per_cycle}); }},
      {"rock_spill", "spill", 3, [](const LoadingLog& log) { return rock_spill(log); }},
      {"fill_factor", "fill", 3, fill_factor},
      {"heaped_fill", "heaped", 2, heaped_fill},
      {"stall_share", "stalls", 2, stall_share},
      {"tracking_error_m", "tracking", 2, tracking_error},
      {"energy_kj_t", "energy", 0, energy_per_tonne},
      {"pin_load_range_kn", "pin range", 0, [](const LoadingLog& log) { return pin_load_range(log); }},
      {"cycle_s", "cycle", 1, cycle_time}};
  return all;
}

double& varied(Strategy& strategy, const std::string& variable) {
  if (variable == "alpha") return strategy.alpha;
  if (variable == "beta") return strategy.beta;
  return variable == "gamma" ? strategy.gamma : strategy.kappa;
}

// Nine, evenly over the studied range.
std::vector<double> usual_values(const std::string& variable) {
  const double low = variable == "alpha" ? 0.2 : 0, high = variable == "alpha" ? 2 : 1;
  std::vector<double> values;
  for (int k = 0; k < 9; ++k) values.push_back(low + (high - low) * k / 8);
  return values;
}

// The flag's own range is that of alpha, the widest.
void check_values(const Settings& s) {
  for (const double value : s.values)
    if (s.variable != "alpha" && value > 1)
      throw std::invalid_argument("--values: " + s.variable + " is " + nlohmann::json(value).dump() +
                                  "; allowed: 0 to 1");
}

Scenario scenario_of(const Settings& s) {
  Scenario scenario = s.pile.scenario();
  scenario.cycles = s.cycles;
  scenario.strategy = s.strategy;
  s.operation.apply(scenario);
  return scenario;
}

struct Run {
  bool failed = false;
  int lost = 0;                     // cycles
  std::vector<double> values = {};  // by measure; empty if it failed or was not made
};

Run run_of(const LoadingLog& log, const std::string& name) {
  if (!log.completed) {
    if (!interrupted()) std::fprintf(stderr, "%s failed: %s\n", name.c_str(), log.message.c_str());
    return {.failed = !interrupted()};
  }
  Run run{.lost = static_cast<int>(log.numbers.at("lost_cycles"))};
  for (const Measure& m : measures()) run.values.push_back(m.of(log));
  std::fprintf(stderr, "%s: %.0f kg/s, fill %.2f\n", name.c_str(), run.values[0], run.values[3]);
  return run;
}

// By value, then by seed. Runs that an interrupt leaves out are not made.
std::vector<std::vector<Run>> sweep(const Settings& s) {
  const auto seeds = static_cast<std::size_t>(s.seeds);
  std::vector<Scenario> scenarios(seeds);
  std::vector<SettledPile> piles(seeds);
  each_seed(s.seeds, s.jobs, [&](int seed) {
    const auto k = static_cast<std::size_t>(seed - 1);
    scenarios[k] = with_pile(scenario_of(s), s.piles, seed);
    scenarios[k].seed = static_cast<std::uint64_t>(seed);
    piles[k] = prepared_pile(scenarios[k], [](double) { end_if_interrupted(); });
  });
  SimulationHooks hooks;
  hooks.on_step = [](const engine::StepReport&) { end_if_interrupted(); };
  std::vector<std::vector<Run>> runs(s.values.size(), std::vector<Run>(seeds));
  each_seed(static_cast<int>(s.values.size() * seeds), s.jobs, [&](int run) {
    if (interrupted()) return;
    const std::size_t k = static_cast<std::size_t>(run - 1) % seeds,
                      v = static_cast<std::size_t>(run - 1) / seeds;
    Scenario scenario = scenarios[k];
    varied(scenario.strategy, s.variable) = s.values[v];
    char name[64];
    std::snprintf(name, sizeof name, "%s %g, seed %zu", s.variable.c_str(), s.values[v], k + 1);
    runs[v][k] = run_of(simulate(scenario, piles[k], hooks), name);
  });
  return runs;
}

nlohmann::json row_as_json(double value, const std::vector<Run>& runs) {
  nlohmann::json row{{"value", value}};
  int failed = 0, made = 0, lost = 0;
  for (const Run& run : runs) failed += run.failed, made += !run.values.empty(), lost += run.lost;
  row["failed"] = failed;
  row["lost_cycles"] = lost;
  row["runs"] = made;
  for (std::size_t m = 0; m < measures().size(); ++m) {
    std::vector<double> values;
    for (const Run& run : runs)
      if (!run.values.empty()) values.push_back(run.values[m]);
    row[measures()[m].key] = values.empty() ? nlohmann::json{{"mean", nullptr}, {"half_width", nullptr}}
                                            : as_json(estimate(values));
  }
  return row;
}

nlohmann::json as_json(const Settings& s, const std::vector<std::vector<Run>>& runs) {
  nlohmann::json out{{"variable", s.variable},
                     {"seeds", s.seeds},
                     {"cycles", s.cycles},
                     {"speeds", s.operation.speeds},
                     {"operator", in_words(s.operation)},
                     {"pile_kg", scenario_of(s).pile.mass},
                     {"scene", s.pile.scene},
                     {"sizes", s.pile.sizes},
                     {"alpha", s.strategy.alpha},
                     {"beta", s.strategy.beta},
                     {"gamma", s.strategy.gamma},
                     {"kappa", s.strategy.kappa},
                     {"rows", nlohmann::json::array()}};
  out[s.variable] = "varied";
  for (std::size_t v = 0; v < runs.size(); ++v) out["rows"].push_back(row_as_json(s.values[v], runs[v]));
  return out;
}

std::string held(const nlohmann::json& j) {
  std::string text;
  for (const char* variable : {"alpha", "beta", "gamma", "kappa"}) {
    if (j.at(variable).is_string()) continue;
    char part[32];
    std::snprintf(part, sizeof part, "%s%s %g", text.empty() ? "" : ", ", variable,
                  j.at(variable).get<double>());
    text += part;
  }
  return text;
}

void print_table(const nlohmann::json& j) {
  std::printf("%s varied; %s; %s speeds, operator: %s; %d piles of %.0f t (%s), cycles per run: %d\n%8s",
              j.at("variable").get<std::string>().c_str(), held(j).c_str(),
              j.at("speeds").get<std::string>().c_str(), j.at("operator").get<std::string>().c_str(),
              j.at("seeds").get<int>(), j.at("pile_kg").get<double>() / 1e3,
              j.at("sizes").get<std::string>().c_str(), j.at("cycles").get<int>(),
              j.at("variable").get<std::string>().c_str());
  for (const Measure& m : measures()) std::printf(" %16s", m.title);
  std::printf(" %7s %11s\n", "failed", "lost cycles");
  for (const nlohmann::json& row : j.at("rows")) {
    std::printf("%8.3f", row.at("value").get<double>());
    for (const Measure& m : measures())
      std::printf(" %16s",
                  plus_minus(row.at(m.key).at("mean"), row.at(m.key).at("half_width"), m.digits).c_str());
    std::printf(" %7d %11d\n", row.at("failed").get<int>(), row.at("lost_cycles").get<int>());
  }
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "strategy_sweep");
  app.add_option("--piles", s.piles, "FOLDER of the piles; made when missing")->required();
  app.add_option("--vary", s.variable, "the variable")
      ->check(CLI::IsMember({"alpha", "beta", "gamma", "kappa"}))
      ->capture_default_str();
  app.add_option("--values", s.values, "of it, with commas between (default: nine over its studied range)")
      ->delimiter(',')
      ->check(between(0, 5, "", "alpha 0.2 to 2, the others 0 to 1"));
  app.add_option("--alpha", s.strategy.alpha, "wanted fill")
      ->check(between(0, 5, "", "0.2 to 2 are studied"))
      ->capture_default_str();
  add_shares_of_strategy(app, s.strategy);
  app.add_option("--seeds", s.seeds, "number of piles, seeds 1, 2, ...")
      ->check(between(1, 1000, "", "3 and more for intervals"))
      ->capture_default_str();
  app.add_option("--cycles", s.cycles, "cycles per run")
      ->check(between(1, 1000, "", "1 to 30"))
      ->capture_default_str();
  add_operation_flags(app, s.operation);
  add_pile_flags(app, s.pile);
  app.add_option("--jobs", s.jobs, "runs at a time")
      ->check(between(1, 256, "", "no more than there are cores"))
      ->capture_default_str();
  add_json_flag(app, s.json);
  return run_command(app, argc, argv, [&] {
    if (s.values.empty()) s.values = usual_values(s.variable);
    check_values(s);
    watch_for_interrupt();
    const int code = show(as_json(s, sweep(s)), s.json, print_table);
    return interrupted() ? interrupted_exit : code;
  });
}
