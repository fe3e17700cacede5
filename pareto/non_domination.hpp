// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How likely each point is on the front, when its responses are uncertain.
///
/// p_i = share of the draws (draws.hpp) in which point i meets all limits and no other point that does
/// dominates it. About the given points only: a better point may lie between them. For two points of
/// independent normals, P(b dominates a) = Π_j Φ((μ_aj - μ_bj)/√(σ_aj² + σ_bj²)). The standard error
/// √(p(1-p)/N) is that of N unrelated draws; the quasi Monte Carlo draws do better. Cost: one non-dominated
/// sort per draw.

#include <Eigen/Core>
#include <string>
#include <vector>

#include <drawpoint/pareto/detail/normalized.hpp>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/draws.hpp>

namespace drawpoint::pareto {

struct NonDomination {
  Eigen::VectorXd probability, standard_error;  ///< n each
};

namespace detail {

/// The front of one draw: rows of the points on it, and their minimised objectives.
struct DrawnFront {
  std::vector<int> rows;
  RowMajor Y;
};

inline bool meets_limits(const doe::Problem& problem, const Roles& role, const Eigen::RowVectorXd& y) {
  for (const int c : role.constraints)
    if (violation(problem.responses[static_cast<std::size_t>(c)], y[c]) > 0.0) return false;
  return true;
}

inline DrawnFront front_of_draw(const doe::Problem& problem, const Roles& role, const Eigen::MatrixXd& draw) {
  std::vector<int> feasible;
  for (int i = 0; i < static_cast<int>(draw.rows()); ++i)
    if (meets_limits(problem, role, draw.row(i))) feasible.push_back(i);
  const Eigen::MatrixXd Y = draw(feasible, role.objectives) * signs_of(role).asDiagonal();
  DrawnFront front;
  const std::vector<int> best = non_dominated(Y);
  for (const int i : best) front.rows.push_back(feasible[static_cast<std::size_t>(i)]);
  front.Y = Y(best, Eigen::all);
  return front;
}

inline std::vector<DrawnFront> fronts_of_draws(const std::string& place, const doe::Problem& problem,
                                               const Draws& draws) {
  check_draws(place, problem, draws);
  const Roles role = roles(problem);
  if (role.objectives.empty())
    throw std::invalid_argument(place +
                                "no response is an objective; give one the goal minimize or maximize");
  std::vector<DrawnFront> fronts;
  for (const Eigen::MatrixXd& draw : draws) fronts.push_back(front_of_draw(problem, role, draw));
  return fronts;
}

}  // namespace detail

/// draws: two or more, n x r each. Throws std::invalid_argument when they do not fit the problem.
inline NonDomination probability_non_dominated(const doe::Problem& problem, const Draws& draws) {
  const auto fronts = detail::fronts_of_draws("pareto::probability_non_dominated: ", problem, draws);
  NonDomination result;
  result.probability = Eigen::VectorXd::Zero(draws.front().rows());
  for (const detail::DrawnFront& front : fronts)
    for (const int i : front.rows) result.probability[i] += 1.0;
  const auto count = static_cast<double>(draws.size());
  result.probability /= count;
  result.standard_error = (result.probability.array() * (1.0 - result.probability.array()) / count).sqrt();
  return result;
}

}  // namespace drawpoint::pareto
