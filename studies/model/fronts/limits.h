// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether one response breaks its limit; of all together: pareto::meets_limits.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/pareto/detail/roles.hpp>

namespace drawpoint::studies {

inline bool breaks_limit(const doe::Response& response, double y) {
  return doe::is_constraint(response.goal) && pareto::detail::violation(response, y) > 0.0;
}

}  // namespace drawpoint::studies
