// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Limits in a search: how likely a point keeps them, and improvement among those that do.
///
/// With mean μ and deviation σ of a constrained response at x,
///   probability_of_feasibility  Φ((limit − μ)/σ) for at_most, Φ((μ − limit)/σ) for at_least
///   constrained_improvement     the expected improvement on the best feasible run, times all probabilities
/// The deviation is that of the regression, latent: what is not known of the response without its noise.
/// Responses are taken as independent. Source: Schonlau 1997, "Computer experiments and global optimization",
/// chapter 6; Gelbart, Snoek, Adams 2014, "Bayesian optimization with unknown constraints" (no feasible run).

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/kriging/acquisition.hpp>

namespace drawpoint::kriging {

namespace detail {

/// One model a response of the problem.
template <class S>
void check_models(const char* place, const doe::Problem& problem, const std::vector<S>& models) {
  require_surrogate<S>();
  doe::check(problem);
  if (models.size() != problem.responses.size())
    throw std::invalid_argument(std::string(place) + ": " + std::to_string(models.size()) +
                                " models; the problem has " + std::to_string(problem.responses.size()) +
                                " responses; give one model a response, in their order");
}

}  // namespace detail

/// That the latent response keeps the limit of `response`, an at_most or at_least one. Throws
/// std::invalid_argument for another goal and a limit that is not finite.
template <class S>
doe::Criterion probability_of_feasibility(S model, const doe::Response& response) {
  detail::require_surrogate<S>();
  if (!doe::is_constraint(response.goal))
    throw std::invalid_argument(
        "kriging::probability_of_feasibility: response \"" + response.name + "\" has the goal " +
        std::string(doe::to_string(response.goal)) +
        "; allowed are at_most and at_least; use expected_improvement for objectives");
  detail::check_finite("kriging::probability_of_feasibility", "limit", response.limit);
  const double sign = doe::sign_of(response.goal);
  return
      [model = std::move(model), sign, limit = response.limit](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
        const Prediction p = model.predict(X);
        Eigen::VectorXd score(X.rows());
        for (Eigen::Index i = 0; i < score.size(); ++i) {
          const double slack = sign * (limit - p.mean[i]), deviation = std::sqrt(p.variance[i]);
          score[i] = deviation > 0 ? detail::normal_probability(slack / deviation) : (slack >= 0 ? 1.0 : 0.0);
        }
        return score;
      };
}

/// Π of the scores, for criteria that are improvements and probabilities. Throws std::invalid_argument for
/// none.
inline doe::Criterion product_of_criteria(std::vector<doe::Criterion> criteria) {
  if (criteria.empty())
    throw std::invalid_argument(
        "kriging::product_of_criteria: 0 criteria; allowed is 1 or more; name at least one");
  return [criteria = std::move(criteria)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    Eigen::VectorXd all = criteria[0](X);
    for (std::size_t k = 1; k < criteria.size(); ++k) all = detail::entry_products(all, criteria[k](X));
    return all;
  };
}

/// That all limits of the problem are kept; 1 everywhere when it has none. models: one per response.
template <class S>
doe::Criterion probability_of_feasibility(const doe::Problem& problem, const std::vector<S>& models) {
  detail::check_models("kriging::probability_of_feasibility", problem, models);
  std::vector<doe::Criterion> all{
      [](const Eigen::MatrixXd& X) -> Eigen::VectorXd { return Eigen::VectorXd::Ones(X.rows()); }};
  for (std::size_t j = 0; j < models.size(); ++j)
    if (doe::is_constraint(problem.responses[j].goal))
      all.push_back(probability_of_feasibility(models[j], problem.responses[j]));
  return product_of_criteria(std::move(all));
}

namespace detail {

/// Which runs keep all limits, by the fitted values of models of the same runs.
template <Regression S>
std::vector<Eigen::Index> feasible_runs(const char* place, const doe::Problem& problem,
                                        const std::vector<S>& models) {
  const Eigen::Index n = models.front().runs();
  std::vector<bool> kept(static_cast<std::size_t>(n), true);
  for (std::size_t j = 0; j < models.size(); ++j) {
    if (models[j].runs() != n)
      throw std::invalid_argument(std::string(place) + ": a model of " + std::to_string(models[j].runs()) +
                                  " runs beside one of " + std::to_string(n) +
                                  "; fit all responses to the same runs");
    const doe::Response& r = problem.responses[j];
    if (!doe::is_constraint(r.goal)) continue;
    const double sign = doe::sign_of(r.goal);
    const Eigen::VectorXd values = fitted_values(models[j]);
    for (Index i = 0; i < n; ++i)
      if (!(sign * (values[i] - r.limit) <= 0.0)) kept[static_cast<std::size_t>(i)] = false;
  }
  std::vector<Eigen::Index> runs;
  for (Eigen::Index i = 0; i < n; ++i)
    if (kept[static_cast<std::size_t>(i)]) runs.push_back(i);
  return runs;
}

}  // namespace detail

/// For a problem with one objective, and limits if it has any. models: one per response, fitted to the same
/// runs. While no run is feasible there is nothing to improve on, and the score is the probability of
/// feasibility alone. Throws std::invalid_argument for another number of objectives or models.
inline doe::Criterion constrained_improvement(const doe::Problem& problem, const std::vector<Model>& models) {
  constexpr const char* place = "kriging::constrained_improvement";
  detail::check_models(place, problem, models);
  std::vector<std::size_t> objectives;
  for (std::size_t j = 0; j < problem.responses.size(); ++j)
    if (doe::is_objective(problem.responses[j].goal)) objectives.push_back(j);
  if (objectives.size() != 1)
    throw std::invalid_argument(std::string(place) + ": the problem has " +
                                std::to_string(objectives.size()) +
                                " objectives; allowed is 1; use expected_hypervolume_improvement for more");
  const doe::Criterion feasible = probability_of_feasibility(problem, models);
  const std::vector<Eigen::Index> runs = detail::feasible_runs(place, problem, models);
  if (runs.empty()) return feasible;
  const std::size_t j = objectives[0];
  const double sign = detail::sign_of(place, problem.responses[j].goal);
  return product_of_criteria({detail::reinterpolated_improvement(models[j], sign, false, runs), feasible});
}

}  // namespace drawpoint::kriging
