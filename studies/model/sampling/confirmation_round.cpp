// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fronts/confirmations.h>
#include <drawpoint/studies/model/fronts/decision_points.h>
#include <drawpoint/studies/model/fronts/front.h>
#include <drawpoint/studies/model/recommendation.h>
#include <drawpoint/studies/model/sampling/confirmation_round.h>

namespace drawpoint::studies {
namespace {

Eigen::MatrixXd confirmed_places(const std::vector<Run>& runs, Eigen::Index dimension) {
  Eigen::MatrixXd X(0, dimension);
  for (const Run& run : runs) {
    if (run.kind == Kind::confirmation) append_place(X, run.x.transpose());
  }
  return X;
}

/// First of those to be simulated; -1: none.
int row_to_confirm_first(const Models& fitted, const PredictedFront& predicted, const std::vector<Run>& runs,
                         const std::vector<Mark>& marks) {
  const pareto::Front& front = predicted.found.front;
  const CheckedRuns confirmations = check_predictions(runs, predicted.problem, Kind::confirmation);
  Eigen::VectorXd success;
  if (!predicted.failures.none() && front.X.rows() > 0)
    success = predicted.failures.probability_of_success(front.X);
  return recommended_row({predicted.problem, fitted.models, front, marks, confirmations, success});
}

/// "--x=0.25,5 was simulated before, by run 17; the report has what came out"; empty: it was not.
std::string made_before(const std::vector<Run>& runs, const Eigen::RowVectorXd& x) {
  const Run* made = nullptr;
  for (const Run& run : runs)
    if (run.kind == Kind::confirmation && run.x.transpose() == x) made = &run;
  if (made == nullptr) return "";
  const std::string text = "--x=" + typed_values(x.transpose());
  const std::string by = ", by run " + std::to_string(made->id);
  if (made->left_out) return text + " was simulated before" + by + ", which is left out: " + made->reason;
  if (made->status == Status::failed)
    return text + " was tried before" + by + ", which failed; --retry-failed makes it again";
  return text + " was simulated before" + by + "; the report has what came out";
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
  std::vector<std::string> known;
  for (Eigen::Index i = 0; i < named.rows(); ++i) {
    const std::string text = made_before(runs, named.row(i));
    if (text.empty())
      append_place(X, named.row(i));
    else
      known.push_back(text);
  }
  RoundPlan plan{.round = {.first = static_cast<std::int64_t>(runs.size()) + 1,
                           .named = static_cast<int>(X.rows() - before)},
                 .known = known};
  for (const int row : points_to_confirm(predicted.found.front, predicted.problem, X, points,
                                         row_to_confirm_first(fitted, predicted, runs, marks)))
    append_place(X, predicted.found.front.X.row(row));
  if (X.rows() == before) {
    if (points > 0)
      plan.nothing = predicted.missing.empty() ? "every point of the front that matters has been simulated"
                                               : "there is no front: " + predicted.missing;
    return plan;
  }
  const Eigen::MatrixXd added = X.bottomRows(X.rows() - before);
  plan.runs = runs_at(identity, runs, Kind::confirmation, with_predictions(fitted.models, problem, added));
  return plan;
}

}  // namespace drawpoint::studies
