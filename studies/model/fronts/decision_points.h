// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which points of a predicted front a decision would rest on: the recommended one, the best of each objective, the
/// balanced choice (front_points.h), the strongest knees (pareto/knees.hpp), then the points farthest from those
/// chosen, each objective scaled to its range on the front.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/pareto/search.hpp>

#include <Eigen/Core>
#include <vector>

namespace drawpoint::studies {

/// x as one more row of X.
void append_place(Eigen::MatrixXd& X, const Eigen::RowVectorXd& x);

/// Rows of a front.
struct DecisionPoints {
  std::vector<int> best;  ///< where each objective is best, in order
  int balanced = -1;
  std::vector<int> knees;  ///< the strongest first
};

/// Requires a front with points.
DecisionPoints decision_points(const pareto::Front& front, const doe::Problem& problem);

/// The row `first`, if there is one (-1: none), then rows of the front in this order, `most` at most, one per
/// place. A point whose place has been confirmed already (k x d) counts as chosen, but is not returned.
std::vector<int> points_to_confirm(const pareto::Front& front, const doe::Problem& problem,
                                   const Eigen::MatrixXd& confirmed, int most, int first = -1);

}  // namespace drawpoint::studies
