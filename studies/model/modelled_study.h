// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A study with its models, and all that was computed with them: what the report and the commands speak of.

#include <drawpoint/studies/model/fits/flat_responses.h>
#include <drawpoint/studies/model/fits/run_noise.h>
#include <drawpoint/studies/model/fronts/checked_runs.h>
#include <drawpoint/studies/model/fronts/front_uncertainty.h>
#include <drawpoint/studies/model/haul_choice.h>
#include <drawpoint/studies/model/recommended.h>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/pareto/polishing.hpp>
#include <drawpoint/pareto/search.hpp>
#include <drawpoint/studies/headline.hpp>
#include <drawpoint/studies/mark.hpp>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace drawpoint::studies {

struct ModelledStudy {
  std::vector<Headline> headlines = {};  ///< what the study says first, the noise of its runs among it
  doe::Problem problem;                  ///< what was searched: flat objectives are recorded only
  std::vector<FlatResponse> flat = {};   ///< with the goals that the study has for them
  doe::Evaluations training, validation;
  std::vector<kriging::TransformedModel>
      models;  ///< one per response, in order; empty when none could be fitted
  std::vector<kriging::Validation> validations;      ///< one per response; empty without validation runs
  std::vector<kriging::MeanError> mean_errors = {};  ///< one per validation; empty: as the page finds them
  pareto::Front front;                               ///< found on the models; no rows when there is none
  std::string no_front = {};                         ///< why there is none; empty where there is one
  Eigen::VectorXd success = {};       ///< of a run at each point of the front; empty: no run failed
  FrontUncertainty uncertainty = {};  ///< of the front
  std::vector<Mark> marks = {};       ///< points with names
  std::optional<Recommendation> recommended = {};  ///< what recommend() finds in all this; empty: nothing
  CheckedRuns confirmations = {};                  ///< points of predicted fronts that were simulated
  pareto::Polishing polishing;                     ///< of the front
  std::string not_polished;                        ///< why it was not; empty when it was
  std::optional<HaulChoice> hauls = {};            ///< what other hauls would change, where the study knows
};

}  // namespace drawpoint::studies
