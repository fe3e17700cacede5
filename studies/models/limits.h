// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether a run keeps the limits of its study's responses.

#include <drawpoint/studies/store/store.h>
#include <drawpoint/pareto/detail/roles.hpp>

namespace drawpoint::studies {

inline bool breaks_limit(const doe::Response& response, double y) {
  return doe::is_constraint(response.goal) && pareto::detail::violation(response, y) > 0.0;
}

/// Requires a run that is done.
inline bool keeps_all_limits(const Run& run, const doe::Problem& problem) {
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    if (breaks_limit(problem.responses[j], run.y[static_cast<Eigen::Index>(j)])) return false;
  }
  return true;
}

}  // namespace drawpoint::studies
