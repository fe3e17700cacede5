// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fronts/confirmations.h>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/filter.hpp>

#include <algorithm>
#include <utility>

namespace drawpoint::studies {
namespace {

Eigen::VectorXd minimised_objectives(const Run& run, const doe::Problem& problem) {
  std::vector<double> values;
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    const doe::Goal goal = problem.responses[j].goal;
    if (doe::is_objective(goal)) values.push_back(doe::sign_of(goal) * run.y[static_cast<Eigen::Index>(j)]);
  }
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// By a run with an id below `before`.
bool is_dominated(const Run& run, const std::vector<Run>& runs, const doe::Problem& problem,
                  std::int64_t before) {
  const Eigen::VectorXd own = minimised_objectives(run, problem);
  return std::any_of(runs.begin(), runs.end(), [&](const Run& other) {
    return other.id < before && other.status == Status::done && pareto::meets_limits(problem, other.y) &&
           pareto::dominates(minimised_objectives(other, problem), own);
  });
}

CheckedRun checked_run(const Run& run, const doe::Problem& problem) {
  CheckedRun checked{.run = run.id, .x = run.x, .outcome = run.y};
  checked.predicted = checked.lower = checked.upper = run.predicted;
  const bool done = run.status == Status::done;
  if (!done) checked.outcome = doe::Failure{run.reason};
  for (Eigen::Index j = 0; j < run.predicted.size(); ++j) {
    const doe::Response& response = problem.responses[static_cast<std::size_t>(j)];
    checked.predicted[j] = doe::within_range(response, run.predicted[j]);
    checked.lower[j] = doe::within_range(response, run.lower[j]);
    checked.upper[j] = doe::within_range(response, run.upper[j]);
    const bool within = done && run.y[j] >= checked.lower[j] && run.y[j] <= checked.upper[j];
    checked.within.push_back(within);
    if (!done || response.goal == doe::Goal::record) continue;
    ++checked.values;
    checked.held += within;
  }
  checked.breaks_limit = done && !pareto::meets_limits(problem, run.y);
  return checked;
}

}  // namespace

CheckedRuns check_predictions(const std::vector<Run>& runs, const doe::Problem& problem, Kind kind,
                              const std::vector<ConfirmationRound>& rounds) {
  CheckedRuns all;
  std::size_t round = 0;
  int points_of_round = 0;
  for (const Run& run : runs) {
    if (run.kind != kind || run.replicate != 0) continue;
    while (round < rounds.size() && rounds[round].first <= run.id) {
      ++round;
      points_of_round = 0;
    }
    ++points_of_round;
    const bool ended = has_ended(run) && !run.left_out;
    // Models of one run know no interval; that it holds is no success.
    if (!ended || !run.predicted.allFinite() || !run.lower.allFinite() || !run.upper.allFinite()) continue;
    CheckedRun checked = checked_run(run, problem);
    checked.round = static_cast<int>(round);
    if (round > 0) {
      checked.named = points_of_round <= rounds[round - 1].named;
      checked.dominated = run.status == Status::done && !checked.named && !checked.breaks_limit &&
                          is_dominated(run, runs, problem, rounds[round - 1].first);
    }
    all.add(std::move(checked));
  }
  return all;
}

}  // namespace drawpoint::studies
