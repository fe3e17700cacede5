// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Which responses are objectives and which are limits, with the signs of their goals.

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include <drawpoint/doe/problem.hpp>

namespace drawpoint::pareto::detail {

/// Places in Problem::responses; sign times objective is minimised.
struct Roles {
  std::vector<int> objectives, constraints;
  std::vector<double> signs;
};

inline Roles roles(const doe::Problem& problem) {
  Roles result;
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    const doe::Goal goal = problem.responses[j].goal;
    if (doe::is_constraint(goal)) result.constraints.push_back(static_cast<int>(j));
    if (!doe::is_objective(goal)) continue;
    result.objectives.push_back(static_cast<int>(j));
    result.signs.push_back(doe::sign_of(goal));
  }
  return result;
}

inline Eigen::RowVectorXd signs_of(const Roles& role) {
  return Eigen::Map<const Eigen::RowVectorXd>(role.signs.data(),
                                              static_cast<Eigen::Index>(role.signs.size()));
}

/// Each column over its range, also where the inverse of the range is infinite.
inline Eigen::MatrixXd over(const Eigen::MatrixXd& Y, const Eigen::RowVectorXd& range) {
  return Y.array().rowwise() / range.array();
}

/// By how much a value breaks the limit of a response; 0 where it is met.
inline double violation(const doe::Response& response, double value) {
  const double excess = response.goal == doe::Goal::at_most ? value - response.limit : response.limit - value;
  return std::max(excess, 0.0);
}

}  // namespace drawpoint::pareto::detail
