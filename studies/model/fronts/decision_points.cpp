// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/same_place.h>
#include <drawpoint/studies/model/fronts/decision_points.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/pareto/detail/normalized.hpp>
#include <drawpoint/pareto/knees.hpp>
#include <drawpoint/pareto/minimised.hpp>

#include <algorithm>
#include <limits>

namespace drawpoint::studies {
namespace {

/// The most important first.
std::vector<int> in_order(const DecisionPoints& points) {
  std::vector<int> rows = points.best;
  rows.push_back(points.balanced);
  rows.insert(rows.end(), points.knees.begin(), points.knees.end());
  return rows;
}

bool is_among(const Eigen::VectorXd& x, const Eigen::MatrixXd& X, const doe::Problem& problem) {
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    if (is_same_place(problem, X.row(i).transpose(), x)) return true;
  }
  return false;
}

}  // namespace

void append_place(Eigen::MatrixXd& X, const Eigen::RowVectorXd& x) {
  X.conservativeResize(X.rows() + 1, x.size());
  X.bottomRows(1) = x;
}

DecisionPoints decision_points(const pareto::Front& front, const doe::Problem& problem) {
  const Eigen::MatrixXd Y = pareto::minimised(problem, front.Y);
  DecisionPoints points;
  for (Eigen::Index k = 0; k < Y.cols(); ++k) {
    int best = 0;
    Y.col(k).minCoeff(&best);
    points.best.push_back(best);
  }
  points.balanced = static_cast<int>(detail::balanced_point(problem, front));
  for (const int row : pareto::knees(problem, front, {.neighbours = 15}).rows) {
    if (std::find(points.best.begin(), points.best.end(), row) == points.best.end())
      points.knees.push_back(row);
  }
  return points;
}

std::vector<int> points_to_confirm(const pareto::Front& front, const doe::Problem& problem,
                                   const Eigen::MatrixXd& confirmed, int most, int first) {
  const auto n = front.X.rows();
  std::vector<int> chosen;
  if (n == 0) return chosen;
  const Eigen::MatrixXd F = pareto::detail::normalized(problem, front).F;
  Eigen::MatrixXd taken = confirmed;
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  const auto cover = [&](int row) {
    distance = distance.cwiseMin((F.rowwise() - F.row(row)).rowwise().norm());
  };
  const auto choose = [&](int row) {
    cover(row);
    if (is_among(front.X.row(row), taken, problem)) return;
    chosen.push_back(row);
    append_place(taken, front.X.row(row));
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    if (is_among(front.X.row(i), confirmed, problem)) cover(static_cast<int>(i));
  }
  if (first >= 0 && most > 0) choose(first);
  for (const int row : in_order(decision_points(front, problem))) {
    if (static_cast<int>(chosen.size()) < most) choose(row);
  }
  int farthest = 0;
  while (static_cast<int>(chosen.size()) < most && distance.maxCoeff(&farthest) > 0.0) choose(farthest);
  return chosen;
}

}  // namespace drawpoint::studies
