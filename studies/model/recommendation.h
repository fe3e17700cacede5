// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which strategy a report recommends, and what it gains.
///
/// The rule: of the points of the front where a run succeeds with a chance of 0.9 or more, and of these of the ones
/// that are predicted to be no worse than the reference in any objective, the one nearest to the best of every
/// objective at once, each scaled to its range on the front. Where no point is left, that condition is dropped. With
/// one objective it is the best point found.
/// A place that `confirm` has simulated takes its stead where it does as well: the means of the two differ in every
/// objective by a twentieth of its range on the front at most, the simulation kept all limits, and the condition above
/// holds. Of several such places it is the nearest to the best of every objective at once. With one objective, whose
/// front has no range, the place must be the same.
/// The reference is the mark called "reference" (mark.hpp), or else the middle of the box.

#include <drawpoint/studies/model/modelled_study.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace drawpoint::studies {

Reference reference_of(const doe::Problem& problem, const std::vector<Mark>& marks);

/// What decides which place is recommended; `success` may be empty, and confirmations none.
struct Choice {
  const doe::Problem& problem;
  const std::vector<kriging::TransformedModel>& models;  ///< one per response
  const pareto::Front& front;
  const std::vector<Mark>& marks;
  const CheckedRuns& confirmations;
  const Eigen::VectorXd& success;
};

/// The row of the front; -1: none, or a place that was simulated.
int recommended_row(const Choice& choice);

/// None without models or a front. Costs a few thousand draws of two points per objective: ModelledStudy::recommended
/// keeps it for all who say something of it.
std::optional<Recommendation> recommend(const ModelledStudy& study);
/// The same against another reference.
std::optional<Recommendation> recommend(const ModelledStudy& study, const Reference& reference);

/// Means of all responses at the rows of X (n x d), within their ranges: n x r.
Eigen::MatrixXd predicted_means(const ModelledStudy& study, const Eigen::MatrixXd& X);

}  // namespace drawpoint::studies
