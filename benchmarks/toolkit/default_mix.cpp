// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// default_mix: are adaptive runs as a study makes them by default ever worse than a plan? See the help text.

#include <drawpoint/studies/model/fits/tables.h>
#include <drawpoint/studies/model/sampling/adaptive.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/benchmarks/toolkit/median.hpp>
#include <drawpoint/benchmarks/toolkit/table_options.hpp>
#include <drawpoint/benchmarks/toolkit/unit_box.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/bumpy_functions.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace drawpoint;
using benchmarks::median;
using benchmarks::unit_box;
using kriging::reference::TestFunction;

constexpr const char* help =
    R"(Compares adaptive runs, as `run --runs FIRST --adaptive ...` of a study makes them (by default 0.4
LOLA-Voronoi + 0.4 Voronoi + 0.2 error, batches of 8), with designs of as many runs planned at once, on the functions of
tests/kriging/test_functions.hpp, and peaks2 and ring2 of bumpy_functions.hpp.

  default_mix
  default_mix --criteria lola_voronoi=0.7,error=0.3 --first 24
  default_mix --functions franke2,branin4 --runs 60 --seeds 5

One row per function and number of runs: NRMSE of a default kriging::fit to the runs, against the function
without noise at 4000 Sobol' points, over its range there; medians over the seeds. Designs: `latin`, random Latin
hypercubes; `maximin`, optimised; `planned`, the first design of a study, maximin with corners where these are
two fifths of the runs or less; `sobol`, scrambled. `ratio`: adaptive over the best of the four.)";

const std::vector<std::string> plans{"latin", "maximin", "planned", "sobol"};

struct Settings {
  std::vector<std::string> functions;
  std::vector<int> runs{60, 120};
  std::string criteria = studies::Sampling().criteria;
  int first = 36, seeds = 11;
};

std::vector<TestFunction> functions() {
  std::vector<TestFunction> all = kriging::reference::test_functions();
  all.push_back({"peaks2", 2, 0, [](const Eigen::VectorXd& u, doe::Seed) {
                   return kriging::reference::peaks((10 * u.array() - 5).matrix());
                 }});
  all.push_back({"ring2", 2, 0, [](const Eigen::VectorXd& u, doe::Seed) {
                   return kriging::reference::ring((4 * u.array() - 2).matrix());
                 }});
  return all;
}

/// A function as a simulator: the same place with the same seed gives the same value.
struct Simulator {
  const TestFunction& function;
  doe::Problem problem;
  doe::Seed draw;

  double truth(const Eigen::VectorXd& x) const { return function.value(x, draw); }
  double observed(const Eigen::VectorXd& x, doe::Seed seed) const {
    return truth(x) + (function.noise > 0 ? function.noise * doe::RandomStream(seed).normal() : 0.0);
  }
};

/// Of a default fit to these runs.
double error(const Simulator& simulator, const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  const Eigen::MatrixXd Z = doe::scrambled_sobol(simulator.problem, 4000, {.seed = 4711});
  const Eigen::VectorXd truth =
      kriging::reference::values([&](const Eigen::VectorXd& x) { return simulator.truth(x); }, Z);
  const double range = truth.maxCoeff() - truth.minCoeff(),
               unit = range > 0 ? range : simulator.function.noise;
  return std::sqrt((kriging::fit(X, y).mean(Z) - truth).squaredNorm() / 4000.0) / unit;
}

Eigen::MatrixXd planned_at_once(const std::string& plan, const studies::Identity& identity, int runs) {
  if (plan == "planned") return studies::first_design(identity, runs);
  if (plan == "sobol") return doe::scrambled_sobol(identity.problem, runs, {.seed = identity.seed});
  if (plan == "latin")
    return kriging::reference::design(runs, static_cast<int>(identity.problem.variables.size()),
                                      identity.seed);
  return doe::optimized_latin_hypercube(identity.problem, runs, {.seed = identity.seed});
}

double error_of_plan(const Simulator& simulator, const std::string& plan, const studies::Identity& identity,
                     int runs) {
  const Eigen::MatrixXd X = planned_at_once(plan, identity, runs);
  Eigen::VectorXd y(runs);
  for (Eigen::Index i = 0; i < runs; ++i)
    y[i] = simulator.observed(X.row(i).transpose(), identity.seed * 100'000 + static_cast<doe::Seed>(i));
  return error(simulator, X, y);
}

void simulate(const Simulator& simulator, std::vector<studies::Run>& runs) {
  for (studies::Run& run : runs) {
    run.y = Eigen::VectorXd::Constant(1, simulator.observed(run.x, run.seed));
    run.status = studies::Status::done;
  }
}

/// NRMSE by the number of runs.
std::map<int, double> errors_of_study(const Simulator& simulator, const studies::Identity& identity,
                                      const Settings& settings) {
  std::vector<studies::Run> runs = studies::runs_to_add(identity, {}, settings.first, 0);
  simulate(simulator, runs);
  std::map<int, double> errors;
  for (const int wanted : settings.runs) {
    const studies::Sampling sampling{.points = wanted - settings.first, .criteria = settings.criteria};
    while (static_cast<int>(runs.size()) < wanted) {
      studies::Batch batch = studies::next_batch(identity, sampling, runs);
      if (batch.status != studies::BatchStatus::planned)
        throw std::runtime_error("default_mix: " + batch.message);
      simulate(simulator, batch.runs);
      runs.insert(runs.end(), batch.runs.begin(), batch.runs.end());
    }
    const doe::Evaluations table = studies::tables_of(runs, identity.problem).training;
    errors[wanted] = error(simulator, table.X(), table.y("y"));
  }
  return errors;
}

void compare(const TestFunction& f, const Settings& settings) {
  std::map<int, std::map<std::string, std::vector<double>>> errors;
  for (int s = 1; s <= settings.seeds; ++s) {
    const auto seed = static_cast<doe::Seed>(s);
    const Simulator simulator{f, unit_box(f.variables), seed};
    studies::Identity identity{.study = f.name, .problem = simulator.problem, .seed = seed};
    for (const int runs : settings.runs) {
      identity.corners = studies::has_corners(identity.problem, runs);
      for (const std::string& plan : plans)
        errors[runs][plan].push_back(error_of_plan(simulator, plan, identity, runs));
    }
    identity.corners = studies::has_corners(identity.problem, settings.first);
    for (const auto& [runs, value] : errors_of_study(simulator, identity, settings))
      errors[runs]["adaptive"].push_back(value);
  }
  for (const auto& [runs, by_plan] : errors) {
    std::printf("%-12s %4d", f.name.c_str(), runs);
    double best = INFINITY;
    for (const std::string& plan : plans) {
      best = std::min(best, median(by_plan.at(plan)));
      std::printf(" %9.5f", median(by_plan.at(plan)));
    }
    const double adaptive = median(by_plan.at("adaptive"));
    std::printf(" %9.5f %7.2f\n", adaptive, adaptive / best);
  }
  std::fflush(stdout);
}

Settings settings_of(int argc, char** argv) {
  Settings settings;
  std::vector<std::string> names;
  for (const TestFunction& f : functions()) names.push_back(f.name);
  CLI::App app(help);
  benchmarks::add_functions(app, settings.functions, names);
  app.add_option("--runs", settings.runs, "in all, rising")
      ->delimiter(',')
      ->check(CLI::Range(20, 1000))
      ->capture_default_str();
  app.add_option("--criteria", settings.criteria, "as of a study")->capture_default_str();
  app.add_option("--first", settings.first, "runs of the first design of a study")
      ->check(CLI::Range(10, 1000))
      ->capture_default_str();
  app.add_option("--seeds", settings.seeds, "studies and designs of each kind")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  benchmarks::parse_or_exit(app, argc, argv);
  if (settings.functions.empty()) settings.functions = names;
  std::sort(settings.runs.begin(), settings.runs.end());
  if (settings.first >= settings.runs.front()) {
    std::fprintf(stderr, "default_mix: --first is %d; allowed is less than --runs, %d\n", settings.first,
                 settings.runs.front());
    std::exit(2);
  }
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  const Settings settings = settings_of(argc, argv);
  try {
    std::printf("%-12s %4s", "function", "runs");
    for (const std::string& plan : plans) std::printf(" %9s", plan.c_str());
    std::printf(" %9s %7s\n", "adaptive", "ratio");
    for (const TestFunction& f : functions())
      if (std::find(settings.functions.begin(), settings.functions.end(), f.name) != settings.functions.end())
        compare(f, settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
