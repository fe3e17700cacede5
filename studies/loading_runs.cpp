// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading_runs.h>
#include <drawpoint/pareto/dominance.hpp>

#include <limits>

namespace drawpoint::studies {

using Eigen::Index;
using Eigen::VectorXd;

LoadingRuns::LoadingRuns(const StudyResults& results) : results_(results) {
  if (results.X.rows() > 0) front_ = pareto::non_dominated(results.problem, results.Y.leftCols<3>());
}

VectorXd LoadingRuns::within(Index r, Index v, double from, double to) const {
  std::vector<Index> rows;
  for (Index i = 0; i < results_.X.rows(); ++i)
    if (results_.X(i, v) >= from && results_.X(i, v) < to) rows.push_back(i);
  return results_.Y(rows, r);
}

std::vector<Criterion> LoadingRuns::ridge(Index r, Index v, double from, double to) const {
  constexpr double end = std::numeric_limits<double>::infinity();
  const VectorXd middle = within(r, v, from, to);
  return {{"middle over lower, in standard deviations", mean_difference(middle, within(r, v, -end, from)),
           small_difference},
          {"middle over upper", mean_difference(middle, within(r, v, to, end)), small_difference}};
}

Criterion LoadingRuns::explains_more(Index r, Index more, Index less) const {
  const auto name = [&](Index v) { return results_.problem.variables[static_cast<std::size_t>(v)].name; };
  const auto explains = [&](Index v) { return explained_share(x(v), y(r), lower(v), upper(v)); };
  return {"share of variance of " + results_.problem.responses[static_cast<std::size_t>(r)].name + ", " +
              name(more) + " less " + name(less),
          difference(explains(more), explains(less))};
}

}  // namespace drawpoint::studies
