// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/front.h>
#include <drawpoint/doe/detail/nearest.hpp>
#include <drawpoint/doe/detail/unit_box.hpp>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/nsga2.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace drawpoint::studies {

pareto::PolishedFront front_of(const std::vector<kriging::Model>& models, const doe::Problem& problem,
                               doe::Seed seed) {
  const kriging::Surrogates means(models);
  auto found =
      pareto::polished_front(means, problem, pareto::nsga2(means, problem, {.search = {.seed = seed}}));
  keep_within_range(found, problem);
  return found;
}

namespace {

void keep_rows(pareto::PolishedFront& found, const std::vector<int>& kept) {
  pareto::Front& front = found.front;
  front.X = front.X(kept, Eigen::all).eval();
  front.Y = front.Y(kept, Eigen::all).eval();
  front.responses = front.responses(kept, Eigen::all).eval();
  if (found.polishing.residual.size() > 0) found.polishing.residual = found.polishing.residual(kept).eval();
}

/// Places of all runs that ended, and whether every run there failed.
std::pair<Eigen::MatrixXd, std::vector<bool>> places_of(const Tables& tables) {
  std::map<std::vector<double>, bool> failed;
  for (const auto* table : {&tables.training, &tables.validation}) {
    for (const auto& row : table->rows) {
      const auto [place, is_new] = failed.emplace(std::vector<double>(row.x.begin(), row.x.end()), true);
      place->second = place->second && row.outcome.failed();
    }
  }
  std::pair<Eigen::MatrixXd, std::vector<bool>> places;
  places.first.resize(static_cast<Eigen::Index>(failed.size()),
                      static_cast<Eigen::Index>(tables.training.problem.variables.size()));
  for (const auto& [x, all_failed] : failed) {
    places.first.row(static_cast<Eigen::Index>(places.second.size())) =
        Eigen::Map<const Eigen::RowVectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
    places.second.push_back(all_failed);
  }
  return places;
}

}  // namespace

int leave_out_failed(pareto::PolishedFront& found, const Tables& tables) {
  const doe::Problem& problem = tables.training.problem;
  const auto [places, failed] = places_of(tables);
  if (found.front.X.rows() == 0) return 0;
  const auto nearest = doe::detail::nearest_sites(doe::detail::to_unit_box(found.front.X, problem),
                                                  doe::detail::to_unit_box(places, problem));
  std::vector<int> kept;
  for (std::size_t i = 0; i < nearest.site.size(); ++i) {
    if (!failed[static_cast<std::size_t>(nearest.site[i])]) kept.push_back(static_cast<int>(i));
  }
  const auto left_out = static_cast<int>(nearest.site.size() - kept.size());
  if (left_out > 0) keep_rows(found, kept);
  return left_out;
}

PredictedFront predicted_front(const std::vector<kriging::Model>& models, const Tables& tables,
                               doe::Seed seed) {
  const doe::Problem& problem = tables.training.problem;
  PredictedFront predicted;
  const auto objective = [](const doe::Response& response) { return doe::is_objective(response.goal); };
  if (std::none_of(problem.responses.begin(), problem.responses.end(), objective)) return predicted;
  predicted.found = front_of(models, problem, seed);
  predicted.beside_failed = leave_out_failed(predicted.found, tables);
  return predicted;
}

void keep_within_range(pareto::PolishedFront& found, const doe::Problem& problem) {
  pareto::Front& front = found.front;
  if (front.X.rows() == 0) return;
  for (std::size_t r = 0, objective = 0; r < problem.responses.size(); ++r) {
    const doe::Response& response = problem.responses[r];
    const auto bounded = [&](double y) { return doe::within_range(response, y); };
    auto column = front.responses.col(static_cast<Eigen::Index>(r));
    column = column.unaryExpr(bounded).eval();
    if (doe::is_objective(response.goal)) front.Y.col(static_cast<Eigen::Index>(objective++)) = column;
  }
  keep_rows(found, pareto::non_dominated(problem, front.Y));
}

}  // namespace drawpoint::studies
