// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which points of a front are the best of an objective, and which is the balanced one.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/pareto/search.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace drawpoint::studies::detail {

/// Row of the front nearest to the ideal point, each objective scaled to its range on the front; -1 without a
/// front.
Eigen::Index balanced_point(const doe::Problem& problem, const pareto::Front& front);

/// Row of the front where the objective of this column is best. Requires points.
Eigen::Index best_point(const doe::Problem& problem, const pareto::Front& front, Eigen::Index column);

/// Places in Problem::responses of the objectives, the order of the front's columns.
std::vector<std::size_t> objectives(const doe::Problem& problem);

}  // namespace drawpoint::studies::detail
