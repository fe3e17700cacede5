// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A round of simulations at the points of a predicted front that a decision would rest on
/// (model/fronts/decision_points.h).

#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/mark.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace drawpoint::studies {

struct RoundPlan {
  std::vector<Run> runs = {};
  ConfirmationRound round = {};
  std::string nothing = {};  ///< why there are no runs of the front; empty: there are, or none was wanted
  std::vector<std::string> known = {};  ///< of each named point that was simulated before: by which run
};

/// The runs of a round: at the points that the user names (k x d) but for those that are confirmed already,
/// then at those of the front of the present models, `points` at most, the recommended one (model/recommendation.h, by
/// these marks) first, each with what the models say of it.
/// Throws std::runtime_error if the runs do not allow models.
RoundPlan plan_round(const Identity& identity, const std::vector<Run>& runs, const Eigen::MatrixXd& named,
                     int points, const std::vector<Mark>& marks);

}  // namespace drawpoint::studies
