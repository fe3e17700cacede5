// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// fidelity_table: is it worth to spend half of the time on cheap runs? See the help text.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/benchmarks/toolkit/cpu_time.hpp>
#include <drawpoint/benchmarks/toolkit/median.hpp>
#include <drawpoint/benchmarks/toolkit/table_options.hpp>
#include <drawpoint/benchmarks/toolkit/unit_box.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/fit_fidelities.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/fidelity_functions.hpp>
#include <exception>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace drawpoint;
using benchmarks::median;
using benchmarks::unit_box;
using namespace drawpoint::kriging;

constexpr const char* help =
    R"(Fits the pairs of tests/kriging/fidelity_functions.hpp at equal cost, a true run costing as much as ten
cheap ones, and says how far predictions of the true response are off at 1000 new points.

  fidelity_table
  fidelity_table --functions borehole8,park4a --budgets 20 --designs apart
  fidelity_table --budgets 40 --noise 0.05

One row per pair, budget in true runs, design and way; NRMSE, the root mean square error over the range of the
true response, median and worst of the seeds; the per cent of the new points within the central 50 and 95 %
intervals (median; with noise, of new noisy runs); CPU seconds per fit; and rho, median.

Ways: `all true`, Kriging with the whole budget in true runs; `half`, Kriging of half as many true runs alone;
`co-Kriging`, these and cheap runs for the other half of the budget; `chosen`, what choose_fidelities takes of
`half` and `co-Kriging`, and in the last column how often that is co-Kriging.

Designs: `nested`, true runs at cheap ones; `apart`, a Latin hypercube of their own.)";

struct Settings {
  std::vector<std::string> functions, designs{"nested", "apart"};
  std::vector<int> budgets{20, 40, 80};
  int seeds = 11;
  double noise = 0, power = FitOptions{}.nugget_power;
};

Eigen::MatrixXd latin(int variables, int runs, doe::Seed seed) {
  return doe::optimized_latin_hypercube(unit_box(variables), runs, {.seed = seed});
}

/// For each row of `wanted` the nearest row of `all` that is not taken yet.
Eigen::MatrixXd nearest_of(const Eigen::MatrixXd& all, const Eigen::MatrixXd& wanted) {
  Eigen::MatrixXd rows = wanted;
  std::vector<bool> taken(static_cast<std::size_t>(all.rows()), false);
  for (Eigen::Index i = 0; i < wanted.rows(); ++i) {
    Eigen::Index best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < all.rows(); ++j) {
      const double distance = (all.row(j) - wanted.row(i)).squaredNorm();
      if (taken[static_cast<std::size_t>(j)] || !(distance < least)) continue;
      best = j;
      least = distance;
    }
    taken[static_cast<std::size_t>(best)] = true;
    rows.row(i) = all.row(best);
  }
  return rows;
}

Eigen::VectorXd noisy(Eigen::VectorXd y, double deviation, doe::Seed seed) {
  doe::RandomStream random(seed);
  for (double& value : y) value += deviation * random.normal();
  return y;
}

double deviation(const Eigen::VectorXd& y) { return std::sqrt((y.array() - y.mean()).square().mean()); }

struct Row {
  std::vector<double> nrmse, coverage50, coverage95, seconds, rho;
  int taken = 0;
};

struct Case {
  Eigen::MatrixXd all, cheap, truth, points;
  Eigen::VectorXd y_all, y_cheap, y_true, values, observed;
};

Case make_case(const reference::FidelityPair& pair, int budget, bool nested, doe::Seed seed, double share) {
  Case c;
  c.points = reference::design(1000, pair.variables, 1000 + seed);
  c.values = reference::values(pair.truth, c.points);
  const double noise = share * deviation(c.values);
  c.all = latin(pair.variables, budget, seed);
  c.cheap = latin(pair.variables, 5 * budget, 100 + seed);
  c.truth = latin(pair.variables, budget / 2, 200 + seed);
  if (nested) c.truth = nearest_of(c.cheap, c.truth);
  c.y_all = noisy(reference::values(pair.truth, c.all), noise, 2000 + seed);
  c.y_true = noisy(reference::values(pair.truth, c.truth), noise, 3000 + seed);
  c.observed = noisy(c.values, noise, 4000 + seed);
  c.y_cheap = reference::values(pair.cheap, c.cheap);
  c.y_cheap = noisy(c.y_cheap, share * deviation(c.y_cheap), 5000 + seed);
  return c;
}

template <class S>
void add(Row& row, const Case& c, const S& model, double seconds) {
  const Validation v = validate(model, c.points, c.observed);
  const double range = c.values.maxCoeff() - c.values.minCoeff();
  row.nrmse.push_back(
      std::sqrt((v.predicted - c.values).squaredNorm() / static_cast<double>(c.values.size())) / range);
  row.coverage50.push_back(100.0 * score(v, ErrorFunction::coverage, 0.5));
  row.coverage95.push_back(100.0 * score(v, ErrorFunction::coverage, 0.95));
  row.seconds.push_back(seconds);
}

void print(const std::string& place, const std::string& way, const Row& row) {
  std::printf("%s %-10s %9.5f %9.5f  %5.1f %5.1f  %7.3f", place.c_str(), way.c_str(), median(row.nrmse),
              *std::max_element(row.nrmse.begin(), row.nrmse.end()), median(row.coverage50),
              median(row.coverage95), median(row.seconds));
  if (!row.rho.empty()) std::printf("  %8.3f", median(row.rho));
  if (way == "chosen") std::printf("  %8d", row.taken);
  std::printf("\n");
  std::fflush(stdout);
}

void measure(const Settings& settings, const reference::FidelityPair& pair, int budget,
             const std::string& design) {
  Row all, half, cokriging, chosen;
  FitOptions options;
  options.nugget_power = settings.power;
  for (int seed = 1; seed <= settings.seeds; ++seed) {
    const Case c = make_case(pair, budget, design == "nested", static_cast<doe::Seed>(seed), settings.noise);
    double start = benchmarks::cpu_seconds();
    const auto seconds = [&] {
      const double now = benchmarks::cpu_seconds(), spent = now - start;
      start = now;
      return spent;
    };
    const Model of_all = fit(c.all, c.y_all, options);
    add(all, c, of_all, seconds());
    start = benchmarks::cpu_seconds();
    const Model of_half = fit(c.truth, c.y_true, options);
    add(half, c, of_half, seconds());
    const std::vector<FidelityLevel> levels{{"cheap", c.cheap, c.y_cheap, options},
                                            {"true", c.truth, c.y_true, options}};
    start = benchmarks::cpu_seconds();
    const FidelityModel model = fit_fidelities(levels, {.compare = false});
    add(cokriging, c, model, seconds());
    cokriging.rho.push_back(model.report().levels[1].rho.size() ? model.report().levels[1].rho[0] : 0.0);
    start = benchmarks::cpu_seconds();
    const FidelityChoice choice = choose_fidelities(levels);
    add(chosen, c, choice.model, seconds());
    chosen.taken += choice.cokriging ? 1 : 0;
  }
  char place[64];
  std::snprintf(place, sizeof place, "%-10s %4d %-6s", pair.name.c_str(), budget, design.c_str());
  print(place, "all true", all);
  print(place, "half", half);
  print(place, "co-Kriging", cokriging);
  print(place, "chosen", chosen);
}

Settings settings_of(int argc, char** argv) {
  Settings settings;
  std::vector<std::string> names;
  for (const reference::FidelityPair& pair : reference::fidelity_pairs()) names.push_back(pair.name);
  CLI::App app(help);
  benchmarks::add_functions(app, settings.functions, names);
  app.add_option("--designs", settings.designs, "with commas between")
      ->delimiter(',')
      ->check(CLI::IsMember({"nested", "apart"}))
      ->capture_default_str();
  app.add_option("--budgets", settings.budgets, "in true runs")
      ->delimiter(',')
      ->check(CLI::Range(6, 1000))
      ->capture_default_str();
  app.add_option("--seeds", settings.seeds, "designs of each kind")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--noise", settings.noise, "of both levels, over the standard deviation of the response")
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--nugget-power", settings.power, "of all fits (FitOptions)")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  benchmarks::parse_or_exit(app, argc, argv);
  if (settings.functions.empty()) settings.functions = names;
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  const Settings settings = settings_of(argc, argv);
  try {
    std::printf("%-10s %4s %-6s %-10s %9s %9s  %5s %5s  %7s  %8s\n", "pair", "cost", "design", "way", "NRMSE",
                "worst", "50 %", "95 %", "CPU s", "rho/taken");
    for (const reference::FidelityPair& pair : reference::fidelity_pairs())
      if (std::find(settings.functions.begin(), settings.functions.end(), pair.name) !=
          settings.functions.end())
        for (const int budget : settings.budgets)
          for (const std::string& design : settings.designs) measure(settings, pair, budget, design);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
