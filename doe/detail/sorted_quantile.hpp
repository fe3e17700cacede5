// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace drawpoint::doe::detail {

/// Entry p (0 to 1) of sorted values, linear between neighbours, which stand at 0, 1/(n − 1), ..., 1.
inline double sorted_quantile(const Eigen::VectorXd& sorted, double p) {
  const double place = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<Eigen::Index>(place);
  const Eigen::Index above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace drawpoint::doe::detail
