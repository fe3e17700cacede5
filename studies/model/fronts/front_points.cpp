// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/pareto/minimised.hpp>

namespace drawpoint::studies::detail {

std::vector<std::size_t> objectives(const doe::Problem& problem) {
  std::vector<std::size_t> chosen;
  for (std::size_t j = 0; j < problem.responses.size(); ++j)
    if (doe::is_objective(problem.responses[j].goal)) chosen.push_back(j);
  return chosen;
}

Eigen::Index best_point(const doe::Problem& problem, const pareto::Front& front, Eigen::Index column) {
  Eigen::Index row = 0;
  pareto::minimised(problem, front.Y).col(column).minCoeff(&row);
  return row;
}

Eigen::Index balanced_point(const doe::Problem& problem, const pareto::Front& front) {
  if (front.Y.rows() == 0) return -1;
  const Eigen::MatrixXd Y = pareto::minimised(problem, front.Y);
  Eigen::VectorXd distance = Eigen::VectorXd::Zero(Y.rows());
  for (Eigen::Index k = 0; k < Y.cols(); ++k) {
    const auto y = Y.col(k).array();
    const double low = y.minCoeff(), high = y.maxCoeff();
    if (high > low) distance.array() += ((y - low) / (high - low)).square();
  }
  Eigen::Index row = 0;
  distance.minCoeff(&row);
  return row;
}

}  // namespace drawpoint::studies::detail
