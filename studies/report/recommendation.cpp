// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/report/mean_paths.h>
#include <drawpoint/studies/report/recommendation.h>
#include <drawpoint/studies/report/summary.h>
#include <drawpoint/pareto/filter.hpp>
#include <drawpoint/pareto/minimised.hpp>

#include <algorithm>
#include <cmath>

namespace drawpoint::studies {
namespace {

constexpr double enough_success = 0.9;
constexpr double as_good = 0.05;     // of an objective's range on the front
constexpr double round_off = 1e-12;  // of a mean, by how many points are predicted at once

using detail::objectives;

/// What a place is held against.
struct Standard {
  Eigen::VectorXd means;  ///< at the reference
  bool binding = false;   ///< a place must be no worse in any objective
};

bool is_no_worse(const ReportInput& input, const Eigen::VectorXd& means, const Eigen::VectorXd& than) {
  for (const std::size_t j : objectives(input.problem)) {
    const auto k = static_cast<Eigen::Index>(j);
    const double sign = doe::sign_of(input.problem.responses[j].goal);
    if (sign * means[k] > sign * than[k] + round_off * std::abs(than[k])) return false;
  }
  return true;
}

std::vector<int> likely_rows(const ReportInput& input) {
  std::vector<int> rows, all;
  for (Eigen::Index i = 0; i < input.front.X.rows(); ++i) {
    all.push_back(static_cast<int>(i));
    if (input.success.size() == 0 || input.success[i] >= enough_success) rows.push_back(static_cast<int>(i));
  }
  return rows.empty() ? all : rows;
}

/// The row of the front that the rule names; says in `standard` whether the reference binds.
int best_row(const ReportInput& input, Standard& standard) {
  const Eigen::MatrixXd means = predicted_means(input, input.front.X);
  const std::vector<int> likely = likely_rows(input);
  std::vector<int> better;
  if (pareto::meets_limits(input.problem, standard.means))
    std::copy_if(likely.begin(), likely.end(), std::back_inserter(better),
                 [&](int row) { return is_no_worse(input, means.row(row).transpose(), standard.means); });
  standard.binding = !better.empty();
  const std::vector<int>& rows = better.empty() ? likely : better;
  const Eigen::VectorXd distance = distance_from_best(input, means);
  return *std::min_element(rows.begin(), rows.end(), [&](int a, int b) { return distance[a] < distance[b]; });
}

bool does_as_well(const ReportInput& input, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::MatrixXd both(2, a.size());
  both << a.transpose(), b.transpose();
  const Eigen::MatrixXd means = predicted_means(input, both);
  if (detail::largest_difference(input.problem, a, b) <= same_place) return true;
  const auto chosen = objectives(input.problem);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const auto y = input.front.Y.col(static_cast<Eigen::Index>(k));
    const auto j = static_cast<Eigen::Index>(chosen[k]);
    if (!(std::abs(means(0, j) - means(1, j)) <= as_good * (y.maxCoeff() - y.minCoeff()))) return false;
  }
  return true;
}

/// The simulated place that takes the stead of x, or nullptr.
const CheckedRun* simulated_in_stead(const ReportInput& input, const Eigen::VectorXd& x,
                                     const Standard& standard) {
  const CheckedRun* nearest = nullptr;
  double least = 0;
  for (const CheckedRun& run : input.confirmations.runs) {
    if (run.outcome.failed() || run.breaks_limit) continue;
    const Eigen::MatrixXd means = predicted_means(input, run.x.transpose());
    const double distance = distance_from_best(input, means)[0];
    if (nearest && distance >= least) continue;
    if (standard.binding && !is_no_worse(input, means.row(0).transpose(), standard.means)) continue;
    if (!does_as_well(input, run.x, x)) continue;
    nearest = &run;
    least = distance;
  }
  return nearest;
}

std::vector<const doe::Evaluation*> runs_at(const ReportInput& input, const Eigen::VectorXd& x) {
  std::vector<const doe::Evaluation*> there;
  for (const auto* table : {&input.training, &input.validation})
    for (const doe::Evaluation& e : table->rows)
      if (!e.outcome.failed() && detail::largest_difference(input.problem, e.x, x) <= same_place)
        there.push_back(&e);
  std::sort(there.begin(), there.end(), [](const auto* a, const auto* b) { return a->run > b->run; });
  return there;
}

std::vector<Gain> gains_of(const ReportInput& input, const Eigen::VectorXd& x, const Standard& standard,
                           const Eigen::VectorXd& reference) {
  const Eigen::VectorXd means = predicted_means(input, x.transpose()).row(0);
  std::vector<Gain> gains;
  for (const std::size_t j : objectives(input.problem)) {
    const auto k = static_cast<Eigen::Index>(j);
    const Ends ends = ends_of_difference(input.models[j], input.problem.responses[j], x, reference);
    gains.push_back({j, means[k], standard.means[k], ends.lower, ends.upper});
  }
  return gains;
}

}  // namespace

Reference reference_of(const doe::Problem& problem, const std::vector<Mark>& marks) {
  for (const Mark& mark : marks)
    if (mark.name == reference_name) return {mark.name, mark.x};
  return {"the middle of the box", middle_of(problem)};
}

Eigen::MatrixXd predicted_means(const ReportInput& input, const Eigen::MatrixXd& X) {
  Eigen::MatrixXd means(X.rows(), static_cast<Eigen::Index>(input.models.size()));
  for (std::size_t j = 0; j < input.models.size(); ++j)
    means.col(static_cast<Eigen::Index>(j)) = input.models[j].mean(X).unaryExpr(
        [&](double y) { return doe::within_range(input.problem.responses[j], y); });
  return means;
}

Eigen::VectorXd distance_from_best(const ReportInput& input, const Eigen::MatrixXd& means) {
  const auto chosen = objectives(input.problem);
  const Eigen::MatrixXd front = pareto::minimised(input.problem, input.front.Y);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(means.rows());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const double sign = doe::sign_of(input.problem.responses[chosen[k]].goal);
    const double low = front.col(column).minCoeff(), range = front.col(column).maxCoeff() - low;
    if (!(range > 0)) continue;
    const auto y = sign * means.col(static_cast<Eigen::Index>(chosen[k])).array();
    squares.array() += ((y - low) / range).max(0.0).square();
  }
  return squares.cwiseSqrt();
}

std::optional<Recommendation> recommend(const ReportInput& input) {
  return recommend(input, reference_of(input.problem, input.marks));
}

std::optional<Recommendation> recommend(const ReportInput& input, const Reference& reference) {
  if (input.models.empty() || input.front.X.rows() == 0) return {};
  Recommendation found;
  found.reference = reference;
  Standard standard{predicted_means(input, found.reference.x.transpose()).row(0)};
  found.row = best_row(input, standard);
  found.x = input.front.X.row(found.row);
  if (const CheckedRun* run = simulated_in_stead(input, found.x, standard)) {
    found.x = run->x;
    found.row = -1;
  }
  found.simulated = runs_at(input, found.x);
  found.gains = gains_of(input, found.x, standard, found.reference.x);
  return found;
}

}  // namespace drawpoint::studies
