// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// told_noise_table: what it is worth that runs tell their own standard error. Each run is the mean of a few
/// noisy samples; fits with the noise estimated, the same everywhere, beside fits with what the runs tell
/// together, what each tells, that moderated by the others, and a model of that, and the choice among the five. Takes
/// no options; prints a table: errors over the deviation of the response, and how many of fresh runs lie within their
/// 95 % interval, where the noise is small and where it is large. A second table has what a study does, which chooses
/// among four kinds of fit before the source: with estimated noise, with pooled noise, and with pooled noise and then
/// the source that refits prefer, of few samples each's own word as it is and moderated; means over the designs, and
/// the least share held, and how often the model's interval of the mean holds the function.

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

/// Where noise comes from.
struct Source {
  const char* name;
  NoiseSource source;
  bool moderated = false;  ///< by the samples of a run
};

constexpr std::array sources = {
    Source{"pooled", NoiseSource::pooled}, Source{"estimated", NoiseSource::estimated},
    Source{"told", NoiseSource::told}, Source{"moderated", NoiseSource::told, true},
    Source{"modelled", NoiseSource::modelled}};
/// Columns: the sources, and the chosen one of all.
constexpr int designs = 15, fresh = 200;
constexpr std::size_t columns = sources.size() + 1;

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

kriging::WayToFit way(const Source& source, int samples, const kriging::FitOptions& options = {}) {
  return kriging::way_with_noise(source.name, kriging::Scale::linear, {}, options, source.source,
                                 source.moderated ? samples - 1.0 : kriging::exactly_known);
}

std::vector<kriging::WayToFit> ways(int samples) {
  std::vector<kriging::WayToFit> all;
  for (const Source& source : sources) all.push_back(way(source, samples));
  return all;
}

struct Result {
  double error = 0, quiet = 0, noisy = 0;  // held, of the fresh runs with less and with more noise
  double all = 0;                          // held, of all fresh runs
  double mean = 0;                         // places where the interval of the mean holds the function
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
  const VectorXd low = model.quantile(r.X, 0.025), high = model.quantile(r.X, 0.975);
  double sum = 0;
  int held[2] = {}, all[2] = {}, means = 0;
  for (Eigen::Index i = 0; i < r.y.size(); ++i) {
    const double true_mean = truth(function, scale, r.X.row(i));
    sum += std::pow(v.predicted[i] - true_mean, 2);
    means += low[i] <= true_mean && true_mean <= high[i];
    const int side = r.deviation[i] > middle;
    ++all[side];
    held[side] += kriging::predicted_quantile(v, i, 0.025) <= r.y[i] &&
                  r.y[i] <= kriging::predicted_quantile(v, i, 0.975);
  }
  const auto share = [&](int side) { return all[side] > 0 ? 1.0 * held[side] / all[side] : std::nan(""); };
  return {std::sqrt(sum / static_cast<double>(r.y.size())), share(0), share(1),
          1.0 * (held[0] + held[1]) / static_cast<double>(r.y.size()),
          1.0 * means / static_cast<double>(r.y.size())};
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
        kriging::choose_refitted(r.X, r.y, {}, ways(samples), {kriging::Noise::known, r.noise_variance});
    ++chosen[choice.best];
    for (std::size_t k = 0; k < columns; ++k) {
      const Result result = judged(ways(samples)[k < sources.size() ? k : choice.best], function, r, check);
      error[k].push_back(result.error);
      quiet[k].push_back(result.quiet);
      noisy[k].push_back(result.noisy);
    }
  }
  std::printf("| %s | %s | %d | %d |", function.name, noise.name, n, samples);
  for (const auto& errors : error) std::printf(" %.3f |", median(errors));
  for (std::size_t k = 0; k < columns; ++k)
    std::printf(" %s / %s |", text(median(quiet[k])).c_str(), text(median(noisy[k])).c_str());
  for (const int count : chosen) std::printf(" %d", count);
  std::printf(" |\n");
  std::fflush(stdout);
}

/// All with noise from this source.
std::vector<kriging::WayToFit> kinds(const Source& source, int samples) {
  std::vector<kriging::WayToFit> all;
  for (const kriging::FitOptions& options : kriging::usual_kinds())
    all.push_back(way(source, samples, options));
  return all;
}

/// The best kind with estimated noise, with pooled noise, and that kind with the source that refits prefer: of all
/// but the moderated one, of all but the one that takes each run's word as it is, and of neither.
std::array<kriging::WayToFit, 5> chosen_ways(const Runs& r, int samples) {
  const kriging::RunNoise noise{kriging::Noise::known, r.noise_variance};
  const auto best_kind = [&](const Source& source) {
    return kriging::choose_fit(r.X, r.y, {}, kinds(source, samples), noise).best;
  };
  const std::size_t kind = best_kind(sources[0]);
  const auto preferred = [&](const std::vector<std::size_t>& of) {
    std::vector<kriging::WayToFit> some;
    for (const std::size_t k : of) some.push_back(kinds(sources[k], samples)[kind]);
    return some[kriging::choose_refitted(r.X, r.y, {}, some, noise).best];
  };
  return {kinds(sources[1], samples)[best_kind(sources[1])], kinds(sources[0], samples)[kind],
          preferred({0, 1, 2, 4}), preferred({0, 1, 3, 4}), preferred({0, 1, 4})};
}

void print_study_row(const Function& function, const Noise& noise, int n, int samples) {
  std::array<double, 5> error{}, held{}, mean{}, least{1, 1, 1, 1, 1};
  for (int design = 1; design <= designs; ++design) {
    const auto seed = static_cast<doe::Seed>(design);
    const Runs r = runs_of(function, noise, n, samples, seed);
    const Runs check = runs_of(function, noise, fresh, samples, seed + 1000);
    const auto ways = chosen_ways(r, samples);
    for (std::size_t k = 0; k < ways.size(); ++k) {
      const Result result = judged(ways[k], function, r, check);
      error[k] += result.error / designs;
      held[k] += result.all / designs;
      mean[k] += result.mean / designs;
      least[k] = std::min(least[k], result.all);
    }
  }
  std::printf("| %s | %s | %d | %d |", function.name, noise.name, n, samples);
  for (const double e : error) std::printf(" %.3f |", e);
  for (std::size_t k = 0; k < held.size(); ++k)
    std::printf(" %s, %s, %s |", text(held[k]).c_str(), text(least[k]).c_str(), text(mean[k]).c_str());
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main() {
  try {
    std::printf(
        "| Function | Noise of a run | Runs | Samples | Error: pooled | estimated | told | moderated | "
        "modelled "
        "| chosen | Held %%, quiet / noisy runs: pooled | estimated | told | moderated | modelled | chosen | "
        "Chosen, "
        "of %d |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        designs);
    for (const Function& function : functions)
      for (const Noise& noise : noises)
        for (const int n : {20, 60})
          for (const int samples : {2, 5, 20}) print_row(function, noise, n, samples);
    std::printf(
        "\n| Function | Noise of a run | Runs | Samples | Error, mean: estimated | pooled | chosen with told "
        "| with "
        "moderated | with neither | Held %%, runs: mean and least of %d, mean of the function: estimated | "
        "pooled | "
        "chosen with told | with moderated | with neither |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        designs);
    for (const Function& function : functions)
      for (const Noise& noise : noises)
        for (const int samples : {2, 5}) print_study_row(function, noise, 40, samples);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "told_noise_table: %s\n", e.what());
    return 1;
  }
}
