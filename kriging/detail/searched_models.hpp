// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The responses of a problem as a search for its optimum sees them: objectives and limits, each with a model of
/// the runs so far, on a scale that suits it.
///
/// Exact runs are met (Noise::none). While there are fewer than four per variable they cannot tell that an input
/// has no effect, but the likelihood often says so: θ is then 0.1 or more, a correlation of 0.67 across the box.
/// Limits, and an objective that is alone, are modelled as logarithms where all runs are above 0, the largest is
/// more than ten times the smallest, and the runs are likelier so: stresses and costs of a design are products of
/// powers. An exact objective without limits may be a sum of functions of one variable each. Points whose runs are
/// under way count as runs that gave what the model expects.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/kriging/acquisition_hypervolume.hpp>
#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/moderated_noise.hpp>
#include <drawpoint/kriging/replicates.hpp>
#include <drawpoint/kriging/success_model.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// Whether equal points give equal responses: the problem says so, or repeats, of which none differ.
inline bool runs_are_exact(const doe::Evaluations& runs) {
  return runs.problem.deterministic || repeats_say(runs) == RepeatsSay::exact;
}

inline const doe::Response& response_of(const doe::Problem& problem, std::string_view name) {
  return problem.responses[static_cast<std::size_t>(doe::response_index(problem, name))];
}

/// Options for response `name` of runs in the box of their problem. A run is weighed by its own standard error where
/// the problem has its degrees of freedom, moderated by those of all.
inline FitOptions search_fit_options(const doe::Evaluations& runs, std::string_view name, bool exact) {
  FitOptions options;
  options.lower = doe::lower_bounds(runs.problem);
  options.upper = doe::upper_bounds(runs.problem);
  options.levels = doe::level_counts(runs.problem);
  options.may_be_exact = !doe::tells_noise(runs.problem) && repeats_say(runs) != RepeatsSay::noisy;
  const Eigen::VectorXd told = runs.noise_variance(name);
  if (exact) {
    options.noise = Noise::none;
    if (told.size() == 0 && runs.X().rows() < 4 * options.lower.size()) options.theta_lower = 0.1;
  } else if (told.size() > 0 && largest_entry(told) > 0) {
    const double freedom = response_of(runs.problem, name).standard_error_freedom;
    options.noise = freedom > 0 ? Noise::known : Noise::pooled;
    options.noise_variance = freedom > 0 ? moderated_noise(told, freedom) : told;
  }
  return options;
}

/// An objective or a limit on the scale of its model, z = y or ln y.
struct SearchedResponse {
  std::size_t place = 0;  ///< among the responses of the problem
  bool logarithm = false;
  Model model;

  double on_scale(double y) const { return logarithm ? std::log(y) : y; }
  double natural(double z) const { return logarithm ? std::exp(z) : z; }
};

inline bool wants_logarithm(const doe::Response& r, const Eigen::VectorXd& y, bool alone) {
  constexpr double ratio = 10.0;
  if (doe::is_objective(r.goal) && !alone) return false;  // a hypervolume is one of natural units
  if (doe::is_constraint(r.goal) && !(r.limit > 0)) return false;
  return smallest_entry(y) > 0 && largest_entry(y) > ratio * smallest_entry(y);
}

/// Moves z and its model to the scale of logarithms where the runs are likelier there: the density of y is that of
/// ln y over y.
inline bool take_logarithm(const Eigen::MatrixXd& X, Eigen::VectorXd& z, const FitOptions& options,
                           Model& model) {
  Eigen::VectorXd logarithms = z;
  double sum = 0;
  for (double& entry : logarithms) sum += entry = std::log(entry);
  Model other = fit(X, logarithms, options);
  if (!(other.log_likelihood() - sum > model.log_likelihood())) return false;
  z = std::move(logarithms);
  model = std::move(other);
  return true;
}

/// The model, or one that is a sum of functions of one variable each, where exact runs are clearly likelier so: of a
/// rugged response few runs tell no more.
inline Model additive_where_likelier(const Eigen::MatrixXd& X, const Eigen::VectorXd& z, FitOptions options,
                                     Model model) {
  constexpr double clearly = 6.0;  // in ln L
  if (X.cols() < 2 || !std::isfinite(model.log_likelihood())) return model;
  options.structure = Structure::additive;
  Model sum = fit(X, z, options);
  return sum.log_likelihood() > model.log_likelihood() + clearly ? sum : model;
}

/// All objectives and limits with their models, and what runs tell of failures.
struct SearchedModels {
  doe::Problem problem;  ///< the objectives and limits alone, on the scales of the models
  std::vector<SearchedResponse> responses;
  std::optional<SuccessModel> success;  ///< where runs failed
  Eigen::MatrixXd X;                    ///< of the runs that succeeded, n x d
  Eigen::MatrixXd Z;  ///< what these are taken to be without noise, on the scales: n x responses
  bool exact = false;

  std::vector<Model> models() const {
    std::vector<Model> all;
    for (const SearchedResponse& r : responses) all.push_back(r.model);
    return all;
  }

  /// How far run i breaks its limits, Σ of the excess over the spread of the response; 0: it keeps them.
  double violation(Eigen::Index i) const {
    double sum = 0;
    for (std::size_t j = 0; j < responses.size(); ++j) {
      const doe::Response& r = problem.responses[j];
      if (!doe::is_constraint(r.goal)) continue;
      const auto k = static_cast<Eigen::Index>(j);
      const double excess = doe::sign_of(r.goal) * (Z(i, k) - r.limit);
      const double spread = Z.col(k).maxCoeff() - Z.col(k).minCoeff();
      if (excess > 0) sum += excess / std::max(spread, std::abs(r.limit) * 1e-12 + 1e-300);
    }
    return sum;
  }

  std::vector<Eigen::Index> feasible() const {
    std::vector<Eigen::Index> runs;
    for (Eigen::Index i = 0; i < Z.rows(); ++i)
      if (violation(i) == 0.0) runs.push_back(i);
    return runs;
  }
};

/// The model with runs at P (k x d) that gave what it expects; itself where it cannot be extended.
inline Model with_pending(const Model& model, const Eigen::MatrixXd& P) {
  if (P.rows() == 0 || model.state().X.rows() == 0 || model.status() == Status::exact_trend) return model;
  Eigen::VectorXd noise;
  if (model.state().noise.size() > 0) noise = Eigen::VectorXd::Constant(P.rows(), model.noise_variance());
  return append(model, P, model.mean(P), noise);
}

/// Fits the models to the runs that have ended, at least one with values; pending: points of runs under way, k x d.
inline SearchedModels searched_models(const doe::Evaluations& runs, const Eigen::MatrixXd& pending) {
  SearchedModels all;
  all.exact = runs_are_exact(runs);
  all.X = runs.X();
  all.problem.variables = runs.problem.variables;
  const std::vector<doe::Response>& responses = runs.problem.responses;
  const auto counted = std::count_if(responses.begin(), responses.end(),
                                     [](const doe::Response& r) { return r.goal != doe::Goal::record; });
  const bool alone = std::count_if(responses.begin(), responses.end(),
                                   [](const doe::Response& r) { return doe::is_objective(r.goal); }) == 1;
  for (std::size_t j = 0; j < responses.size(); ++j) {
    if (responses[j].goal == doe::Goal::record) continue;
    doe::Response on_scale{responses[j].name, responses[j].unit, responses[j].goal, responses[j].limit};
    Eigen::VectorXd z = runs.y(on_scale.name);
    const FitOptions options = search_fit_options(runs, on_scale.name, all.exact);
    Model model = fit(all.X, z, options);
    if (all.exact && counted == 1) model = additive_where_likelier(all.X, z, options, std::move(model));
    bool logarithm = options.noise_variance.size() == 0 && wants_logarithm(responses[j], z, alone);
    if (logarithm) logarithm = take_logarithm(all.X, z, options, model);
    if (logarithm) on_scale.limit = std::log(on_scale.limit);  // NaN stays NaN
    all.Z.conservativeResize(z.size(), all.Z.cols() + 1);
    all.Z.rightCols(1) = all.exact ? z : fitted_values(model);
    all.responses.push_back({j, logarithm, with_pending(model, pending)});
    all.problem.responses.push_back(on_scale);
  }
  if (runs.failed() > 0) all.success = fit_success(runs);
  return all;
}

}  // namespace drawpoint::kriging::detail
