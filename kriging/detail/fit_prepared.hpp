// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The steps of a fit: bounds, search, what the data were like, the model.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/detail/threads.hpp>
#include <drawpoint/kriging/detail/blind.hpp>
#include <drawpoint/kriging/detail/likelihood.hpp>
#include <drawpoint/kriging/detail/parameter_uncertainty.hpp>
#include <drawpoint/kriging/detail/search.hpp>
#include <drawpoint/kriging/detail/training_data.hpp>
#include <drawpoint/kriging/model.hpp>
#include <drawpoint/kriging/options.hpp>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

inline constexpr double condition_limit = 1e14;  // leaves two of the 16 digits
/// Up to so many runs intervals are far too narrow, since no run tells which variables matter
/// (docs/measurements/kriging.md, few runs per variable).
inline constexpr Eigen::Index few_per_variable = 2;

inline LikelihoodProblem likelihood_problem(const TrainingData& data, const FitOptions& options) {
  return {data.X,
          data.y,
          data.F,
          data.noise,
          data.known_noise,
          options.correlation,
          options.exponent,
          doe::detail::thread_count(options.threads),
          options.estimation == Estimation::penalized_likelihood,
          options.nugget_power,
          data.levels,
          data.structure};
}

/// The process variance is searched up to so many times the variance of the response, beside known noise.
inline constexpr double most_process_variance = 1e8;

/// Bounds of the vₖ of a sum's weights: each may be e^10 times another.
inline constexpr double weight_range = 10.0;

/// Fixes what no run tells: ln θ and vₖ of inputs that never vary, of numbers at no effect, of categories
/// where other levels are not correlated with the one that was run. At the one distance of a category the
/// exponent says what θ says, and in a sum θ what the weight says: they are fixed. X: n x d, scaled.
inline void fix_untold(const Eigen::MatrixXd& X, const CorrelationFunction& f, const ParameterPlaces& places,
                       Box& box) {
  std::vector<bool> varies(static_cast<std::size_t>(places.theta_count), false);
  for (Eigen::Index k = 0; k < X.cols(); ++k)
    if (!never_varies(X, k)) varies[static_cast<std::size_t>(places.theta(k))] = true;
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    const Eigen::Index a = places.theta(k);
    const bool told = varies[static_cast<std::size_t>(a)], category = is_category(f.levels, k);
    if (category && (!told || places.weights))
      box.lower[a] = box.upper[a];
    else if (!told)
      box.upper[a] = box.lower[a];
    if (places.exponents && (category || !told))
      box.lower[places.exponent(k)] = box.upper[places.exponent(k)];
    if (places.weights && !told) box.lower[places.weight(k)] = box.upper[places.weight(k)] = 0.0;
  }
}

/// Isotropic numbers share their θ, and its bounds.
inline void bound_thetas(const ParameterPlaces& places, const FitOptions& options, Box& box) {
  for (Eigen::Index k = 0; k < places.variables(); ++k) {
    box.lower[places.theta(k)] = std::log(options.theta_lower[k]);
    box.upper[places.theta(k)] = std::log(options.theta_upper[k]);
  }
}

/// Bounds of (ln θ, exponents, weights, ln λ). Where the noise is known, λ says what the process variance is,
/// and small noise needs a small λ.
inline Box parameter_box(const TrainingData& data, const Likelihood& likelihood, const FitOptions& options) {
  const ParameterPlaces& places = likelihood.places();
  const Eigen::Index last = places.count() - 1;
  Box box{Eigen::VectorXd::Constant(last + 1, 1.0), Eigen::VectorXd::Constant(last + 1, 2.0)};
  bound_thetas(places, options, box);
  for (Eigen::Index k = places.weight(0); k < last; ++k) {
    box.lower[k] = -weight_range;
    box.upper[k] = weight_range;
  }
  box.lower[last] = std::log(options.nugget_lower);
  box.upper[last] = std::log(options.nugget_upper);
  if (data.known_noise > 0 && box.lower[last] < box.upper[last])
    box.lower[last] = std::min(box.lower[last], std::log(data.known_noise / most_process_variance));
  fix_untold(data.X, likelihood.correlation(), places, box);
  return box;
}

/// The status and the message of a search whose best point `likelihood` stands at.
inline void report_search(const Search& search, Likelihood& likelihood, FitReport& report) {
  report.starts_tried = search.tried;
  report.starts_agreed = search.agreed;
  report.condition = likelihood.condition();
  report.status = search.best.converged ? Status::converged : Status::not_converged;
  report.message = std::to_string(search.agreed) + " of " + std::to_string(search.tried) +
                   " local searches agreed on the chosen maximum";
  const auto rounded = [](double value) { return text(std::round(100.0 * value) / 100.0); };
  if (search.error_ratio < 1.0)
    report.message += ", which is " + rounded(search.height_left) +
                      " lower in log likelihood than the highest one, but has " +
                      rounded(search.error_ratio) + " of its leave-one-out error";
  if (!search.best.converged)
    report.message += "; the best of them ended before its stopping rule: raise max_iterations or starts";
  if (!(report.condition < condition_limit)) {
    report.status = Status::ill_conditioned;
    report.message += "; the correlation matrix has condition " + text(report.condition) +
                      (likelihood.problem().known_noise > 0 ? ": remove" : ": raise nugget_lower or remove") +
                      " runs that nearly repeat others";
  }
}

/// What the data were like, after what the search says.
inline void add_remarks(const TrainingData& data, FitReport& report) {
  for (Eigen::Index k = 0; k < data.X.cols(); ++k) {
    if (data.input.factor[k] == 0.0)
      report.message += "; input " + std::to_string(k) + " never varies, so predictions ignore it";
    if (!is_category(data.levels, k)) continue;
    const std::string missing = levels_without_runs(data.X, data.levels, k);
    if (!missing.empty())
      report.message += "; the fit had no run of level" +
                        std::string(missing.find(',') < missing.size() ? "s " : " ") + missing +
                        " of input " + std::to_string(k) +
                        (!never_varies(data.X, k) ? ": predictions there rest on the other levels"
                         : data.structure == Structure::additive ? ": predictions there ignore it"
                                                                 : ": predictions there are the trend") +
                        ", with intervals that are too narrow; run it";
  }
  if (data.X.rows() <= few_per_variable * data.X.cols())
    report.message +=
        "; " + std::to_string(data.X.rows()) + " runs in " + std::to_string(data.X.cols()) +
        " variables are too few to trust: of intervals of 95 % some 45 hold for the mean, 80 for "
        "a new run; make " +
        std::to_string(10 * data.X.cols()) + " or so";
  if (data.terms_dropped > 0)
    report.message += "; " + std::to_string(data.terms_dropped) + " terms of the trend are left out, which " +
                      std::to_string(data.X.rows()) + " runs cannot tell from the others";
  if (!data.trend_reduced) return;
  report.status = Status::too_few_runs;
  report.message +=
      "; the trend asked for has as many terms as there are runs or more: it is a constant instead";
}

/// A model without runs: a constant response, or one run.
inline Model constant_model(const TrainingData& data, const FitOptions& options) {
  ModelState s;
  s.input = data.input;
  s.observed = data.observed;
  s.y_centre = data.y_centre;
  s.y_scale = 0;
  const auto d = data.X.cols();
  s.correlation = {options.correlation, Eigen::VectorXd(d), options.exponent, data.levels, data.structure};
  for (Eigen::Index k = 0; k < d; ++k) s.correlation.theta[k] = options.theta_lower[k];
  if (data.structure == Structure::additive)
    s.correlation.weight = Eigen::VectorXd::Constant(d, 1.0 / static_cast<double>(d));
  s.nugget = options.nugget_lower;
  s.X.resize(0, data.X.cols());
  if (data.observed.size() == 1) {
    s.constant_variance = std::numeric_limits<double>::infinity();
    s.report.status = Status::too_few_runs;
    s.report.message = "one run says nothing about how the response varies: the model is the constant " +
                       text(data.y_centre) + " with infinite variance";
  } else {
    s.report.status = Status::constant_response;
    s.report.message = "all responses equal " + text(data.y_centre) + ": the model is that constant";
  }
  return Model(std::move(s));
}

/// What the data and the parameters at which a likelihood stands say of a model, gls and L apart.
template <class AnyLikelihood>
ModelState state_at(const TrainingData& data, const AnyLikelihood& likelihood) {
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
  s.process_variance = likelihood.estimates().process_variance;
  s.log_likelihood =
      likelihood.estimates().log_likelihood - static_cast<double>(data.X.rows()) * std::log(data.y_scale);
  return s;
}

inline ModelState state_of(const TrainingData& data, const Likelihood& likelihood, FitReport report) {
  ModelState s = state_at(data, likelihood);
  s.L = likelihood.cholesky();
  s.gls = likelihood.least_squares();
  s.report = std::move(report);
  return s;
}

/// Relative round-off of a standardised response: that of y and of a sum of a few terms of its size.
inline double response_roundoff(const TrainingData& data) {
  const double size = std::max(largest_entry(data.observed), -smallest_entry(data.observed));
  return 64.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, size / data.y_scale);
}

/// Parameters of the box at which no two runs are correlated.
inline Eigen::VectorXd uncorrelated(const Box& box, const FitOptions& options) {
  Eigen::VectorXd p = box.upper;
  p[p.size() - 1] = std::log(std::clamp(1.0, options.nugget_lower, options.nugget_upper));
  return p;
}

/// Whether the squared errors of uncorrelated runs from the trend sum to round-off.
inline bool trend_meets_all(const TrainingData& data, double sum_of_squares) {
  const double roundoff = response_roundoff(data), n = static_cast<double>(data.y.size());
  return sum_of_squares <= roundoff * roundoff * n;
}

/// The trend alone is the model.
inline void become_trend(ModelState& s, const TrainingData& data) {
  s.process_variance = std::pow(response_roundoff(data), 2);
  s.log_likelihood = std::numeric_limits<double>::infinity();
  s.report.status = Status::exact_trend;
  s.report.message =
      "the trend meets all " + std::to_string(data.y.size()) + " runs to round-off: the model is the trend";
  add_remarks(data, s.report);
}

/// The trend and round-off, where the trend alone meets all runs; empty where it does not. There is nothing
/// to correlate then, and the likelihood has no bound.
inline std::optional<Model> exact_trend(const TrainingData& data, const FitOptions& options) {
  if (data.trend.is_constant() || data.known_noise > 0) return {};
  Likelihood likelihood(likelihood_problem(data, options));
  likelihood.value(uncorrelated(parameter_box(data, likelihood, options), options));
  if (likelihood.least_squares().beta.size() == 0) return {};  // repeats without a nugget: R is singular
  if (!trend_meets_all(data, likelihood.least_squares().sum_of_squares)) return {};
  FitReport report;
  report.evaluations = likelihood.factorizations();
  ModelState state = state_of(data, likelihood, std::move(report));
  become_trend(state, data);
  return Model(std::move(state));
}

/// What the fit leaves unknown of its parameters at p, where the likelihood stands.
inline Eigen::MatrixXd spread_at(Likelihood& likelihood, const Box& box, const Eigen::VectorXd& p) {
  const std::vector<Eigen::Index> free = free_parameters(box, p, likelihood.gradient(p));
  if (likelihood.runs() <= many) return parameter_spread(likelihood, p, free);
  Likelihood few(thinned(likelihood.problem()));
  return parameter_spread(few, p, free);
}

inline Model fit_prepared(const TrainingData& data, const FitOptions& options) {
  if (std::optional<Model> exact = exact_trend(data, options)) return *std::move(exact);
  Likelihood likelihood(likelihood_problem(data, options));
  Box box = parameter_box(data, likelihood, options);
  FitReport report;
  Search found = search(likelihood, box, options, report.evaluations);
  const bool singular = !std::isfinite(found.best.value);
  // λ of some n times the round-off makes any correlation matrix positive definite, so this ends.
  while (!std::isfinite(found.best.value)) {
    double &lower = box.lower[box.lower.size() - 1], &upper = box.upper[box.upper.size() - 1];
    lower += std::log(100.0);
    upper = std::max(lower, upper);
    found = search(likelihood, box, options, report.evaluations);
  }
  likelihood.value(found.best.p);
  const Eigen::MatrixXd spread =
      options.parameter_uncertainty ? spread_at(likelihood, box, found.best.p) : Eigen::MatrixXd();
  report_search(found, likelihood, report);
  report.evaluations += likelihood.factorizations();
  if (singular) {
    report.status = Status::ill_conditioned;
    report.message += "; the matrix was singular within nugget_upper, so the nugget was raised to " +
                      text(likelihood.nugget());
  }
  add_remarks(data, report);
  ModelState state = state_of(data, likelihood, std::move(report));
  state.parameter_spread = spread;
  return Model(std::move(state));
}

}  // namespace drawpoint::kriging::detail
