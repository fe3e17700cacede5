// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "accuracy_run.hpp"
#include "cycle_run.hpp"
#include "each_seed.hpp"
#include "estimate.hpp"
#include "estimate_json.hpp"
#include "force_windows.hpp"
#include "loading_flags.hpp"
#include "setting.hpp"

/// Accuracy against cost: how far step, substeps and iterations are from a converged run of the same pile.
/// See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;

namespace {

constexpr const char* about =
    "Accuracy against cost. Each seed's pile is settled once; every setting then goes on from there and is\n"
    "compared, seed by seed, with a reference of a small step and very many iterations. The second row is "
    "the\n"
    "reference's replicate, started a micrometre off: what chaos alone does. Intervals: 95 %, Student's t "
    "over "
    "the\n"
    "seeds. A setting is STEPxSUBSTEPSxITERATIONS with the step in milliseconds, and +BUDGET for iteration "
    "budget.\n\n"
    "  accuracy_study --rocks 200 --seeds 3 --settings 10x16x1,10x16x1+20000,5x1x25\n"
    "                             the pile of pile_scenario: 0.5 s to take up the loads, 1 s at rest, 1 s "
    "of\n"
    "                             digging. Settled overlap (of the smaller rock), drift at rest, drag on "
    "the\n"
    "                             blade over the last 0.6 s (mean; 95th percentile of 10 ms windows), mass\n"
    "                             moved (sum of mass times displacement along the blade's way, over that "
    "way)\n"
    "  accuracy_study --cycle FOLDER --seeds 8\n"
    "                             a loading cycle of the LHD on another pile per seed (poured and kept in "
    "FOLDER\n"
    "                             when missing): mean force in the bucket's pin, loaded mass, mean over the\n"
    "                             steps of the deepest overlap of a rock\n"
    "  accuracy_study --windows FOLDER --seeds 8\n"
    "                             the force on the bucket alone, before chaos parts the runs: while the "
    "reference\n"
    "                             digs, every 0.2 s each setting goes on from its state for 0.3 s; mean of "
    "the\n"
    "                             windows of a cycle\n\n"
    "Fields of --json: each quantity with its mean and half_width; *_difference: setting minus reference "
    "over\n"
    "the reference's mean.";

struct Settings {
  EngineFlags engine;  // method and threads
  MaterialFlags material;
  int rocks = 500, seeds = 5, jobs = 1;
  std::vector<std::string> tried = {"10x16x1+20000", "10x16x1", "10x16x4", "5x1x25", "2.5x4x1"};
  std::string reference = "2.5x1x1000", reference_method = "sequential";
  std::string cycle, windows;
  WindowOptions window;
  double alpha = engine::loading::Strategy{}.alpha;
  bool json = false;
};

bool loads(const Settings& s) { return !s.cycle.empty() || !s.windows.empty(); }

struct Quantity {
  const char *key, *title;
  double scale;
  int digits;
  bool compared;  // with the reference
};

using Sample = std::vector<double>;  // by quantity
using Run = std::function<Sample(const engine::WorldOptions&, double offset)>;

struct Configuration {
  std::string name;
  Setting setting;
  engine::WorldOptions options;
  double offset = 0;
  std::vector<Sample> samples;  // by seed
};

// What is studied: quantities, and the samples of one seed's pile by all configurations, the reference first.
struct Subject {
  std::vector<Quantity> quantities;
  std::function<std::vector<Sample>(int seed, const std::vector<Configuration>& all)> samples;
};

// Each configuration's run from the same start.
std::vector<Sample> one_by_one(const std::vector<Configuration>& all, const Run& run) {
  std::vector<Sample> samples;
  for (const Configuration& c : all) samples.push_back(run(c.options, c.offset));
  return samples;
}

std::vector<Configuration> configurations(const Settings& s, engine::WorldOptions options) {
  std::vector<Configuration> all;
  options.threads = world_options(s.engine).threads;
  const auto add = [&](const std::string& name, const std::string& text, double offset) {
    const Setting setting = setting_of(text);
    all.push_back({name, setting, with(options, setting), offset,
                   std::vector<Sample>(static_cast<std::size_t>(s.seeds))});
  };
  options.solver.method = engine::method_named(s.reference_method);
  add("reference", s.reference, 0);
  add("replicate", s.reference, 1e-6);
  options.solver.method = world_options(s.engine).solver.method;
  for (const std::string& setting : s.tried) add("", setting, 0);
  return all;
}

// Settles well below the errors in question: every setting starts from the same pile.
engine::WorldOptions settling_options() { return with({}, setting_of("5x5x10")); }

Subject blade(const Settings& s) {
  return {{{"ms_rest", "ms rest", 1, 2, false},
           {"ms_dig", "ms dig", 1, 2, false},
           {"overlap_mean", "overlap mean %", 100, 5, false},
           {"overlap_p99", "overlap p99 %", 100, 4, false},
           {"dig_overlap_p99", "dig p99 %", 100, 2, false},
           {"drift_m_s", "drift mm/s", 1e3, 4, false},
           {"drag_n", "drag kN", 1e-3, 1, true},
           {"drag_p95_n", "drag p95 kN", 1e-3, 1, true},
           {"mass_moved_kg", "moved t", 1e-3, 2, true}},
          [&s](int seed, const std::vector<Configuration>& all) {
            Progress progress;
            const SettledState start =
                settled(support::rock_pile(s.rocks, static_cast<std::uint64_t>(seed), s.material.pile()),
                        settling_options(), progress);
            return one_by_one(all, [&](const engine::WorldOptions& options, double offset) -> Sample {
              const AccuracySample a = accuracy_sample(start, options, offset, progress);
              return {a.ms_rest, a.ms_dig, a.overlap_mean, a.overlap_p99, a.dig_overlap_p99,
                      a.drift,   a.drag,   a.drag_p95,     a.mass_moved};
            });
          }};
}

Subject cycle(const Settings& s, const engine::loading::Scenario& scenario) {
  return {{{"ms_step", "ms per step", 1, 2, false},
           {"mean_deepest_overlap_m", "mean deepest mm", 1e3, 2, false},
           {"bucket_force_n", "bucket kN", 1e-3, 1, true},
           {"loaded_mass_kg", "loaded t", 1e-3, 2, true}},
          [&s, scenario](int seed, const std::vector<Configuration>& all) {
            const engine::loading::Scenario of = with_pile(scenario, s.cycle, seed);
            const engine::loading::SettledPile pile = prepared_pile(of);
            return one_by_one(all, [&](const engine::WorldOptions& options, double offset) -> Sample {
              engine::loading::Scenario started = of;
              started.world = options;
              const CycleSample c = cycle_run(started, displaced(pile, 1, offset));
              return {c.ms_step, c.mean_deepest_overlap, c.bucket_force, c.loaded_mass};
            });
          }};
}

// The reference drives the cycle, and is the first of those that go on from it.
Subject windows(const Settings& s, const engine::loading::Scenario& scenario) {
  return {{{"ms_step", "ms per step", 1, 2, false},
           {"windows", "windows", 1, 0, false},
           {"bucket_force_n", "bucket kN", 1e-3, 1, true}},
          [&s, scenario](int seed, const std::vector<Configuration>& all) {
            engine::loading::Scenario of = with_pile(scenario, s.windows, seed);
            const engine::loading::SettledPile pile = prepared_pile(of);
            of.world = all.front().options;
            std::vector<WindowChoice> choices;
            for (const Configuration& c : all)
              choices.push_back({c.options.step, c.options.solver, c.offset / c.options.step});
            std::vector<Sample> samples;
            for (const std::vector<WindowMeans>& of_choice : force_windows(of, pile, choices, s.window)) {
              std::vector<double> force, ms;
              for (const WindowMeans& w : of_choice) force.push_back(w.force), ms.push_back(w.ms_step);
              samples.push_back({mean_of(ms), static_cast<double>(force.size()), mean_of(force)});
            }
            return samples;
          }};
}

// "drag kN 84.1, moved t 3.07"
std::string compared(const Subject& subject, const Sample& sample) {
  std::string line;
  for (std::size_t k = 0; k < subject.quantities.size(); ++k) {
    const Quantity& q = subject.quantities[k];
    if (!q.compared) continue;
    char text[64];
    std::snprintf(text, sizeof text, "%s%s %.*f", line.empty() ? "" : ", ", q.title, q.digits,
                  q.scale * sample[k]);
    line += text;
  }
  return line;
}

void run_seed(const Subject& subject, int seed, std::vector<Configuration>& all) {
  const std::vector<Sample> samples = subject.samples(seed, all);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].samples[static_cast<std::size_t>(seed - 1)] = samples[k];
    std::fprintf(stderr, "seed %d, %s %s: %s\n", seed, all[k].name.c_str(), name_of(all[k].setting).c_str(),
                 compared(subject, samples[k]).c_str());
  }
}

std::vector<double> values(const Configuration& c, std::size_t quantity) {
  std::vector<double> out;
  for (const Sample& sample : c.samples) out.push_back(sample[quantity]);
  return out;
}

// (setting − reference) / mean of the reference
Estimate relative_difference(const Configuration& c, const Configuration& reference, std::size_t quantity) {
  const double scale = mean_of(values(reference, quantity));
  const Estimate d = paired_difference(values(c, quantity), values(reference, quantity));
  return {d.mean / scale, d.half_width / std::abs(scale)};
}

nlohmann::json described(const Subject& subject, const Configuration& c, const Configuration& reference) {
  nlohmann::json out = benchmarks::described(c.options);
  out["name"] = c.name;
  out["setting"] = name_of(c.setting);
  for (std::size_t k = 0; k < subject.quantities.size(); ++k) {
    const Quantity& q = subject.quantities[k];
    out[q.key] = as_json(estimate(values(c, k)));
    if (q.compared) out[std::string(q.key) + "_difference"] = as_json(relative_difference(c, reference, k));
  }
  return out;
}

std::string plus_minus(const nlohmann::json& e, double scale, int digits) {
  char text[64];
  const double mean = scale * e.at("mean").get<double>();
  if (e.at("half_width").is_null())
    std::snprintf(text, sizeof text, "%.*f  ", digits, mean);  // one seed has no interval
  else
    std::snprintf(text, sizeof text, "%.*f ± %.*f", digits, mean, digits,
                  scale * e.at("half_width").get<double>());
  return text;
}

void print_table(const Subject& subject, const nlohmann::json& j) {
  std::printf(
      "rolling resistance %g, spinning %g; %d seeds; means with 95 %% intervals over seeds; differences from "
      "the reference\n%-9s %-16s",
      j.at("rolling").get<double>(), j.at("spinning").get<double>(), j.at("seeds").get<int>(), "", "setting");
  for (const Quantity& q : subject.quantities) {
    std::printf(" %18s", q.title);
    if (q.compared) std::printf(" %18s", "difference %");
  }
  std::printf("\n");
  for (const nlohmann::json& c : j.at("configurations")) {
    std::printf("%-9s %-16s", c.at("name").get<std::string>().c_str(),
                c.at("setting").get<std::string>().c_str());
    for (const Quantity& q : subject.quantities) {  // ± takes two bytes
      std::printf(" %19s", plus_minus(c.at(q.key), q.scale, q.digits).c_str());
      if (q.compared)
        std::printf(" %19s", plus_minus(c.at(std::string(q.key) + "_difference"), 100, 1).c_str());
    }
    std::printf("\n");
  }
}

int run(const Settings& s) {
  engine::loading::Scenario scenario;
  if (loads(s)) {
    scenario = engine::loading::lh621_in_a_drift();
    scenario.materials = with_resistance(scenario.materials, s.material.rolling, s.material.spinning);
    scenario.strategy.alpha = s.alpha;
  }
  const Subject subject = !loads(s)           ? blade(s)
                          : s.windows.empty() ? cycle(s, scenario)
                                              : windows(s, scenario);
  std::vector<Configuration> all = configurations(s, scenario.world);
  each_seed(s.seeds, s.jobs, [&](int seed) { run_seed(subject, seed, all); });
  nlohmann::json out{{"seeds", s.seeds},
                     {"rolling", s.material.rolling},
                     {"spinning", s.material.spinning},
                     {"configurations", nlohmann::json::array()}};
  if (!loads(s)) out["rocks"] = s.rocks;
  for (const Configuration& c : all) out["configurations"].push_back(described(subject, c, all.front()));
  return show(out, s.json, [&](const nlohmann::json& j) { print_table(subject, j); });
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "accuracy_study");
  auto* rocks = app.add_option("--rocks", s.rocks, "number of rocks")
                    ->check(between(1, 100'000, "", "200 to 500 are usual"))
                    ->capture_default_str();
  app.add_option("--cycle", s.cycle, "study loading cycles instead; where their piles are kept")
      ->excludes(rocks);
  app.add_option("--windows", s.windows, "study windows of loading cycles; where their piles are kept")
      ->excludes(rocks)
      ->excludes("--cycle");
  app.add_option("--length", s.window.length, "of a window [s]")
      ->check(between(0.05, 5, "s", "chaos parts the runs after about a second"))
      ->capture_default_str();
  app.add_option("--interval", s.window.interval, "between windows [s]")
      ->check(between(0.05, 5, "s", "0.2 is usual"))
      ->capture_default_str();
  app.add_option("--alpha", s.alpha,
                 "of the strategy of loading cycles: penetration, as a share of the bucket's fill")
      ->check(between(0.2, 2, "", ""))
      ->capture_default_str();
  app.add_option("--seeds", s.seeds, "number of piles, seeds 1, 2, ...")
      ->check(between(1, 1000, "", "2 and more give intervals"))
      ->capture_default_str();
  app.add_option("--settings", s.tried, "settings to try, with commas between")
      ->delimiter(',')
      ->check(taken_by(setting_of))
      ->capture_default_str();
  app.add_option("--reference", s.reference, "setting of the reference")
      ->check(taken_by(setting_of))
      ->capture_default_str();
  app.add_option("--reference-method", s.reference_method,
                 "sequential: double precision; batched: a tenth of the time, to 1e-6 of the load")
      ->check(CLI::IsMember({"sequential", "batched"}))
      ->capture_default_str();
  app.add_option("--jobs", s.jobs, "seeds at a time; more than one makes the times less sure")
      ->check(between(1, 256, "", "no more than there are cores"))
      ->capture_default_str();
  add_method_flags(app, s.engine);
  add_material_flags(app, s.material);
  add_json_flag(app, s.json);
  return run_command(app, argc, argv, [&] {
    if (loads(s)) take_mine_materials(app, s.material);
    return run(s);
  });
}
