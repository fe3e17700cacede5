// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Values that miss a bound of their response by round-off alone: a share that is computed as 1 - 0.9 - 0.1
/// is -2.8e-17, and means 0.
///
/// Adding up n numbers of size s in any order errs by about √n ε s with ε = 2.2e-16. The tolerance is
/// 1024 ε s = 2.3e-13 s, which holds for a million terms; s is the larger size of the finite bounds and, where
/// that is 0, one unit of the response.

#include <cmath>
#include <limits>

#include <drawpoint/doe/problem.hpp>

namespace drawpoint::doe::detail {

inline double round_off_tolerance(const Response& response) {
  double scale = 0.0;
  for (const double bound : {response.lower, response.upper})
    if (std::isfinite(bound)) scale = std::fmax(scale, std::abs(bound));
  return 1024.0 * std::numeric_limits<double>::epsilon() * (scale > 0.0 ? scale : 1.0);
}

/// The bound that the value misses by no more than that, or the value itself.
inline double without_round_off(const Response& response, double value) {
  const double tolerance = round_off_tolerance(response);
  if (value < response.lower && response.lower - value <= tolerance) return response.lower;
  if (value > response.upper && value - response.upper <= tolerance) return response.upper;
  return value;
}

}  // namespace drawpoint::doe::detail
