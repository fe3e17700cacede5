// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/models/failures.h>
#include <drawpoint/studies/runs/plan.h>
#include <drawpoint/studies/sampling/adaptive.h>
#include <drawpoint/studies/sampling/criteria.h>
#include <drawpoint/doe/propose.hpp>

#include <algorithm>
#include <stdexcept>

namespace drawpoint::studies {

Batch next_batch(const Identity& identity, const Sampling& sampling, const std::vector<Run>& runs) {
  const int missing = sampling.points - count_points(runs, Kind::adaptive);
  if (missing <= 0) return {};
  const Tables tables = tables_of(runs, identity.problem);
  Models fitted;
  try {
    fitted = fit_models(tables);
  } catch (const std::invalid_argument& e) {
    return {.status = BatchStatus::no_models, .message = e.what()};
  }
  const std::string nrmse = nrmse_text(fitted, identity.problem);
  Batch batch{.status = BatchStatus::target_met,
              .message = std::to_string(tables.training.rows.size()) + " runs for the models so far" +
                         (nrmse.empty() ? "" : "; " + nrmse)};
  if (target_met(sampling, fitted.validations)) return batch;
  const doe::Seed seed = seed_of_choice(identity, runs.size());
  const Failures failures(tables);
  const Eigen::MatrixXd X =
      doe::propose(tables.training, mix_of(criteria_from(sampling.criteria), fitted.models, failures, seed),
                   {.seed = seed,
                    .batch = std::min(missing, sampling.batch),
                    .allowed = [&failures](const Eigen::VectorXd& x) {
                      return !failures.avoided(x.transpose()).front();
                    }});
  if (X.rows() == 0) {
    batch.status = BatchStatus::exhausted;
    batch.message = "no place is left where a run would be new and likely to succeed";
    return batch;
  }
  batch.status = BatchStatus::planned;
  batch.runs = runs_at(identity, runs, Kind::adaptive, with_predictions(fitted.models, identity.problem, X));
  return batch;
}

bool target_met(const Sampling& sampling, const std::vector<kriging::Validation>& validations) {
  if (sampling.target <= 0.0 || validations.empty()) return false;
  return std::all_of(validations.begin(), validations.end(),
                     [&](const kriging::Validation& v) { return v.nrmse <= sampling.target; });
}

}  // namespace drawpoint::studies
