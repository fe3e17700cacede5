// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/front.h>
#include <drawpoint/studies/report/summary.h>
#include <drawpoint/studies/sampling/confirmation.h>
#include <drawpoint/pareto/knees.hpp>
#include <drawpoint/pareto/minimised.hpp>

#include <limits>

namespace drawpoint::studies {
namespace {

/// Every objective from 0 to 1 on the front.
Eigen::MatrixXd on_one_scale(const Eigen::MatrixXd& Y) {
  const Eigen::RowVectorXd low = Y.colwise().minCoeff();
  const Eigen::RowVectorXd range = Y.colwise().maxCoeff() - low;
  return (Y.rowwise() - low).array().rowwise() / range.array().max(1e-300);
}

/// The points that matter, the most important first.
std::vector<int> rows_that_matter(const pareto::Front& front, const doe::Problem& problem) {
  const Eigen::MatrixXd Y = pareto::minimised(problem, front.Y);
  std::vector<int> rows;
  for (Eigen::Index k = 0; k < Y.cols(); ++k) {
    int best = 0;
    Y.col(k).minCoeff(&best);
    rows.push_back(best);
  }
  rows.push_back(static_cast<int>(detail::balanced_point(problem, front)));
  const auto knees = pareto::knees(problem, front, {.neighbours = 15}).rows;
  rows.insert(rows.end(), knees.begin(), knees.end());
  return rows;
}

/// Whether a row of X (n x d) is the same place as x.
bool is_among(const Eigen::VectorXd& x, const Eigen::MatrixXd& X, const doe::Problem& problem) {
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    bool same = true;
    for (Eigen::Index j = 0; j < x.size() && same; ++j) {
      const doe::Variable& v = problem.variables[static_cast<std::size_t>(j)];
      same = std::abs(X(i, j) - x[j]) <= same_place * (v.upper - v.lower);
    }
    if (same) return true;
  }
  return false;
}

Eigen::MatrixXd confirmed_places(const std::vector<Run>& runs, Eigen::Index dimension) {
  Eigen::MatrixXd X(0, dimension);
  for (const Run& run : runs) {
    if (run.kind != Kind::confirmation) continue;
    X.conservativeResize(X.rows() + 1, Eigen::NoChange);
    X.bottomRows(1) = run.x.transpose();
  }
  return X;
}

}  // namespace

std::vector<int> points_to_confirm(const pareto::Front& front, const doe::Problem& problem,
                                   const Eigen::MatrixXd& confirmed, int most) {
  const auto n = front.X.rows();
  std::vector<int> chosen;
  if (n == 0) return chosen;
  const Eigen::MatrixXd F = on_one_scale(front.Y);
  Eigen::MatrixXd taken = confirmed;
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  const auto cover = [&](int row) {
    distance = distance.cwiseMin((F.rowwise() - F.row(row)).rowwise().norm());
  };
  const auto choose = [&](int row) {
    cover(row);
    if (is_among(front.X.row(row), taken, problem)) return;
    chosen.push_back(row);
    taken.conservativeResize(taken.rows() + 1, front.X.cols());
    taken.bottomRows(1) = front.X.row(row);
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    if (is_among(front.X.row(i), confirmed, problem)) cover(static_cast<int>(i));
  }
  for (const int row : rows_that_matter(front, problem)) {
    if (static_cast<int>(chosen.size()) < most) choose(row);
  }
  int farthest = 0;
  while (static_cast<int>(chosen.size()) < most && distance.maxCoeff(&farthest) > 0.0) choose(farthest);
  return chosen;
}

std::vector<Run> confirmation_round(const Identity& identity, const std::vector<Run>& runs,
                                    const Eigen::MatrixXd& named, int points) {
  const doe::Problem& problem = identity.problem;
  const Tables tables = tables_of(runs, problem);
  const Models fitted = models_or_reason(tables);
  const pareto::Front front = predicted_front(fitted.models, tables, identity.seed).found.front;
  Eigen::MatrixXd known = confirmed_places(runs, static_cast<Eigen::Index>(problem.variables.size()));
  known.conservativeResize(known.rows() + named.rows(), Eigen::NoChange);
  known.bottomRows(named.rows()) = named;
  const std::vector<int> rows = points_to_confirm(front, problem, known, points);
  Eigen::MatrixXd X(named.rows() + static_cast<Eigen::Index>(rows.size()), known.cols());
  X.topRows(named.rows()) = named;
  for (std::size_t i = 0; i < rows.size(); ++i)
    X.row(named.rows() + static_cast<Eigen::Index>(i)) = front.X.row(rows[i]);
  return runs_at(identity, runs, Kind::confirmation, with_predictions(fitted.models, X));
}

}  // namespace drawpoint::studies
