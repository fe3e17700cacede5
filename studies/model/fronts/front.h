// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The trade-offs that a study's models predict: NSGA-II searches the means of the models, and
/// pareto/polished_front.hpp finishes what it finds with their exact gradients. What a model predicts outside
/// of a response's range counts as the bound there; points that are then dominated are left out. Where runs
/// fail (failures.h) points count as failed in the search, and are left out where polishing leads there. An
/// objective whose model is flat within its own error is no objective (model/fits/flat_responses.h).

#include <drawpoint/studies/model/fits/failures.h>
#include <drawpoint/studies/model/fits/flat_responses.h>
#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <drawpoint/pareto/polished_front.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// models: one per response, in order, of the problem's variables. Deterministic: the seed is that of the
/// search.
pareto::PolishedFront front_of(const std::vector<kriging::TransformedModel>& models,
                               const doe::Problem& problem, doe::Seed seed, const Failures& failures = {});

/// Whether there is anything to search for.
bool has_objective(const doe::Problem& problem);

/// The front of a study, or why it has none.
struct PredictedFront {
  pareto::PolishedFront found;
  Failures failures = {};
  std::string missing = {};  ///< empty where there is a front
  std::vector<FlatResponse> flat = {};
  doe::Problem problem = {};  ///< that was searched: the study's, its flat objectives recorded only
};
PredictedFront predicted_front(const std::vector<kriging::TransformedModel>& models, const Tables& tables,
                               doe::Seed seed);

/// Takes what is predicted as values that the responses can have.
void keep_within_range(pareto::PolishedFront& found, const doe::Problem& problem);

/// Leaves out the points that are avoided.
void leave_out_failed(pareto::PolishedFront& found, const Failures& failures);

}  // namespace drawpoint::studies
