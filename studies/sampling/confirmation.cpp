// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/models/confirmations.h>
#include <drawpoint/studies/models/decision_points.h>
#include <drawpoint/studies/models/front.h>
#include <drawpoint/studies/report/recommendation.h>
#include <drawpoint/studies/sampling/confirmation.h>

namespace drawpoint::studies {
namespace {

bool is_row(const Eigen::RowVectorXd& x, const Eigen::MatrixXd& X) {
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    if (X.row(i) == x) return true;
  }
  return false;
}

Eigen::MatrixXd confirmed_places(const std::vector<Run>& runs, Eigen::Index dimension) {
  Eigen::MatrixXd X(0, dimension);
  for (const Run& run : runs) {
    if (run.kind == Kind::confirmation) append_place(X, run.x.transpose());
  }
  return X;
}

/// The row of the front that is recommended; -1: none, or a place that was simulated.
int recommended_row(const Models& fitted, const PredictedFront& predicted, const Tables& tables,
                    const std::vector<Run>& runs, const std::vector<Mark>& marks) {
  ReportInput known;
  known.problem = predicted.problem;
  known.training = tables.training;
  known.validation = tables.validation;
  known.models = fitted.models;
  known.front = predicted.found.front;
  known.marks = marks;
  known.confirmations = check_predictions(runs, predicted.problem, Kind::confirmation);
  if (!predicted.failures.none() && known.front.X.rows() > 0)
    known.success = predicted.failures.probability_of_success(known.front.X);
  const auto recommended = recommend(known);
  return recommended ? recommended->row : -1;
}

}  // namespace

RoundPlan plan_round(const Identity& identity, const std::vector<Run>& runs, const Eigen::MatrixXd& named,
                     int points, const std::vector<Mark>& marks) {
  const doe::Problem& problem = identity.problem;
  const Tables tables = tables_of(runs, problem);
  const Models fitted = models_or_reason(tables);
  const PredictedFront predicted = predicted_front(fitted.models, tables, identity.seed);
  Eigen::MatrixXd X = confirmed_places(runs, static_cast<Eigen::Index>(problem.variables.size()));
  const Eigen::Index before = X.rows();
  for (Eigen::Index i = 0; i < named.rows(); ++i) {
    if (!is_row(named.row(i), X.topRows(before))) append_place(X, named.row(i));
  }
  RoundPlan plan{.round = {.first = static_cast<std::int64_t>(runs.size()) + 1,
                           .named = static_cast<int>(X.rows() - before)}};
  for (const int row : points_to_confirm(predicted.found.front, predicted.problem, X, points,
                                         recommended_row(fitted, predicted, tables, runs, marks)))
    append_place(X, predicted.found.front.X.row(row));
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
