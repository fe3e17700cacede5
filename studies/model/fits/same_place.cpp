// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/same_place.h>

#include <algorithm>
#include <cmath>

namespace drawpoint::studies {

namespace detail {

double largest_difference(const doe::Problem& problem, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double apart = 0.0;
  for (Eigen::Index k = 0; k < a.size(); ++k) {
    const doe::Variable& v = problem.variables[static_cast<std::size_t>(k)];
    apart = std::max(apart, std::abs(a[k] - b[k]) / (v.upper - v.lower));
  }
  return apart;
}

}  // namespace detail

bool is_same_place(const doe::Problem& problem, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return detail::largest_difference(problem, a, b) <= same_place;
}

}  // namespace drawpoint::studies
