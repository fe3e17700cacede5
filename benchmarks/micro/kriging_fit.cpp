// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Default fits and predictions on the reference cases of four inputs: CPU seconds, with the likelihood that
// was reached.
//
// A fit without its likelihood says nothing, so `LL` (standardised response) and `evaluations` are counters
// of each line; best known at n = 100: branin4 -10.606, ishigami4 -62.563, noisy4 -39.231; noisy4 at n =
// 500: 10.673. Predictions are of 2000 points; `points/s` is their rate.

#include <benchmark/benchmark.h>

#include <cmath>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <string>

using namespace drawpoint::kriging;

namespace {

void fit_case(benchmark::State& state, const std::string& name, int runs) {
  const reference::Data data = reference::training(name, runs);
  FitOptions options;
  options.threads = 0;
  options.estimation = Estimation::maximum_likelihood;
  double likelihood = 0;
  int evaluations = 0;
  for (auto _ : state) {
    const Model model = fit(data.X, data.y, options);
    likelihood = model.log_likelihood() + runs * std::log(reference::deviation(data.y));
    evaluations = model.report().evaluations;
  }
  state.counters["LL"] = likelihood;
  state.counters["evaluations"] = evaluations;
}

// Near the maximum of noisy4 at n = 500, without the search.
Model model_of_500() {
  const reference::Data data = reference::training("noisy4", 500);
  FitOptions options;
  options.theta_lower = options.theta_upper = 0.1;
  options.nugget_lower = options.nugget_upper = 4e-4;
  options.threads = 0;
  return fit(data.X, data.y, options);
}

void predict_mean(benchmark::State& state) {
  const Model model = model_of_500();
  const Eigen::MatrixXd X = reference::design(2000, 4, 999);
  for (auto _ : state) benchmark::DoNotOptimize(model.mean(X).sum());
  state.counters["points/s"] = benchmark::Counter(2000, benchmark::Counter::kIsIterationInvariantRate);
}

void predict_mean_and_variance(benchmark::State& state) {
  const Model model = model_of_500();
  const Eigen::MatrixXd X = reference::design(2000, 4, 999);
  for (auto _ : state) benchmark::DoNotOptimize(model.predict(X).variance.sum());
  state.counters["points/s"] = benchmark::Counter(2000, benchmark::Counter::kIsIterationInvariantRate);
}

void likelihood_parts(benchmark::State& state, int part) {
  const reference::Data data = reference::training("noisy4", static_cast<int>(state.range(0)));
  Likelihood likelihood(2.0 * data.X.array() - 1.0, reference::standardized(data.y));
  Eigen::VectorXd p = Eigen::VectorXd::Constant(5, -2.0);
  for (auto _ : state) {
    p[0] += 1e-9;  // a new point, or the factorisation would be remembered
    if (part == 0) benchmark::DoNotOptimize(likelihood.value(p));
    if (part == 1) benchmark::DoNotOptimize(likelihood.gradient(p).sum());
    if (part == 2) benchmark::DoNotOptimize(likelihood.hessian(p).sum());
  }
}

}  // namespace

BENCHMARK_CAPTURE(fit_case, branin4_100, "branin4", 100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit_case, ishigami4_100, "ishigami4", 100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit_case, noisy4_100, "noisy4", 100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit_case, branin4_500, "branin4", 500)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(fit_case, ishigami4_500, "ishigami4", 500)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(fit_case, noisy4_500, "noisy4", 500)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(predict_mean)->Unit(benchmark::kMillisecond);
BENCHMARK(predict_mean_and_variance)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(likelihood_parts, value, 0)->Arg(100)->Arg(500)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(likelihood_parts, gradient, 1)->Arg(100)->Arg(500)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(likelihood_parts, hessian, 2)->Arg(100)->Arg(500)->Unit(benchmark::kMillisecond);
