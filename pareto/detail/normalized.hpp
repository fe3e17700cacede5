// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A front on one scale: F_ij = (s_j y_ij - least_j)/range_j, s_j = -1 for what is maximised, else 1.
///
/// Every objective is minimised and runs from 0, the best of the front, to 1, the worst of the front, so no
/// unit enters a comparison of objectives. The origin is the ideal point of the front, not of the problem. An
/// objective that does not vary on the front is 0 throughout and has range 1.

#include <Eigen/Core>
#include <stdexcept>
#include <string>

#include <drawpoint/pareto/detail/roles.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto::detail {

struct NormalizedFront {
  Eigen::MatrixXd F;                    ///< n x m
  Eigen::RowVectorXd sign, low, range;  ///< range > 0

  /// From natural units and signs.
  Eigen::RowVectorXd of(const Eigen::VectorXd& y) const {
    return (y.transpose().cwiseProduct(sign) - low).cwiseQuotient(range);
  }
};

/// Throws std::invalid_argument, `place` in front, for a front that is not one of this problem.
inline void check_front(const std::string& place, const doe::Problem& problem, const Front& front) {
  doe::check(problem);
  const auto m = static_cast<Eigen::Index>(roles(problem).objectives.size());
  const auto r = static_cast<Eigen::Index>(problem.responses.size());
  if (m == 0)
    throw std::invalid_argument(place +
                                "no response is an objective; give one the goal minimize or maximize");
  const bool matches =
      front.Y.cols() == m && front.responses.cols() == r && front.responses.rows() == front.Y.rows();
  if (front.Y.rows() > 0 && !matches)
    throw std::invalid_argument(place + "the front has " + std::to_string(front.Y.cols()) +
                                " objectives and " + std::to_string(front.responses.cols()) +
                                " responses, the problem has " + std::to_string(m) + " and " +
                                std::to_string(r) + "; give the front of this problem");
  if (!front.responses.allFinite() || !front.Y.allFinite())
    throw std::invalid_argument(place + "the front holds NaN or infinity; leave out failed runs");
}

/// n >= 1.
inline NormalizedFront normalized(const doe::Problem& problem, const Front& front) {
  NormalizedFront result;
  result.sign = signs_of(roles(problem));
  const Eigen::MatrixXd Y = front.Y * result.sign.asDiagonal();
  result.low = Y.colwise().minCoeff();
  result.range = Y.colwise().maxCoeff() - result.low;
  for (double& r : result.range)
    if (!(r > 0.0)) r = 1.0;
  result.F = (Y.rowwise() - result.low).array().rowwise() / result.range.array();
  return result;
}

}  // namespace drawpoint::pareto::detail
