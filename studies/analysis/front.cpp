// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/front.h>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/nsga2.hpp>

namespace drawpoint::studies {

pareto::PolishedFront front_of(const std::vector<kriging::Model>& models, const doe::Problem& problem,
                               doe::Seed seed) {
  const kriging::Surrogates means(models);
  auto found =
      pareto::polished_front(means, problem, pareto::nsga2(means, problem, {.search = {.seed = seed}}));
  keep_within_range(found, problem);
  return found;
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
  const std::vector<int> kept = pareto::non_dominated(problem, front.Y);
  front.X = front.X(kept, Eigen::all).eval();
  front.Y = front.Y(kept, Eigen::all).eval();
  front.responses = front.responses(kept, Eigen::all).eval();
  if (found.polishing.residual.size() > 0) found.polishing.residual = found.polishing.residual(kept).eval();
}

}  // namespace drawpoint::studies
