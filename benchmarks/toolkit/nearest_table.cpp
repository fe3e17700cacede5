// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Kriging of many runs by their nearest ones beside exact Kriging: time, memory, error, intervals.
//
//   nearest_table [--threads N] [--functions circuit6,...] [--exact-up-to N] [RUNS...]
//                                       default: two threads, all functions, exact up to 2000,
//                                       RUNS 1000 2000 4000 16000 50000
//
// Random Latin hypercubes; circuit6, waves6 and hartmann6 are exact simulators, fitted as such; noisy6 is
// circuit6 with normal noise of a twentieth of its range. Errors are root mean squares of the latent mean at
// 20 000 random points (2000 for exact Kriging), over the range there; `held` is the share of these inside of
// the 95 % intervals. Times of predictions are of 100 000 points with variances (2000, times 50). Each row is
// a process of its own, whose peak of resident memory is told.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <drawpoint/benchmarks/toolkit/cpu_time.hpp>
#include <drawpoint/benchmarks/toolkit/table_options.hpp>
#include <drawpoint/kriging/fit_nearest.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <functional>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using drawpoint::benchmarks::cpu_seconds;

namespace {

double waves6(const Eigen::VectorXd& x) {
  return std::sin(2 * x[0] + x[1]) + std::exp(-x[2] * x[3]) + 0.5 * std::cos(3 * x[4]) * x[5];
}

struct Function {
  std::string name;
  double (*value)(const Eigen::VectorXd&);
  double noise;  // of the range
};

const std::vector<Function> functions{{"circuit6", reference::circuit6, 0},
                                      {"waves6", waves6, 0},
                                      {"hartmann6", reference::hartmann6, 0},
                                      {"noisy6", reference::circuit6, 0.05}};

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double range_of(const Eigen::VectorXd& y) { return y.maxCoeff() - y.minCoeff(); }

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

struct Job {
  const Function& function;
  int runs, threads;
  bool exact;
};

void print_row(const Job& job, const AnySurrogate& model, double cpu, double wall) {
  const int count = job.exact ? 2000 : 100000;
  const Eigen::MatrixXd points = reference::design(count, 6, 999);
  const double before_cpu = cpu_seconds(), before = wall_seconds();
  const Prediction p = model.predict(points);
  const double scale = 100000.0 / count, after_cpu = cpu_seconds() - before_cpu,
               after = wall_seconds() - before;
  const int scored = std::min(count, 20000);
  const Eigen::VectorXd truth = reference::values(job.function.value, points.topRows(scored));
  const Eigen::VectorXd miss = p.mean.head(scored) - truth;
  const double held =
      (miss.array().abs() <= 1.96 * p.variance.head(scored).array().sqrt()).cast<double>().mean();
  const auto* nearest = model.as<NearestModel>();
  const double told = nearest ? nearest->error().mean / range_of(truth) : 0.0;
  std::printf("%s,%d,%s,%.2f,%.2f,%.0f,%.2f,%.2f,%.2g,%.2g,%.1f,%s\n", job.function.name.c_str(), job.runs,
              job.exact ? "exact" : "nearest", cpu, wall, peak_megabytes(), scale * after_cpu, scale * after,
              std::sqrt(miss.squaredNorm() / scored) / range_of(truth), told, 100.0 * held,
              std::string(to_string(*model.status())).c_str());
}

void run_job(const Job& job) {
  const Eigen::MatrixXd X = reference::design(job.runs, 6, 1000 + static_cast<doe::Seed>(job.runs));
  Eigen::VectorXd y = reference::values(job.function.value, X);
  doe::RandomStream random(7);
  const double deviation = job.function.noise * range_of(y);
  if (deviation > 0)
    for (double& value : y) value += deviation * random.normal();
  FitOptions options;
  options.threads = job.threads;
  options.noise = deviation > 0 ? Noise::nugget : Noise::none;
  const double cpu = cpu_seconds(), wall = wall_seconds();
  const AnySurrogate model = fit_any(X, y, options, {.exact_up_to = job.exact ? job.runs : 0});
  print_row(job, model, cpu_seconds() - cpu, wall_seconds() - wall);
}

// In a process of its own.
bool run_apart(const Job& job) {
  const pid_t child = fork();
  if (child == 0) {
    run_job(job);
    std::fflush(stdout);
    _exit(0);
  }
  int status = 1;
  return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Kriging of many runs by their nearest ones beside exact Kriging");
  std::vector<std::string> chosen, names;
  for (const Function& f : functions) names.push_back(f.name);
  int threads = 2, exact_up_to = 2000;
  std::vector<int> runs{1000, 2000, 4000, 16000, 50000};
  drawpoint::benchmarks::add_functions(app, chosen, names);
  app.add_option("--threads", threads, "of fits and predictions")->check(CLI::Range(1, 64));
  app.add_option("--exact-up-to", exact_up_to, "runs of exact Kriging")->check(CLI::NonNegativeNumber);
  app.add_option("runs", runs, "of the designs")->check(CLI::Range(10, 1000000));
  drawpoint::benchmarks::parse_or_exit(app, argc, argv);
  std::puts(
      "function,runs,kind,CPU time of the fit [s],wall time of the fit [s],peak memory [MB],CPU time of 100 "
      "000 "
      "predictions [s],wall time of these [s],RMSE over range [1],change by twice the runs [1],held by 95 % "
      "[%],"
      "status");
  std::fflush(stdout);
  bool good = true;
  for (const Function& f : functions)
    for (const int n : runs)
      for (const bool exact : {true, false})
        if ((chosen.empty() || std::find(chosen.begin(), chosen.end(), f.name) != chosen.end()) &&
            (!exact || n <= exact_up_to))
          good = run_apart({f, n, threads, exact}) && good;
  return good ? 0 : 1;
}
