// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/runs/plan.h>
#include <drawpoint/studies/sampling/adaptive.h>
#include <drawpoint/studies/sampling/criteria.h>
#include <drawpoint/doe/propose.hpp>

#include <algorithm>

namespace drawpoint::studies {

std::vector<Run> next_batch(const Identity& identity, const Sampling& sampling, const std::vector<Run>& runs,
                            const std::vector<kriging::Model>& models) {
  const int missing = sampling.points - count_points(runs, Kind::adaptive);
  if (missing <= 0) return {};
  const doe::Seed seed = seed_of_choice(identity, runs.size());
  const Eigen::MatrixXd X = doe::propose(tables_of(runs, identity.problem).training,
                                         mix_of(criteria_from(sampling.criteria), models, seed),
                                         {.seed = seed, .batch = std::min(missing, sampling.batch)});
  return runs_at(identity, runs, Kind::adaptive, with_predictions(models, X));
}

bool target_met(const Sampling& sampling, const std::vector<kriging::Validation>& validations) {
  if (sampling.target <= 0.0 || validations.empty()) return false;
  return std::all_of(validations.begin(), validations.end(),
                     [&](const kriging::Validation& v) { return v.nrmse <= sampling.target; });
}

}  // namespace drawpoint::studies
