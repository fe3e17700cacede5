// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// From what somebody wants to the point of the front that serves it best.
///
/// F: the objectives minimised and scaled to 0..1 on the front (normalized.hpp).
/// * by_aspiration: the point of least s = max_j w_j (F_j - a_j) + ρ Σ_j w_j (F_j - a_j), a the aspired
///   values (Wierzbicki 1980, "The use of reference objectives in multiobjective optimization"). s <= 0 says
///   that the aspiration is met, s > 0 by how much of a range the worst objective misses it. Any point of the
///   front is the answer to some aspiration.
/// * by_weights, chebyshev: the same from the ideal point, a = 0: weighs the loss against the best of each.
/// * by_weights, sum: the point of least Σ_j w_j F_j. It never answers with a point in a dent of the front.
/// * pseudo_weights: w_ij = (1 - F_ij) / Σ_k (1 - F_ik): what a point was chosen for if it was chosen by
///   weights (Deb 2001, "Multi-objective optimization using evolutionary algorithms", 8.3.6).
/// Weights are per range of an objective, so equal ones mean "all matter alike" in any units. O(n m).

#include <Eigen/Core>
#include <optional>
#include <stdexcept>
#include <string>

#include <drawpoint/pareto/choice.hpp>
#include <drawpoint/pareto/detail/normalized.hpp>

namespace drawpoint::pareto {

struct PreferenceOptions {
  std::optional<Eigen::VectorXd> weights{};  ///< m, >= 0, one at least > 0; none: all 1
  double augmentation = 1e-4;  ///< ρ >= 0; above 0 no point is chosen that another one dominates
};

enum class WeightForm { chebyshev, sum };

namespace detail {

inline void check_weights(const std::string& place, const Eigen::VectorXd& weights, Eigen::Index m) {
  if (weights.size() != m)
    throw std::invalid_argument(place + "weights has " + std::to_string(weights.size()) +
                                " entries; give one per objective (" + std::to_string(m) + ")");
  for (const double w : weights) check_range(place, "a weight", w, std::isfinite(w) && w >= 0.0, "0 or more");
  if (!(weights.maxCoeff() > 0.0))
    throw std::invalid_argument(place + "all weights are 0; give one at least above 0");
}

/// s of every row; a: m, on the scale of F.
inline Eigen::VectorXd achievement(const Eigen::MatrixXd& F, const Eigen::RowVectorXd& a,
                                   const Eigen::VectorXd& weights, double augmentation) {
  const Eigen::MatrixXd D = (F.rowwise() - a) * weights.asDiagonal();
  return D.rowwise().maxCoeff() + augmentation * D.rowwise().sum();
}

}  // namespace detail

/// aspiration: m, natural units and signs, in the order of the front's objectives. value: s without the term
/// of ρ. Throws std::invalid_argument for a front of another problem and for faulty numbers.
inline Choice by_aspiration(const doe::Problem& problem, const Front& front,
                            const Eigen::VectorXd& aspiration, const PreferenceOptions& options = {}) {
  const std::string place = "pareto::by_aspiration: ";
  detail::check_front(place, problem, front);
  const auto m = static_cast<Eigen::Index>(detail::roles(problem).objectives.size());
  if (aspiration.size() != m || !aspiration.allFinite())
    throw std::invalid_argument(place + "aspiration has " + std::to_string(aspiration.size()) +
                                " entries; give one finite number per objective (" + std::to_string(m) + ")");
  const Eigen::VectorXd weights = options.weights.value_or(Eigen::VectorXd::Ones(m));
  detail::check_weights(place, weights, m);
  detail::check_range(place, "augmentation", options.augmentation, options.augmentation >= 0.0, "0 or more");
  if (front.Y.rows() == 0) return detail::nothing_to_choose();
  const detail::NormalizedFront scaled = detail::normalized(problem, front);
  const Eigen::RowVectorXd a = scaled.of(aspiration);
  Choice choice = detail::cheapest(detail::achievement(scaled.F, a, weights, options.augmentation));
  choice.value = detail::achievement(scaled.F.row(choice.row), a, weights, 0.0)[0];
  return choice;
}

/// weights: m, >= 0; only their ratios matter to the choice. value: the weighted loss against the ideal
/// point, in ranges.
inline Choice by_weights(const doe::Problem& problem, const Front& front, const Eigen::VectorXd& weights,
                         WeightForm form = WeightForm::chebyshev) {
  const std::string place = "pareto::by_weights: ";
  detail::check_front(place, problem, front);
  detail::check_weights(place, weights, static_cast<Eigen::Index>(detail::roles(problem).objectives.size()));
  if (front.Y.rows() == 0) return detail::nothing_to_choose();
  const Eigen::MatrixXd F = detail::normalized(problem, front).F;
  if (form == WeightForm::sum) return detail::cheapest(F * weights);
  const Eigen::RowVectorXd ideal = Eigen::RowVectorXd::Zero(F.cols());
  Choice choice = detail::cheapest(detail::achievement(F, ideal, weights, PreferenceOptions{}.augmentation));
  choice.value = detail::achievement(F.row(choice.row), ideal, weights, 0.0)[0];
  return choice;
}

/// n x m, each row >= 0 with sum 1; equal shares for a point that is the worst in everything.
inline Eigen::MatrixXd pseudo_weights(const doe::Problem& problem, const Front& front) {
  detail::check_front("pareto::pseudo_weights: ", problem, front);
  if (front.Y.rows() == 0) return front.Y;
  Eigen::MatrixXd W = 1.0 - detail::normalized(problem, front).F.array();
  for (auto row : W.rowwise()) {
    if (const double sum = row.sum(); sum > 0.0)
      row /= sum;
    else
      row.setConstant(1.0 / static_cast<double>(row.size()));
  }
  return W;
}

}  // namespace drawpoint::pareto
