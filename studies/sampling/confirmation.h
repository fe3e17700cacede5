// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which points of a predicted front to simulate: those that a decision would rest on.
///
/// In this order: the best of each objective, the balanced choice (report/summary.h), the strongest knees
/// (pareto/knees.hpp), then the points farthest from those chosen, each objective scaled to its range on the
/// front. A point whose place has been confirmed already counts as chosen, but is not run again.

#include <drawpoint/studies/store/store.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/pareto/search.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// Two points are the same strategy when they differ by at most this share of the range in every variable.
inline constexpr double same_place = 0.02;

/// Rows of the front, `most` at most; confirmed: k x d, where it was simulated before.
std::vector<int> points_to_confirm(const pareto::Front& front, const doe::Problem& problem,
                                   const Eigen::MatrixXd& confirmed, int most);

struct RoundPlan {
  std::vector<Run> runs = {};
  ConfirmationRound round = {};
  std::string nothing = {};  ///< why there are no runs
};

/// The runs of a round: at the points that the user names (k x d) but for those that are confirmed already,
/// then at those of the front of the present models, `points` at most, each with what the models say of it.
/// Throws std::runtime_error if the runs do not allow models.
RoundPlan plan_round(const Identity& identity, const std::vector<Run>& runs, const Eigen::MatrixXd& named,
                     int points);

}  // namespace drawpoint::studies
