// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The trade-offs that a study's models predict: NSGA-II searches the means of the models, and
/// pareto/polished_front.hpp finishes what it finds with their exact gradients. What a model predicts outside of
/// a response's range counts as the bound there; points that are then dominated are left out, and so are those
/// beside failed runs.

#include <drawpoint/studies/analysis/models.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/model.hpp>
#include <drawpoint/pareto/polished_front.hpp>

#include <vector>

namespace drawpoint::studies {

/// models: one per response, in order, of the problem's variables. Deterministic: the seed is that of the
/// search.
pareto::PolishedFront front_of(const std::vector<kriging::Model>& models, const doe::Problem& problem,
                               doe::Seed seed);

/// Leaves out the points whose nearest simulated place (in the unit box) is one where every run failed: models
/// are blind to failures, and what failed is not to be recommended. Returns how many that were.
int leave_out_failed(pareto::PolishedFront& found, const Tables& tables);

struct PredictedFront {
  pareto::PolishedFront found;
  int beside_failed = 0;  ///< points that were left out
};

/// All of the above. Without an objective there is no front.
PredictedFront predicted_front(const std::vector<kriging::Model>& models, const Tables& tables,
                               doe::Seed seed);

/// Takes what is predicted as values that the responses can have.
void keep_within_range(pareto::PolishedFront& found, const doe::Problem& problem);

}  // namespace drawpoint::studies
