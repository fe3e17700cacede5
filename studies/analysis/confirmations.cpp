// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/confirmations.h>
#include <drawpoint/pareto/dominance.hpp>

#include <algorithm>

namespace drawpoint::studies {
namespace {

constexpr double two_sided_deviations = 1.959963984540054;  // 95 % of a normal variable

bool counts(const doe::Response& response) { return response.goal != doe::Goal::record; }

bool keeps_limit(const doe::Response& response, double y) {
  return !doe::is_constraint(response.goal) ||
         doe::sign_of(response.goal) * y <= doe::sign_of(response.goal) * response.limit;
}

/// The objectives of a run, minimised. Empty when it failed or breaks a limit: it then dominates nothing.
Eigen::VectorXd minimised_objectives(const Run& run, const doe::Problem& problem) {
  std::vector<double> values;
  if (run.status != Status::done) return {};
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    const doe::Response& response = problem.responses[j];
    const double y = run.y[static_cast<Eigen::Index>(j)];
    if (!keeps_limit(response, y)) return {};
    if (doe::is_objective(response.goal)) values.push_back(doe::sign_of(response.goal) * y);
  }
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

bool dominated_by_earlier(const Run& run, const std::vector<Run>& runs, const doe::Problem& problem) {
  const Eigen::VectorXd own = minimised_objectives(run, problem);
  return own.size() > 0 && std::any_of(runs.begin(), runs.end(), [&](const Run& other) {
           if (other.id >= run.id) return false;
           const Eigen::VectorXd y = minimised_objectives(other, problem);
           return y.size() > 0 && pareto::dominates(y, own);
         });
}

CheckedRun checked_run(const Run& run, const doe::Problem& problem) {
  CheckedRun checked{.run = run.id,
                     .x = run.x,
                     .outcome = run.y,
                     .predicted = run.predicted,
                     .lower = run.predicted,
                     .upper = run.predicted,
                     .within = {}};
  if (run.status == Status::failed) checked.outcome = doe::Failure{run.reason};
  for (Eigen::Index j = 0; j < run.predicted.size(); ++j) {
    const doe::Response& response = problem.responses[static_cast<std::size_t>(j)];
    const double margin = two_sided_deviations * run.deviation[j];
    checked.predicted[j] = doe::within_range(response, run.predicted[j]);
    checked.lower[j] = doe::within_range(response, run.predicted[j] - margin);
    checked.upper[j] = doe::within_range(response, run.predicted[j] + margin);
    checked.within.push_back(run.status == Status::done && run.y[j] >= checked.lower[j] &&
                             run.y[j] <= checked.upper[j]);
  }
  return checked;
}

}  // namespace

CheckedRuns check_predictions(const std::vector<Run>& runs, const doe::Problem& problem, Kind kind,
                              std::int64_t first) {
  CheckedRuns all;
  for (const Run& run : runs) {
    const bool ended = run.status == Status::done || run.status == Status::failed;
    if (run.kind != kind || run.id < first || !ended || !run.predicted.allFinite()) continue;
    CheckedRun checked = checked_run(run, problem);
    if (run.status == Status::failed) {
      ++all.failed;
    } else {
      for (std::size_t j = 0; j < checked.within.size(); ++j) {
        if (!counts(problem.responses[j])) continue;
        ++all.values;
        all.within += checked.within[j];
      }
      checked.dominated = dominated_by_earlier(run, runs, problem);
      all.dominated += checked.dominated;
    }
    all.runs.push_back(std::move(checked));
  }
  return all;
}

}  // namespace drawpoint::studies
