// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What fit_nearest.hpp declares.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/kriging/detail/compiled.hpp>
#include <drawpoint/kriging/detail/fit_definition.hpp>
#include <drawpoint/kriging/detail/nearest/approximation_error.hpp>
#include <drawpoint/kriging/detail/nearest/given_runs.hpp>
#include <drawpoint/kriging/detail/nearest/search.hpp>
#include <drawpoint/kriging/fit_nearest.hpp>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging {
namespace detail {

/// The state of the parameters at which the likelihood stands.
inline ModelState state_of(const TrainingData& data, const VecchiaLikelihood& likelihood) {
  ModelState s = state_at(data, likelihood);
  s.gls.beta = likelihood.beta();
  s.gls.T = likelihood.T();
  s.gls.sum_of_squares = likelihood.sum_of_squares();
  return s;
}

/// Bounds of the parameters, λ no less than the largest blocks need.
inline Box nearest_box(const TrainingData& data, const Likelihood& few, const FitOptions& options,
                       const NearestOptions& nearest) {
  Box box = parameter_box(data, few, options);
  if (data.noise.size() || data.known_noise > 0) return box;  // block_floor
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
  const Eigen::VectorXd p = uncorrelated(parameter_box(data, Likelihood(thinned(problem)), options), options);
  VecchiaLikelihood likelihood(problem, nearest.neighbours, p);
  likelihood.value(p);
  if (!trend_meets_all(data, likelihood.sum_of_squares())) return {};
  NearestState state{state_of(data, likelihood), nearest.neighbourhood, options.threads, {}};
  become_trend(state.all, data);
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

DRAWPOINT_KRIGING_INLINE NearestModel fit_nearest(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                                                  const FitOptions& given, const NearestOptions& nearest) {
  detail::check_fit_nearest(X, y, given, nearest);
  FitOptions options = given.noise == Noise::none ? detail::with_exact_runs(given) : given;
  const auto sites = detail::sites_of(X);
  if (given.noise_variance.size() == 0 && detail::repeats_agree(sites, y) &&
      (given.noise == Noise::none || detail::agreement_tells(sites, y))) {
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

DRAWPOINT_KRIGING_INLINE AnySurrogate fit_any(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                                              const FitOptions& options, const NearestOptions& nearest) {
  detail::check_count("exact_up_to", nearest.exact_up_to, 0, std::numeric_limits<int>::max());
  if (X.rows() <= nearest.exact_up_to) return fit(X, y, options);
  return fit_nearest(X, y, options, nearest);
}

}  // namespace drawpoint::kriging
