// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/mean_paths.h>
#include <drawpoint/studies/model/fits/same_place.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/model/recommendation.h>
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

/// n x r, within the ranges of the responses.
Eigen::MatrixXd means_of(const std::vector<kriging::TransformedModel>& models, const doe::Problem& problem,
                         const Eigen::MatrixXd& X) {
  Eigen::MatrixXd means(X.rows(), static_cast<Eigen::Index>(models.size()));
  for (std::size_t j = 0; j < models.size(); ++j)
    means.col(static_cast<Eigen::Index>(j)) =
        models[j].mean(X).unaryExpr([&](double y) { return doe::within_range(problem.responses[j], y); });
  return means;
}

Eigen::MatrixXd means_at(const Choice& choice, const Eigen::MatrixXd& X) {
  return means_of(choice.models, choice.problem, X);
}

/// From the best of every objective at once, each scaled to its range on the front, of rows of means.
Eigen::VectorXd distance_from_best(const Choice& choice, const Eigen::MatrixXd& means) {
  const auto chosen = objectives(choice.problem);
  const Eigen::MatrixXd front = pareto::minimised(choice.problem, choice.front.Y);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(means.rows());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const double sign = doe::sign_of(choice.problem.responses[chosen[k]].goal);
    const double low = front.col(column).minCoeff(), range = front.col(column).maxCoeff() - low;
    if (!(range > 0)) continue;
    const auto y = sign * means.col(static_cast<Eigen::Index>(chosen[k])).array();
    squares.array() += ((y - low) / range).max(0.0).square();
  }
  return squares.cwiseSqrt();
}

bool is_no_worse(const Choice& choice, const Eigen::VectorXd& means, const Eigen::VectorXd& than) {
  for (const std::size_t j : objectives(choice.problem)) {
    const auto k = static_cast<Eigen::Index>(j);
    const double sign = doe::sign_of(choice.problem.responses[j].goal);
    if (sign * means[k] > sign * than[k] + round_off * std::abs(than[k])) return false;
  }
  return true;
}

std::vector<int> likely_rows(const Choice& choice) {
  std::vector<int> rows, all;
  for (Eigen::Index i = 0; i < choice.front.X.rows(); ++i) {
    all.push_back(static_cast<int>(i));
    if (choice.success.size() == 0 || choice.success[i] >= enough_success)
      rows.push_back(static_cast<int>(i));
  }
  return rows.empty() ? all : rows;
}

/// The row of the front that the rule names; says in `standard` whether the reference binds.
int best_row(const Choice& choice, Standard& standard) {
  const Eigen::MatrixXd means = means_at(choice, choice.front.X);
  const std::vector<int> likely = likely_rows(choice);
  std::vector<int> better;
  if (pareto::meets_limits(choice.problem, standard.means))
    std::copy_if(likely.begin(), likely.end(), std::back_inserter(better),
                 [&](int row) { return is_no_worse(choice, means.row(row).transpose(), standard.means); });
  standard.binding = !better.empty();
  const std::vector<int>& rows = better.empty() ? likely : better;
  const Eigen::VectorXd distance = distance_from_best(choice, means);
  return *std::min_element(rows.begin(), rows.end(), [&](int a, int b) { return distance[a] < distance[b]; });
}

bool does_as_well(const Choice& choice, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::MatrixXd both(2, a.size());
  both << a.transpose(), b.transpose();
  const Eigen::MatrixXd means = means_at(choice, both);
  if (is_same_place(choice.problem, a, b)) return true;
  const auto chosen = objectives(choice.problem);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const auto y = choice.front.Y.col(static_cast<Eigen::Index>(k));
    const auto j = static_cast<Eigen::Index>(chosen[k]);
    if (!(std::abs(means(0, j) - means(1, j)) <= as_good * (y.maxCoeff() - y.minCoeff()))) return false;
  }
  return true;
}

/// The simulated place that takes the stead of x, or nullptr.
const CheckedRun* simulated_in_stead(const Choice& choice, const Eigen::VectorXd& x,
                                     const Standard& standard) {
  const CheckedRun* nearest = nullptr;
  double least = 0;
  for (const CheckedRun& run : choice.confirmations.runs) {
    if (run.outcome.failed() || run.breaks_limit) continue;
    const Eigen::MatrixXd means = means_at(choice, run.x.transpose());
    const double distance = distance_from_best(choice, means)[0];
    if (nearest && distance >= least) continue;
    if (standard.binding && !is_no_worse(choice, means.row(0).transpose(), standard.means)) continue;
    if (!does_as_well(choice, run.x, x)) continue;
    nearest = &run;
    least = distance;
  }
  return nearest;
}

Standard standard_at(const Choice& choice, const Eigen::VectorXd& reference) {
  return {means_at(choice, reference.transpose()).row(0)};
}

struct ChosenPlace {
  Eigen::VectorXd x;
  int row;  ///< of the front; -1: it was simulated
};

ChosenPlace chosen_place(const Choice& choice, Standard standard) {
  const int row = best_row(choice, standard);
  const Eigen::VectorXd x = choice.front.X.row(row);
  if (const CheckedRun* run = simulated_in_stead(choice, x, standard)) return {run->x, -1};
  return {x, row};
}

std::vector<doe::Evaluation> runs_at(const ModelledStudy& study, const Eigen::VectorXd& x) {
  std::vector<doe::Evaluation> there;
  for (const auto* table : {&study.training, &study.validation})
    for (const doe::Evaluation& e : table->rows)
      if (!e.outcome.failed() && is_same_place(study.problem, e.x, x)) there.push_back(e);
  std::sort(there.begin(), there.end(), [](const auto& a, const auto& b) { return a.run > b.run; });
  return there;
}

std::vector<Gain> gains_of(const ModelledStudy& study, const Eigen::VectorXd& x, const Standard& standard,
                           const Eigen::VectorXd& reference) {
  const Eigen::VectorXd means = predicted_means(study, x.transpose()).row(0);
  std::vector<Gain> gains;
  for (const std::size_t j : objectives(study.problem)) {
    const auto k = static_cast<Eigen::Index>(j);
    const Ends ends = ends_of_difference(study.models[j], study.problem.responses[j], x, reference);
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

Eigen::MatrixXd predicted_means(const ModelledStudy& study, const Eigen::MatrixXd& X) {
  return means_of(study.models, study.problem, X);
}

int recommended_row(const Choice& choice) {
  if (choice.models.empty() || choice.front.X.rows() == 0) return -1;
  return chosen_place(choice, standard_at(choice, reference_of(choice.problem, choice.marks).x)).row;
}

std::optional<Recommendation> recommend(const ModelledStudy& study) {
  return recommend(study, reference_of(study.problem, study.marks));
}

std::optional<Recommendation> recommend(const ModelledStudy& study, const Reference& reference) {
  if (study.models.empty() || study.front.X.rows() == 0) return {};
  const Choice choice{study.problem, study.models,        study.front,
                      study.marks,   study.confirmations, study.success};
  const Standard standard = standard_at(choice, reference.x);
  const ChosenPlace place = chosen_place(choice, standard);
  return Recommendation{.x = place.x,
                        .row = place.row,
                        .simulated = runs_at(study, place.x),
                        .reference = reference,
                        .gains = gains_of(study, place.x, standard, reference.x)};
}

}  // namespace drawpoint::studies
