// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Two predicted fronts of one problem, A and B, held against each other.
///
/// In the box from the best of both fronts in every objective (the ideal) to the worst of both plus a tenth
/// of the range between (the reference point), each front dominates a share: its hypervolume over the box's. It
/// has no interval: what the models do not know of either front is in the difference.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/pareto/search.hpp>

#include <Eigen/Core>
#include <optional>

namespace drawpoint::studies {

struct FrontComparison {
  Eigen::VectorXd best_a, best_b;  ///< of each objective on each front, natural signs
  Eigen::VectorXd reference = {};  ///< natural signs; empty where there is no share
  /// Shares, none of one objective, of more than five, or where the fronts have no extent.
  std::optional<double> share_a = {}, share_b = {};
};

/// Requires points on both fronts.
FrontComparison compare_fronts(const doe::Problem& problem, const pareto::Front& a, const pareto::Front& b);

}  // namespace drawpoint::studies
