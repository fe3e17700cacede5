// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/confirmations.h>
#include <drawpoint/studies/analysis/front.h>
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/folder_work.h>
#include <drawpoint/studies/commands/points.h>
#include <drawpoint/studies/runs/execution.h>
#include <drawpoint/studies/runs/session.h>
#include <drawpoint/studies/sampling/confirmation.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace drawpoint::studies {
namespace {

Models models_to_confirm(const Tables& tables) {
  try {
    return fit_models(tables);
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error("confirm: there are no models whose front could be confirmed: " +
                             std::string(e.what()) + "; make more runs with the command run");
  }
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

/// The points of a round with their predictions: those that the user names, then those of the front that
/// matter.
PlannedPoints points_of_round(const Store& store, const std::vector<Run>& runs, const Eigen::MatrixXd& named,
                              int points) {
  const doe::Problem& problem = store.identity().problem;
  const Tables tables = tables_of(runs, problem);
  const Models fitted = models_to_confirm(tables);
  const auto front = predicted_front(fitted.models, tables, store.identity().seed).found.front;
  Eigen::MatrixXd known = confirmed_places(runs, static_cast<Eigen::Index>(problem.variables.size()));
  known.conservativeResize(known.rows() + named.rows(), Eigen::NoChange);
  known.bottomRows(named.rows()) = named;
  const auto rows = points_to_confirm(front, problem, known, points);
  Eigen::MatrixXd X(named.rows() + static_cast<Eigen::Index>(rows.size()), known.cols());
  X.topRows(named.rows()) = named;
  for (std::size_t i = 0; i < rows.size(); ++i)
    X.row(named.rows() + static_cast<Eigen::Index>(i)) = front.X.row(rows[i]);
  return with_predictions(fitted.models, X);
}

/// Simulates what matters on the front of this moment. False when there was nothing left to do, or what came
/// out agrees with what was predicted.
bool confirm_round(Store& store, const Folder& folder, const Settings& settings, int round) {
  const int messages = message_descriptor(settings);
  const doe::Problem& problem = store.identity().problem;
  const std::vector<Run> runs = store.runs();
  const bool first = round == 1 && !settings.confirm.x.empty();
  const Eigen::MatrixXd named = first
                                    ? checked_points(problem, settings.confirm.x)
                                    : Eigen::MatrixXd(0, static_cast<Eigen::Index>(problem.variables.size()));
  const auto points = points_of_round(store, runs, named, settings.confirm.points);
  if (points.X.rows() == 0) {
    dprintf(messages, "every point of the front that matters has been simulated\n");
    return false;
  }
  dprintf(messages, "round %d: %d points to simulate\n", round, static_cast<int>(points.X.rows()));
  store.add(runs_at(store.identity(), runs, Kind::confirmation, points));
  carry_out_runs(store, folder, settings, messages);
  const auto checked = check_predictions(store.runs(), problem, Kind::confirmation,
                                         static_cast<std::int64_t>(runs.size()) + 1);
  const bool agree = checked.agree() && checked.failed == 0;
  dprintf(messages, "round %d: %s: %s\n", round, text(checked).c_str(),
          agree ? "prediction and simulation agree" : "prediction and simulation do not agree yet");
  return !agree;
}

}  // namespace

int confirm_command(const Study& study, const Settings& settings) {
  const auto objective = [](const doe::Response& response) { return doe::is_objective(response.goal); };
  const auto& responses = study.problem.responses;
  if (settings.confirm.x.empty() && std::none_of(responses.begin(), responses.end(), objective))
    throw UsageError(
        "confirm: no response is minimized or maximized, so there is no front; name points with --x");
  if (!settings.confirm.x.empty()) checked_points(study.problem, settings.confirm.x);
  open_store(study, Folder{settings.out});
  return work_in_folder(
      study, settings, [&](const Folder& folder) { return open_store(study, folder); },
      [&](Store& store, const Folder& folder) {
        store.plan_again(settings.retry_failed);
        carry_out_runs(store, folder, settings, message_descriptor(settings));
        int round = 1;
        while (round <= settings.confirm.rounds && confirm_round(store, folder, settings, round)) ++round;
      });
}

}  // namespace drawpoint::studies
