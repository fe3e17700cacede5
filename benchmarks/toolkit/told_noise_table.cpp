// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// told_noise_table: what it is worth that runs tell their own standard error. Each run is the mean of a few
/// noisy samples; fits with the noise estimated, the same everywhere, beside fits with what the runs tell,
/// fits with a model of that, and the choice among the three. Takes no options; prints a table: errors over
/// the deviation of the response, and how many of fresh runs lie within their 95 % interval, where the noise
/// is small and where it is large.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/noise_model.hpp>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace drawpoint;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns: the three ways, and the chosen one.
constexpr int designs = 15, fresh = 200, columns = 4;

/// On the unit square.
struct Function {
  const char* name;
  double (*f)(const VectorXd&);
};

double branin(const VectorXd& u) {
  const double a = -5 + 15 * u[0], b = 15 * u[1];
  return std::pow(b - 5.1 / (4 * M_PI * M_PI) * a * a + 5 / M_PI * a - 6, 2) +
         10 * (1 - 1 / (8 * M_PI)) * std::cos(a) + 10;
}

double waves(const VectorXd& u) { return std::sin(5 * u[0]) + std::cos(4 * u[1]) * u[0]; }

constexpr std::array functions = {Function{"Branin", branin}, Function{"waves", waves}};

/// Deviation of the mean of a run, in deviations of the response.
struct Noise {
  const char* name;
  double (*deviation)(const VectorXd& u, int run);
};

constexpr std::array noises = {
    Noise{"0.2 everywhere", [](const VectorXd&, int) { return 0.2; }},
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

doe::Problem square() {
  return {.variables = {{"u0", "1", 0.0, 1.0}, {"u1", "1", 0.0, 1.0}},
          .responses = {{"y", "1", doe::Goal::record}}};
}

Scale scale_of(const Function& function) {
  const MatrixXd X = doe::latin_hypercube(square(), 2000, {.seed = 1});
  VectorXd y(X.rows());
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = function.f(X.row(i));
  return {y.mean(), std::sqrt((y.array() - y.mean()).square().mean())};
}

double truth(const Function& function, const Scale& scale, const VectorXd& u) {
  return (function.f(u) - scale.mean) / scale.deviation;
}

Runs runs_of(const Function& function, const Noise& noise, int n, int samples, doe::Seed seed) {
  const Scale scale = scale_of(function);
  doe::RandomStream random(seed);
  Runs r{doe::latin_hypercube(square(), n, {.seed = seed}), VectorXd(n), VectorXd(n), VectorXd(n)};
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

kriging::FitOptions known(const VectorXd& noise_variance) {
  kriging::FitOptions options;
  options.noise = kriging::Noise::known;
  options.noise_variance = noise_variance;
  return options;
}

std::vector<kriging::WayToFit> ways() {
  return {{"estimated", [](const MatrixXd& X,
                           const VectorXd& y) { return kriging::TransformedModel(kriging::fit(X, y)); }},
          {"told",
           [](const MatrixXd& X, const VectorXd& y, const VectorXd& noise_variance) {
             return kriging::TransformedModel(kriging::fit(X, y, known(noise_variance)));
           }},
          {"modelled", [](const MatrixXd& X, const VectorXd& y, const VectorXd& noise_variance) {
             const kriging::FitOptions modelled = kriging::with_modelled_noise(known(noise_variance), X);
             return kriging::TransformedModel(kriging::fit(X, y, modelled));
           }}};
}

/// Of the fresh runs, as the way k of the three has it; none for the first.
kriging::RunNoise noise_of(std::size_t k, const Runs& training, const Runs& check) {
  if (k == 0) return {};
  if (k == 1) return {kriging::Noise::known, check.noise_variance};
  const kriging::TransformedModel model = kriging::fit_noise(training.X, training.noise_variance);
  return {kriging::Noise::known, kriging::noise_variance_at(model, check.X)};
}

struct Result {
  double error = 0, quiet = 0, noisy = 0;  // held, of the fresh runs with less and with more noise
};

Result judged(const kriging::TransformedModel& model, const Function& function, const Runs& r,
              const kriging::RunNoise& noise) {
  const Scale scale = scale_of(function);
  const kriging::Validation v = noise.noise == kriging::Noise::known
                                    ? kriging::validate(model, r.X, r.y, noise.variance)
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
  return {std::sqrt(sum / static_cast<double>(r.y.size())), share(0), share(1)};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::string text(double share) {
  char buffer[16];
  std::snprintf(buffer, sizeof buffer, "%.0f", 100 * share);
  return std::isnan(share) ? "" : buffer;
}

void print_row(const Function& function, const Noise& noise, int n, int samples) {
  std::vector<double> error[columns], quiet[columns], noisy[columns];
  int chosen[3] = {};
  for (int design = 1; design <= designs; ++design) {
    const auto seed = static_cast<doe::Seed>(design);
    const Runs r = runs_of(function, noise, n, samples, seed);
    const Runs check = runs_of(function, noise, fresh, samples, seed + 1000);
    const auto choice = kriging::choose_fit(r.X, r.y, {}, ways(), {kriging::Noise::known, r.noise_variance});
    ++chosen[choice.best];
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t way = k < 3 ? k : choice.best;
      const Result result =
          judged(ways()[way].fitter(r.X, r.y, r.noise_variance), function, check, noise_of(way, r, check));
      error[k].push_back(result.error);
      quiet[k].push_back(result.quiet);
      noisy[k].push_back(result.noisy);
    }
  }
  std::printf("| %s | %s | %d | %d |", function.name, noise.name, n, samples);
  for (const auto& errors : error) std::printf(" %.3f |", median(errors));
  for (int k = 0; k < columns; ++k)
    std::printf(" %s / %s |", text(median(quiet[k])).c_str(), text(median(noisy[k])).c_str());
  std::printf(" %d / %d / %d |\n", chosen[0], chosen[1], chosen[2]);
  std::fflush(stdout);
}

}  // namespace

int main() {
  try {
    std::printf(
        "| Function | Noise of a run | Runs | Samples | Error: estimated | told | modelled | chosen | Held "
        "%%, "
        "quiet / noisy runs: estimated | told | modelled | chosen | Chosen, of %d |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        designs);
    for (const Function& function : functions)
      for (const Noise& noise : noises)
        for (const int n : {20, 60})
          for (const int samples : {2, 5, 20}) print_row(function, noise, n, samples);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "told_noise_table: %s\n", e.what());
    return 1;
  }
}
