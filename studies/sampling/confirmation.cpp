// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/front.h>
#include <drawpoint/studies/report/summary.h>
#include <drawpoint/studies/sampling/confirmation.h>
#include <drawpoint/pareto/detail/normalized.hpp>
#include <drawpoint/pareto/knees.hpp>
#include <drawpoint/pareto/minimised.hpp>

#include <limits>

namespace drawpoint::studies {
namespace {

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

bool is_among(const Eigen::VectorXd& x, const Eigen::MatrixXd& X, const doe::Problem& problem) {
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    if (detail::largest_difference(problem, X.row(i).transpose(), x) <= same_place) return true;
  }
  return false;
}

bool is_row(const Eigen::RowVectorXd& x, const Eigen::MatrixXd& X) {
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    if (X.row(i) == x) return true;
  }
  return false;
}

void append_row(Eigen::MatrixXd& X, const Eigen::RowVectorXd& x) {
  X.conservativeResize(X.rows() + 1, x.size());
  X.bottomRows(1) = x;
}

Eigen::MatrixXd confirmed_places(const std::vector<Run>& runs, Eigen::Index dimension) {
  Eigen::MatrixXd X(0, dimension);
  for (const Run& run : runs) {
    if (run.kind == Kind::confirmation) append_row(X, run.x.transpose());
  }
  return X;
}

}  // namespace

std::vector<int> points_to_confirm(const pareto::Front& front, const doe::Problem& problem,
                                   const Eigen::MatrixXd& confirmed, int most) {
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
    append_row(taken, front.X.row(row));
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

RoundPlan plan_round(const Identity& identity, const std::vector<Run>& runs, const Eigen::MatrixXd& named,
                     int points) {
  const doe::Problem& problem = identity.problem;
  const Tables tables = tables_of(runs, problem);
  const Models fitted = models_or_reason(tables);
  const PredictedFront predicted = predicted_front(fitted.models, tables, identity.seed);
  Eigen::MatrixXd X = confirmed_places(runs, static_cast<Eigen::Index>(problem.variables.size()));
  const Eigen::Index before = X.rows();
  for (Eigen::Index i = 0; i < named.rows(); ++i) {
    if (!is_row(named.row(i), X.topRows(before))) append_row(X, named.row(i));
  }
  RoundPlan plan{.round = {.first = static_cast<std::int64_t>(runs.size()) + 1,
                           .named = static_cast<int>(X.rows() - before)}};
  for (const int row : points_to_confirm(predicted.found.front, problem, X, points))
    append_row(X, predicted.found.front.X.row(row));
  if (X.rows() == before) {
    plan.nothing = predicted.missing.empty() ? "every point of the front that matters has been simulated"
                                             : "there is no front: " + predicted.missing;
    return plan;
  }
  const Eigen::MatrixXd added = X.bottomRows(X.rows() - before);
  plan.runs = runs_at(identity, runs, Kind::confirmation, with_predictions(fitted.models, problem, added));
  return plan;
}

}  // namespace drawpoint::studies
