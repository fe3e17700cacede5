// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether responses keep their limits.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/pareto/detail/roles.hpp>

#include <Eigen/Core>
#include <cstddef>

namespace drawpoint::studies {

inline bool breaks_limit(const doe::Response& response, double y) {
  return doe::is_constraint(response.goal) && pareto::detail::violation(response, y) > 0.0;
}

/// y: one entry per response.
inline bool keeps_all_limits(const Eigen::VectorXd& y, const doe::Problem& problem) {
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    if (breaks_limit(problem.responses[j], y[static_cast<Eigen::Index>(j)])) return false;
  }
  return true;
}

}  // namespace drawpoint::studies
