// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "accuracy_run.hpp"
#include "estimate.hpp"

/// Accuracy against cost: how far step, substeps and sweeps are from a converged run of the same pile. See
/// --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;

namespace {

constexpr const char* about =
    "Accuracy against cost on the pile of pile_scenario. Each seed is settled once; every combination of\n"
    "--dt, --substeps and --sweeps then goes on from there (0.5 s to take up the loads, 1 s at rest, 1 s of\n"
    "digging) and is compared with a reference run of a small step and very many sweeps, seed by seed. The\n"
    "second row is the reference's twin, started a micrometre off: what chaos alone does. Intervals: 95 %,\n"
    "Student's t over the seeds.\n\n"
    "  accuracy_study --rocks 200 --seeds 3 --dt 0.005,0.01 --substeps 1,4 --sweeps 5,25\n\n"
    "Fields of --json: settled overlap (mean, p99; of the smaller rock), drift at rest, drag on the blade "
    "over\n"
    "the last 0.6 s (mean; its standard error by blocks of 0.1 s, mean over seeds; 95th percentile of 10 ms\n"
    "windows), mass moved (sum of mass times displacement along the blade's way, over that way). "
    "*_difference:\n"
    "configuration minus reference over the reference's mean.";

struct Settings {
  EngineFlags engine;  // method and threads
  int rocks = 500, seeds = 5;
  std::vector<double> steps = {0.0025, 0.005, 0.01};
  std::vector<int> substeps = {1, 4}, sweeps = {5, 25, 100};
  double reference_step = 0.0025;
  int reference_sweeps = 1000;
  bool json = false;
};

struct Configuration {
  std::string name;
  engine::contact::WorldOptions options;
  double offset = 0;
  std::vector<AccuracySample> samples;  // by seed
};

std::vector<Configuration> configurations(const Settings& s) {
  auto options = world_options(s.engine);
  std::vector<Configuration> all;
  const auto add = [&](const std::string& name, double step, int substeps, int sweeps) {
    options.step = step;
    options.solver.substeps = substeps;
    options.solver.sweeps = sweeps;
    all.push_back({name, options, 0, {}});
  };
  options.solver.spare_work = 0;  // as many sweeps as are asked for, as in a pile that is too large for more
  options.solver.method = engine::contact::Method::sequential;
  for (const char* name : {"reference", "twin"}) add(name, s.reference_step, 1, s.reference_sweeps);
  all.back().offset = 1e-6;
  options.solver.method = world_options(s.engine).solver.method;
  for (const double step : s.steps)
    for (const int substeps : s.substeps)
      for (const int sweeps : s.sweeps) add("", step, substeps, sweeps);
  return all;
}

// Settles well below the errors in question: every configuration starts from the same pile.
engine::contact::WorldOptions settling_options() {
  engine::contact::WorldOptions options;
  options.step = 0.005;
  options.solver.method = engine::contact::Method::sequential;
  options.solver.substeps = 5;
  options.solver.sweeps = 10;
  return options;
}

void run_all(const Settings& s, std::vector<Configuration>& all) {
  for (int seed = 1; seed <= s.seeds; ++seed) {
    Progress progress;
    const SettledState settled =
        settled_pile(s.rocks, static_cast<std::uint64_t>(seed), settling_options(), progress);
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k].samples.push_back(accuracy_sample(settled, all[k].options, all[k].offset, progress));
      std::fprintf(stderr, "seed %d of %d, configuration %zu of %zu: drag %.1f kN\n", seed, s.seeds, k + 1,
                   all.size(), all[k].samples.back().drag / 1e3);
    }
  }
}

using Field = double AccuracySample::*;

std::vector<double> values(const Configuration& c, Field field) {
  std::vector<double> out;
  for (const AccuracySample& sample : c.samples) out.push_back(sample.*field);
  return out;
}

nlohmann::json as_json(const Estimate& e) {
  nlohmann::json out{{"mean", e.mean}};
  if (std::isfinite(e.half_width))
    out["half_width"] = e.half_width;
  else
    out["half_width"] = nullptr;
  return out;
}

// (configuration − reference) / mean of the reference
Estimate relative_difference(const Configuration& c, const Configuration& reference, Field field) {
  const double scale = mean_of(values(reference, field));
  const Estimate d = paired_difference(values(c, field), values(reference, field));
  return {d.mean / scale, d.half_width / std::abs(scale)};
}

nlohmann::json described(const Configuration& c, const Configuration& reference) {
  nlohmann::json out = benchmarks::described(c.options);
  out["name"] = c.name;
  out["ms_rest"] = percentile(values(c, &AccuracySample::ms_rest), 0.5);
  out["ms_dig"] = percentile(values(c, &AccuracySample::ms_dig), 0.5);
  out["overlap_mean"] = as_json(estimate(values(c, &AccuracySample::overlap_mean)));
  out["overlap_p99"] = as_json(estimate(values(c, &AccuracySample::overlap_p99)));
  out["dig_overlap_p99"] = as_json(estimate(values(c, &AccuracySample::dig_overlap_p99)));
  out["drift_m_s"] = as_json(estimate(values(c, &AccuracySample::drift)));
  out["drag_n"] = as_json(estimate(values(c, &AccuracySample::drag)));
  out["drag_block_error_n"] = mean_of(values(c, &AccuracySample::drag_error));
  out["drag_p95_n"] = as_json(estimate(values(c, &AccuracySample::drag_p95)));
  out["mass_moved_kg"] = as_json(estimate(values(c, &AccuracySample::mass_moved)));
  out["drag_difference"] = as_json(relative_difference(c, reference, &AccuracySample::drag));
  out["drag_p95_difference"] = as_json(relative_difference(c, reference, &AccuracySample::drag_p95));
  out["mass_moved_difference"] = as_json(relative_difference(c, reference, &AccuracySample::mass_moved));
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

void print_table(const nlohmann::json& j) {
  std::printf("%d rocks, %d seeds; means with 95 %% intervals over seeds; differences from the reference\n",
              j.at("rocks").get<int>(), j.at("seeds").get<int>());
  std::printf("%-9s %6s %4s %6s %8s %8s %18s %18s %18s %18s %18s %18s %18s\n", "", "dt ms", "sub", "sweeps",
              "ms rest", "ms dig", "overlap mean %", "overlap p99 %", "drift mm/s", "drag kN", "drag diff %",
              "p95 diff %", "moved diff %");
  for (const nlohmann::json& c : j.at("configurations")) {
    std::printf("%-9s %6g %4d %6d %8.3f %8.3f", c.at("name").get<std::string>().c_str(),
                1e3 * c.at("dt_s").get<double>(), c.at("substeps").get<int>(), c.at("sweeps").get<int>(),
                c.at("ms_rest").get<double>(), c.at("ms_dig").get<double>());
    const auto column = [&](const char* key, double scale, int digits) {
      std::printf(" %19s", plus_minus(c.at(key), scale, digits).c_str());  // ± takes two bytes
    };
    column("overlap_mean", 100, 5);
    column("overlap_p99", 100, 4);
    column("drift_m_s", 1e3, 4);
    column("drag_n", 1e-3, 1);
    column("drag_difference", 100, 1);
    column("drag_p95_difference", 100, 1);
    column("mass_moved_difference", 100, 1);
    std::printf("\n");
  }
}

int run(const Settings& s) {
  std::vector<Configuration> all = configurations(s);
  run_all(s, all);
  nlohmann::json out{{"rocks", s.rocks}, {"seeds", s.seeds}, {"configurations", nlohmann::json::array()}};
  for (const Configuration& c : all) out["configurations"].push_back(described(c, all.front()));
  if (s.json)
    std::printf("%s\n", out.dump().c_str());
  else
    print_table(out);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "accuracy_study");
  app.add_option("--rocks", s.rocks, "number of rocks")
      ->check(between(1, 100'000, "", "200 to 500 are usual"))
      ->capture_default_str();
  app.add_option("--seeds", s.seeds, "number of piles, seeds 1, 2, ...")
      ->check(between(1, 1000, "", "2 and more give intervals"))
      ->capture_default_str();
  app.add_option("--dt", s.steps, "time steps [s], with commas between")
      ->delimiter(',')
      ->check(between(1e-5, 0.01, "s", "0.0025,0.005,0.01 are usual; the drag is taken in windows of 0.01 s"))
      ->capture_default_str();
  app.add_option("--substeps", s.substeps, "substeps, with commas between")
      ->delimiter(',')
      ->check(between(1, 1000, "", "1 to 16 are usual"))
      ->capture_default_str();
  app.add_option("--sweeps", s.sweeps, "sweeps a substep, with commas between")
      ->delimiter(',')
      ->check(between(1, 1e6, "", "1 to 150 are usual"))
      ->capture_default_str();
  app.add_option("--reference-dt", s.reference_step, "time step of the reference [s]")
      ->check(between(1e-5, 0.01, "s", "half the smallest --dt or less is best"))
      ->capture_default_str();
  app.add_option("--reference-sweeps", s.reference_sweeps, "sweeps of the reference, one substep")
      ->check(between(1, 1e6, "", "1000 and more"))
      ->capture_default_str();
  add_method_flags(app, s.engine);
  app.add_flag("--json", s.json, "print one JSON object");
  return run_command(app, argc, argv, [&] { return run(s); });
}
