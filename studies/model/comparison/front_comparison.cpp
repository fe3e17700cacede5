// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/comparison/front_comparison.h>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/minimised.hpp>
#include <drawpoint/pareto/polished_front.hpp>

namespace drawpoint::studies {
namespace {

constexpr double beyond_the_worst = 0.1;  // of the range, as the toolkit's own reference points

/// From minimised to natural signs and back.
Eigen::VectorXd turned(const doe::Problem& problem, const Eigen::VectorXd& y) {
  return pareto::minimised(problem, y.transpose()).transpose();
}

}  // namespace

FrontComparison compare_fronts(const doe::Problem& problem, const pareto::Front& a, const pareto::Front& b) {
  const Eigen::MatrixXd A = pareto::minimised(problem, a.Y), B = pareto::minimised(problem, b.Y);
  const Eigen::VectorXd best_a = A.colwise().minCoeff().transpose();
  const Eigen::VectorXd best_b = B.colwise().minCoeff().transpose();
  FrontComparison comparison{.best_a = turned(problem, best_a), .best_b = turned(problem, best_b)};
  const Eigen::VectorXd ideal = best_a.cwiseMin(best_b);
  const Eigen::VectorXd worst = A.colwise().maxCoeff().cwiseMax(B.colwise().maxCoeff()).transpose();
  const Eigen::VectorXd range = worst - ideal;
  const bool told = A.cols() > 1 && A.cols() <= pareto::most_polished_objectives && range.minCoeff() > 0.0;
  if (!told) return comparison;
  const Eigen::VectorXd reference = worst + beyond_the_worst * range;
  const double box = (reference - ideal).prod();
  comparison.reference = turned(problem, reference);
  comparison.share_a = pareto::hypervolume(A, reference) / box;
  comparison.share_b = pareto::hypervolume(B, reference) / box;
  return comparison;
}

}  // namespace drawpoint::studies
