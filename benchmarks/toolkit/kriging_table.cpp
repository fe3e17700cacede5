// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Fits by maximum likelihood of the three reference functions: CPU seconds, likelihood, error and predictions per
// second.
//
//   kriging_table [--threads N] [--seeds N] [RUNS...]      default: one thread, 11 seeds at 100 runs,
//                                                          RUNS 100 500
//
// One row per function and number of runs. `LL` is of the standardised response, the worst of all seeds;
// `best known` is that of a multistart search in another program (tests/kriging/reference_regression.cpp).
// CPU seconds are those of the whole fit, the least of the seeds (of three repeats beyond 100 runs,
// one at 2000), on all threads together; wall seconds likewise. NRMSE is of 2000 test points, the largest of
// the seeds. Rates are of 2000 points, the best of five.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <drawpoint/benchmarks/toolkit/cpu_time.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <limits>
#include <string>
#include <vector>

using namespace drawpoint::kriging;
using drawpoint::benchmarks::cpu_seconds;

namespace {

struct Known {
  const char* name;
  int runs;
  double likelihood, nrmse;
};

constexpr Known known[] = {{"branin4", 100, -10.60608, .020796},  {"ishigami4", 100, -62.56294, .046792},
                           {"noisy4", 100, -39.23093, .021001},   {"branin4", 500, 1692.798, 2.10e-4},
                           {"ishigami4", 500, 1172.880, 1.15e-3}, {"noisy4", 500, 10.67262, .010411},
                           {"branin4", 2000, 13531.7, 2.82e-5},   {"ishigami4", 2000, 12166.9, 9.97e-5},
                           {"noisy4", 2000, 198.63849, .0058457}};

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class F>
double points_per_second(const F& predict) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5; ++i) {
    const double start = cpu_seconds();
    predict();
    least = std::min(least, cpu_seconds() - start);
  }
  return 2000.0 / least;
}

struct Row {
  double cpu = std::numeric_limits<double>::infinity(), wall = cpu, likelihood = cpu, nrmse = 0;
  double mean_rate = 0, variance_rate = 0;
  int agreed = 1 << 30, tried = 0, evaluations = 0;
};

void add_fit(const Known& c, int threads, drawpoint::doe::Seed seed, Row& row) {
  const reference::Data data = reference::training(c.name, c.runs), test = reference::testing(c.name);
  FitOptions options;
  options.seed = seed;
  options.threads = threads;
  options.estimation = Estimation::maximum_likelihood;
  const double cpu = cpu_seconds(), wall = wall_seconds();
  const Model model = fit(data.X, data.y, options);
  row.cpu = std::min(row.cpu, cpu_seconds() - cpu);
  row.wall = std::min(row.wall, wall_seconds() - wall);
  row.likelihood =
      std::min(row.likelihood, model.log_likelihood() + c.runs * std::log(reference::deviation(data.y)));
  row.nrmse = std::max(row.nrmse, validate(model, test.X, test.y).nrmse);
  row.agreed = std::min(row.agreed, model.report().starts_agreed);
  row.tried = model.report().starts_tried;
  row.evaluations = std::max(row.evaluations, model.report().evaluations);
  if (row.mean_rate > 0) return;
  row.mean_rate = points_per_second([&] { return model.mean(test.X).sum(); });
  row.variance_rate = points_per_second([&] { return model.predict(test.X).variance.sum(); });
}

void print_row(const Known& c, int seeds, int threads) {
  const int repeats = c.runs <= 100 ? seeds : c.runs < 2000 ? 3 : 1;
  Row row;
  for (int seed = 1; seed <= repeats; ++seed)
    add_fit(c, threads, static_cast<drawpoint::doe::Seed>(seed), row);
  std::printf("%-9s %5d %5d %8.3f %8.3f %12.5f %12.5f %10.3e %10.3e %4d/%d %6d %9.0f %9.0f\n", c.name, c.runs,
              repeats, row.cpu, row.wall, row.likelihood, c.likelihood, row.nrmse, c.nrmse, row.agreed,
              row.tried, row.evaluations, row.mean_rate, row.variance_rate);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  int threads = 1, seeds = 11;
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool takes_value = word == "--threads" || word == "--seeds";
    const int value = std::atoi(argv[takes_value && i + 1 < argc ? ++i : i]);
    if (value < 1) {
      std::fprintf(
          stderr,
          "kriging_table: \"%s\" is not understood; allowed are --threads N, --seeds N and the numbers of "
          "runs 100, 500, 2000\n",
          word.c_str());
      return 2;
    }
    if (word == "--threads")
      threads = value;
    else if (word == "--seeds")
      seeds = value;
    else
      sizes.push_back(value);
  }
  if (sizes.empty()) sizes = {100, 500};
  std::printf("%-9s %5s %5s %8s %8s %12s %12s %10s %10s %6s %6s %9s %9s\n", "function", "runs", "fits",
              "CPU s", "wall s", "LL worst", "best known", "NRMSE", "listed", "agreed", "evals", "mean/s",
              "mean+var/s");
  for (const int size : sizes)
    for (const Known& c : known)
      if (c.runs == size) print_row(c, seeds, threads);
}
