// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// told_noise_table: what it is worth that runs tell their own standard error. Each run is the mean of a few
/// noisy samples; fits with the noise estimated, the same everywhere, beside fits with what the runs tell
/// together, what each tells, and a model of that, and the choice among the four. Takes no options; prints a
/// table: errors over the deviation of the response, and how many of fresh runs lie within their 95 %
/// interval, where the noise is small and where it is large. A second table has what a study does, which
/// chooses among four kinds of fit before the source: with estimated noise, with pooled noise, and with pooled
/// noise and then the source that refits prefer; means over the designs, and the least share held.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <drawpoint/benchmarks/toolkit/median.hpp>
#include <drawpoint/benchmarks/toolkit/unit_box.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/noise_model.hpp>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace drawpoint;
using benchmarks::median;
using benchmarks::unit_box;
using Eigen::MatrixXd;
using Eigen::VectorXd;

using kriging::NoiseSource;

constexpr std::array sources = {NoiseSource::pooled, NoiseSource::estimated, NoiseSource::told,
                                NoiseSource::modelled};
/// Columns: the four sources, and the chosen one.
constexpr int designs = 15, fresh = 200, columns = 5;

/// On the unit box.
struct Function {
  const char* name;
  int inputs;
  double (*f)(const VectorXd&);
};

double branin(const VectorXd& u) {
  const double a = -5 + 15 * u[0], b = 15 * u[1];
  return std::pow(b - 5.1 / (4 * M_PI * M_PI) * a * a + 5 / M_PI * a - 6, 2) +
         10 * (1 - 1 / (8 * M_PI)) * std::cos(a) + 10;
}

double waves(const VectorXd& u) { return std::sin(5 * u[0]) + std::cos(4 * u[1]) * u[0]; }

/// Smooth in two inputs, weak in a third, none in the fourth.
double bowl(const VectorXd& u) {
  return std::sin(3 * u[0]) + 0.7 * u[1] * u[1] + 0.5 * u[0] * u[1] + 0.2 * u[2];
}

constexpr std::array functions = {Function{"Branin", 2, branin}, Function{"waves", 2, waves},
                                  Function{"bowl", 4, bowl},
                                  Function{"nothing", 4, [](const VectorXd&) { return 0.0; }}};

/// Deviation of the mean of a run, in deviations of the response.
struct Noise {
  const char* name;
  double (*deviation)(const VectorXd& u, int run);
};

constexpr std::array noises = {
    Noise{"0.2 everywhere", [](const VectorXd&, int) { return 0.2; }},
    Noise{"1 everywhere", [](const VectorXd&, int) { return 1.0; }},
    Noise{"0.02 to 0.6 along u0", [](const VectorXd& u, int) { return 0.02 * std::pow(30.0, u[0]); }},
    Noise{"every third run 0.6, others 0.05", [](const VectorXd&, int run) { return run % 3 ? 0.05 : 0.6; }}};

/// Runs of a response with deviation 1.
struct Runs {
  MatrixXd X;
  VectorXd y, noise_variance, deviation;
};

struct Scale {
  double mean, deviation;
};

Scale scale_of(const Function& function) {
  const MatrixXd X = doe::latin_hypercube(unit_box(function.inputs), 2000, {.seed = 1});
  VectorXd y(X.rows());
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = function.f(X.row(i));
  const double deviation = std::sqrt((y.array() - y.mean()).square().mean());
  return {y.mean(), deviation > 0 ? deviation : 1.0};
}

double truth(const Function& function, const Scale& scale, const VectorXd& u) {
  return (function.f(u) - scale.mean) / scale.deviation;
}

Runs runs_of(const Function& function, const Noise& noise, int n, int samples, doe::Seed seed) {
  const Scale scale = scale_of(function);
  doe::RandomStream random(seed);
  Runs r{doe::latin_hypercube(unit_box(function.inputs), n, {.seed = seed}), VectorXd(n), VectorXd(n),
         VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    const VectorXd u = r.X.row(i);
    r.deviation[i] = noise.deviation(u, i);
    VectorXd values(samples);
    for (double& value : values) value = r.deviation[i] * std::sqrt(samples) * random.normal();
    r.y[i] = truth(function, scale, u) + values.mean();
    r.noise_variance[i] = (values.array() - values.mean()).square().sum() / (samples - 1) / samples;
  }
  return r;
}

kriging::WayToFit way(NoiseSource source, const kriging::FitOptions& options = {}) {
  return kriging::way_with_noise(std::string(to_string(source)), kriging::Scale::linear, {}, options, source);
}

std::vector<kriging::WayToFit> ways() {
  std::vector<kriging::WayToFit> all;
  for (const NoiseSource source : sources) all.push_back(way(source));
  return all;
}

struct Result {
  double error = 0, quiet = 0, noisy = 0;  // held, of the fresh runs with less and with more noise
  double all = 0;                          // held, of all fresh runs
};

/// Of the fresh runs r, as the way has their noise.
Result judged(const kriging::WayToFit& way, const Function& function, const Runs& training, const Runs& r) {
  const Scale scale = scale_of(function);
  const kriging::TransformedModel model = way.fitter(training.X, training.y, training.noise_variance);
  const kriging::Validation v =
      way.noise ? kriging::validate(model, r.X, r.y,
                                    way.noise(training.X, training.noise_variance, r.X, r.noise_variance))
                : kriging::validate(model, r.X, r.y);
  const double middle = std::sqrt(r.deviation.minCoeff() * r.deviation.maxCoeff());
  double sum = 0;
  int held[2] = {}, all[2] = {};
  for (Eigen::Index i = 0; i < r.y.size(); ++i) {
    sum += std::pow(v.predicted[i] - truth(function, scale, r.X.row(i)), 2);
    const int side = r.deviation[i] > middle;
    ++all[side];
    held[side] += kriging::predicted_quantile(v, i, 0.025) <= r.y[i] &&
                  r.y[i] <= kriging::predicted_quantile(v, i, 0.975);
  }
  const auto share = [&](int side) { return all[side] > 0 ? 1.0 * held[side] / all[side] : std::nan(""); };
  return {std::sqrt(sum / static_cast<double>(r.y.size())), share(0), share(1),
          1.0 * (held[0] + held[1]) / static_cast<double>(r.y.size())};
}

std::string text(double share) {
  char buffer[16];
  std::snprintf(buffer, sizeof buffer, "%.0f", 100 * share);
  return std::isnan(share) ? "" : buffer;
}

void print_row(const Function& function, const Noise& noise, int n, int samples) {
  std::vector<double> error[columns], quiet[columns], noisy[columns];
  int chosen[sources.size()] = {};
  for (int design = 1; design <= designs; ++design) {
    const auto seed = static_cast<doe::Seed>(design);
    const Runs r = runs_of(function, noise, n, samples, seed);
    const Runs check = runs_of(function, noise, fresh, samples, seed + 1000);
    const auto choice =
        kriging::choose_refitted(r.X, r.y, {}, ways(), {kriging::Noise::known, r.noise_variance});
    ++chosen[choice.best];
    for (std::size_t k = 0; k < columns; ++k) {
      const Result result = judged(ways()[k < sources.size() ? k : choice.best], function, r, check);
      error[k].push_back(result.error);
      quiet[k].push_back(result.quiet);
      noisy[k].push_back(result.noisy);
    }
  }
  std::printf("| %s | %s | %d | %d |", function.name, noise.name, n, samples);
  for (const auto& errors : error) std::printf(" %.3f |", median(errors));
  for (int k = 0; k < columns; ++k)
    std::printf(" %s / %s |", text(median(quiet[k])).c_str(), text(median(noisy[k])).c_str());
  std::printf(" %d / %d / %d / %d |\n", chosen[0], chosen[1], chosen[2], chosen[3]);
  std::fflush(stdout);
}

/// All with noise from this source.
std::vector<kriging::WayToFit> kinds(NoiseSource source) {
  std::vector<kriging::WayToFit> all;
  for (const kriging::FitOptions& options : kriging::usual_kinds()) all.push_back(way(source, options));
  return all;
}

/// The best kind with estimated noise, with pooled noise, and that kind with the source that refits prefer.
std::array<kriging::WayToFit, 3> chosen_ways(const Runs& r) {
  const kriging::RunNoise noise{kriging::Noise::known, r.noise_variance};
  const auto best_kind = [&](NoiseSource source) {
    return kriging::choose_fit(r.X, r.y, {}, kinds(source), noise).best;
  };
  const std::size_t kind = best_kind(NoiseSource::pooled);
  std::vector<kriging::WayToFit> by_source;
  for (const NoiseSource source : sources) by_source.push_back(kinds(source)[kind]);
  const std::size_t source = kriging::choose_refitted(r.X, r.y, {}, by_source, noise).best;
  return {kinds(NoiseSource::estimated)[best_kind(NoiseSource::estimated)], by_source[0], by_source[source]};
}

void print_study_row(const Function& function, const Noise& noise, int n, int samples) {
  std::array<double, 3> error{}, held{}, least{1, 1, 1};
  for (int design = 1; design <= designs; ++design) {
    const auto seed = static_cast<doe::Seed>(design);
    const Runs r = runs_of(function, noise, n, samples, seed);
    const Runs check = runs_of(function, noise, fresh, samples, seed + 1000);
    const auto ways = chosen_ways(r);
    for (std::size_t k = 0; k < ways.size(); ++k) {
      const Result result = judged(ways[k], function, r, check);
      error[k] += result.error / designs;
      held[k] += result.all / designs;
      least[k] = std::min(least[k], result.all);
    }
  }
  std::printf("| %s | %s | %d | %d |", function.name, noise.name, n, samples);
  for (const double e : error) std::printf(" %.3f |", e);
  for (std::size_t k = 0; k < held.size(); ++k)
    std::printf(" %s, %s |", text(held[k]).c_str(), text(least[k]).c_str());
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main() {
  try {
    std::printf(
        "| Function | Noise of a run | Runs | Samples | Error: pooled | estimated | told | modelled | chosen "
        "| Held %%, quiet / noisy runs: pooled | estimated | told | modelled | chosen | Chosen, of %d |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        designs);
    for (const Function& function : functions)
      for (const Noise& noise : noises)
        for (const int n : {20, 60})
          for (const int samples : {2, 5, 20}) print_row(function, noise, n, samples);
    std::printf(
        "\n| Function | Noise of a run | Runs | Samples | Error, mean: estimated | pooled | pooled, then "
        "the source | Held %%, mean and least of %d: estimated | pooled | pooled, then the source |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n",
        designs);
    for (const Function& function : functions)
      for (const Noise& noise : noises)
        for (const int samples : {2, 5}) print_study_row(function, noise, 40, samples);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "told_noise_table: %s\n", e.what());
    return 1;
  }
}
