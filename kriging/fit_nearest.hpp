// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Fits Kriging to thousands of runs: `NearestModel model = fit_nearest(X, y);`, or fit_any(X, y), which is
/// fit(X, y) up to 2000 runs.
///
/// θ, the exponents and λ maximise Vecchia's likelihood (detail/nearest/vecchia.hpp), with the prior and the
/// options of fit. Simplified: a run is conditioned on the nearest of earlier ones only, and a prediction rests on
/// the nearest runs (nearest_model.hpp). NearestError says what twice as many would change. Of smooth functions
/// without noise the error of the mean is up to that of exact Kriging of a quarter of the runs; of noisy ones, whose
/// noise is averaged over the neighbourhood alone, it is larger by a third where 400 of 1000 runs are neighbours
/// (docs/measurements/kriging.md, thousands of runs). λ is never below what the largest blocks need to be factored
/// (detail/nearest/neighbourhood.hpp), 1.4e-10 by default.
/// Runs are sorted first and then put in random order, so the order of the rows changes no bit; nor does the number
/// of threads. Cost: a gradient is 2 n neighbours² flops times ten, the model n neighbourhood² times three, the
/// search of neighbours n² d/neighbours; memory n (d + neighbours/4 + neighbourhood/8) numbers. Refused:
/// Structure::additive, whose runs tell of each other at any distance, and Trend::blind.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/kriging/any_surrogate.hpp>
#include <drawpoint/kriging/detail/nearest/approximation_error.hpp>
#include <drawpoint/kriging/detail/nearest/search.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/nearest_model.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

struct NearestOptions {
  int neighbours = 200;     ///< of a block of an eighth as many runs in the likelihood, 8 to 4000
  int neighbourhood = 400;  ///< runs that a prediction rests on, 8 to 4000
  int exact_up_to = 2000;   ///< runs that fit_any leaves to fit, 0 or more
};

namespace detail {

inline void check_count(const std::string& name, int count, int least, int most) {
  if (count < least || count > most)
    throw std::invalid_argument("kriging::fit_nearest: " + name + " is " + std::to_string(count) +
                                "; allowed are " + std::to_string(least) + " to " + std::to_string(most) +
                                "; use the default");
}

inline void check_nearest(const NearestOptions& nearest, const FitOptions& options) {
  check_count("neighbours", nearest.neighbours, 8, 4000);
  check_count("neighbourhood", nearest.neighbourhood, 8, 4000);
  if (options.structure == Structure::additive)
    throw std::invalid_argument(
        "kriging::fit_nearest: structure is additive; allowed are product and isotropic, since in a sum far "
        "runs "
        "tell as much as near ones; choose one of them");
  if (options.trend == Trend::blind)
    throw std::invalid_argument(
        "kriging::fit_nearest: trend is blind; allowed are constant, linear, quadratic and user; use "
        "quadratic");
}

/// All that can be wrong with what fit_nearest is given, rows named as they were given.
inline void check_fit_nearest(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const FitOptions& options,
                              const NearestOptions& nearest) {
  check_nearest(nearest, options);
  check_runs(X, y);
  check_options(options, X.cols());
  check_noise(options, X.rows());
  require_levels("kriging::fit_nearest", X, options.levels);
}

/// More than half of a run's neighbours at its own point would tell nothing of the response elsewhere.
inline void check_repeats(const std::vector<std::vector<Index>>& sites, int neighbours) {
  for (const std::vector<Index>& site : sites)
    if (2 * static_cast<int>(site.size()) > std::max(neighbours, 2))
      throw std::invalid_argument("kriging::fit_nearest: " + std::to_string(site.size()) +
                                  " runs stand at the point of run " + std::to_string(site.front()) +
                                  "; allowed are half of neighbours, " + std::to_string(neighbours / 2) +
                                  "; average them with kriging::replicates, or raise neighbours");
}

/// Rows by their inputs, responses and noise, so that no order of the rows is better than another; then at
/// random.
inline std::vector<Index> order_of(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                                   const Eigen::VectorXd& noise, doe::Seed seed) {
  std::vector<Index> sorted(static_cast<std::size_t>(X.rows()));
  std::iota(sorted.begin(), sorted.end(), Index{0});
  const auto before = [&](Index a, Index b) {
    for (Index k = 0; k < X.cols(); ++k)
      if (X(a, k) != X(b, k)) return X(a, k) < X(b, k);
    if (y[a] != y[b]) return y[a] < y[b];
    return noise.size() > 0 && noise[a] < noise[b];
  };
  std::stable_sort(sorted.begin(), sorted.end(), before);
  doe::RandomStream random(seed);
  doe::detail::shuffle(sorted, random);
  return sorted;
}

/// The state of the parameters at which the likelihood stands.
inline ModelState state_of(const TrainingData& data, const VecchiaLikelihood& likelihood) {
  ModelState s;
  s.input = data.input;
  s.y_centre = data.y_centre;
  s.y_scale = data.y_scale;
  s.observed = data.observed;
  s.correlation = likelihood.correlation();
  s.nugget = likelihood.nugget();
  s.noise = data.noise;
  s.known_noise = data.known_noise;
  s.noise_unit = data.noise_unit;
  s.trend = data.trend;
  s.X = data.X;
  s.F = data.F;
  s.y = data.y;
  s.gls.beta = likelihood.beta();
  s.gls.T = likelihood.T();
  s.gls.sum_of_squares = likelihood.sum_of_squares();
  s.process_variance = likelihood.estimates().process_variance;
  s.log_likelihood =
      likelihood.estimates().log_likelihood - static_cast<double>(data.X.rows()) * std::log(data.y_scale);
  return s;
}

/// Bounds of the parameters, λ no less than the largest blocks need.
inline Box nearest_box(const TrainingData& data, const Likelihood& few, const FitOptions& options,
                       const NearestOptions& nearest) {
  Box box = parameter_box(data, few, options);
  const Index last = box.lower.size() - 1;
  const double least = std::log(least_nugget(std::min<Index>(2 * nearest.neighbourhood, data.X.rows())));
  box.lower[last] = std::max(box.lower[last], least);
  box.upper[last] = std::max(box.upper[last], least);
  return box;
}

inline void report_nearest(const Search& found, const NearestError& error, const NearestOptions& nearest,
                           FitReport& report) {
  report.starts_tried = found.tried;
  report.starts_agreed = found.agreed;
  report.condition = std::numeric_limits<double>::quiet_NaN();
  report.status = found.best.converged ? Status::converged : Status::not_converged;
  const auto rounded = [](double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.2g", value);
    return std::string(digits);
  };
  report.message = "Vecchia's likelihood by " + std::to_string(nearest.neighbours) +
                   " nearest runs, to which twice as many add " + rounded(error.log_density) +
                   " per run; predictions by " + std::to_string(nearest.neighbourhood) +
                   " runs, which twice as many move by " + rounded(error.mean) +
                   ", where the standard deviation is " + rounded(error.deviation);
  if (error.mean > error.deviation) report.message += ": raise neighbourhood";
  if (!found.best.converged)
    report.message += "; the search ended before its stopping rule: raise max_iterations";
}

/// The trend and round-off, where the trend alone meets all runs: there is nothing to correlate then.
inline std::optional<NearestModel> nearest_exact_trend(const TrainingData& data, const FitOptions& options,
                                                       const NearestOptions& nearest) {
  if (data.trend.is_constant() || data.known_noise > 0) return {};
  const LikelihoodProblem problem = likelihood_problem(data, options);
  Eigen::VectorXd p = parameter_box(data, Likelihood(thinned(problem)), options).upper;
  p[p.size() - 1] = std::log(std::clamp(1.0, options.nugget_lower, options.nugget_upper));
  VecchiaLikelihood likelihood(problem, nearest.neighbours, p);
  likelihood.value(p);
  const double roundoff = response_roundoff(data), n = static_cast<double>(data.y.size());
  if (!(likelihood.sum_of_squares() <= roundoff * roundoff * n)) return {};
  NearestState state{state_of(data, likelihood), nearest.neighbourhood, options.threads, {}};
  state.all.process_variance = roundoff * roundoff;
  state.all.log_likelihood = std::numeric_limits<double>::infinity();
  state.all.report.status = Status::exact_trend;
  state.all.report.message =
      "the trend meets all " + std::to_string(data.y.size()) + " runs to round-off: the model is the trend";
  add_remarks(data, state.all.report);
  return NearestModel(std::move(state));
}

/// Estimates the parameters of data whose runs stand in random order.
inline NearestModel fit_nearest_prepared(const TrainingData& data, const FitOptions& options,
                                         const NearestOptions& nearest) {
  if (auto trend = nearest_exact_trend(data, options, nearest)) return *std::move(trend);
  const LikelihoodProblem problem = likelihood_problem(data, options);
  Likelihood few(thinned(problem));
  const Search found =
      search_nearest(problem, few, nearest_box(data, few, options, nearest), options, nearest.neighbours);
  VecchiaLikelihood likelihood(problem, nearest.neighbours, found.best.p);
  likelihood.value(found.best.p);
  NearestState state{state_of(data, likelihood), nearest.neighbourhood, options.threads, {}};
  if (data.X.rows() > nearest.neighbours + 1)
    state.error.log_density =
        log_density_change(problem, state.all, likelihood.residual(), nearest.neighbours);
  if (data.X.rows() > nearest.neighbourhood)
    add_prediction_change(state.all, likelihood.residual(), nearest.neighbourhood, state.error);
  state.all.report.evaluations = few.factorizations() + likelihood.evaluations();
  report_nearest(found, state.error, nearest, state.all.report);
  add_remarks(data, state.all.report);
  return NearestModel(std::move(state));
}

}  // namespace detail

/// X: n x d, one run per row, natural units; y: n, any unit. Throws std::invalid_argument as fit, for options out
/// of their range, and for more repeats at one point than half of the neighbours. Repeats that all agree count
/// once, as in fit.
inline NearestModel fit_nearest(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                                const FitOptions& given = {}, const NearestOptions& nearest = {}) {
  detail::check_fit_nearest(X, y, given, nearest);
  FitOptions options = given.noise == Noise::none ? detail::with_exact_runs(given) : given;
  const auto sites = detail::sites_of(X);
  if (given.noise_variance.size() == 0 && detail::repeats_agree(sites, y)) {
    const std::vector<Eigen::Index> once = detail::first_runs(sites);
    return fit_nearest(detail::rows_of(X, once), detail::entries_of(y, once), detail::with_exact_runs(given),
                       nearest);
  }
  detail::check_repeats(sites, nearest.neighbours);
  const std::vector<Eigen::Index> order = detail::order_of(X, y, given.noise_variance, given.seed);
  if (given.noise_variance.size() > 0)
    options.noise_variance = detail::entries_of(given.noise_variance, order);
  const detail::TrainingData data =
      detail::prepare(detail::rows_of(X, order), detail::entries_of(y, order), options);
  if (data.y.size() == 0)
    return NearestModel(
        {detail::constant_model(data, options).state(), nearest.neighbourhood, options.threads, {}});
  return detail::fit_nearest_prepared(data, options, nearest);
}

/// fit(X, y, options), bit for bit, up to nearest.exact_up_to runs and fit_nearest(X, y, options, nearest) beyond.
/// Throws as these.
inline AnySurrogate fit_any(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                            const FitOptions& options = {}, const NearestOptions& nearest = {}) {
  detail::check_count("exact_up_to", nearest.exact_up_to, 0, std::numeric_limits<int>::max());
  if (X.rows() <= nearest.exact_up_to) return fit(X, y, options);
  return fit_nearest(X, y, options, nearest);
}

}  // namespace drawpoint::kriging
