// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What runs gain in likelihood when they are taken for exact, and what chance gives (Cox 1961, by simulation).
///
/// A model without noise has as many length scales as there are variables to fit chance with: in seven variables
/// noise about a linear trend gains up to 15 in ln L by the likeliest of them, 9 where length scales are expected as
/// in prior.hpp, and a smooth response with noise loses 10 to 30. So what real runs gain is held against sets of runs
/// that the noisy model makes: it counts where it is more than any set gains, by clear_lead.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/fit_prepared.hpp>
#include <drawpoint/kriging/detail/model_state.hpp>
#include <drawpoint/kriging/detail/search.hpp>
#include <drawpoint/kriging/detail/training_data.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

inline constexpr int few_starts = 2, few_candidates = 32;
inline constexpr int simulated_sets = 16;
inline constexpr double clear_lead = 3.0;  ///< in ln L

inline FitOptions with_few_searches(FitOptions options) {
  options.starts = std::min(options.starts, few_starts);
  options.candidates = std::min(options.candidates, few_candidates);
  return options;
}

/// ln L, but for a constant, of the highest maximum that few searches find; of a part of many runs.
inline double highest_likelihood(const TrainingData& data, const FitOptions& given) {
  const FitOptions options = with_few_searches(given);
  const LikelihoodProblem problem = likelihood_problem(data, options);
  Likelihood likelihood(problem.X.rows() <= many ? problem : thinned(problem));
  const Box box = parameter_box(data, likelihood, options);
  likelihood.value(climbs(likelihood, box, options).front().p());
  return likelihood.estimates().log_likelihood;
}

/// What the runs gain when the options leave them no noise, `without`, beside those that do.
inline double gain_of(const TrainingData& data, const FitOptions& without, const FitOptions& with) {
  return highest_likelihood(data, without) - highest_likelihood(data, with);
}

/// The data with runs that the model makes: its trend and s² R, noise included.
inline TrainingData simulated(const ModelState& model, const TrainingData& data, doe::RandomStream& stream) {
  Eigen::VectorXd normal(model.y.size());
  for (double& z : normal) z = stream.normal();
  TrainingData made = data;
  made.y = product(model.F, model.gls.beta);
  add_product(made.y.data(), std::sqrt(model.process_variance), model.L, normal.data());
  return made;
}

/// Whether a gain is more than chance gives to runs of the noisy model. The first set that gains as much ends it.
inline bool beyond_chance(double gain, const ModelState& noisy, const TrainingData& data,
                          const FitOptions& without, const FitOptions& with) {
  doe::RandomStream stream(doe::run_seed(with.seed, 0, 5));  // not the one that a user may draw noise from
  for (int k = 0; k < simulated_sets; ++k)
    if (!(gain_of(simulated(noisy, data, stream), without, with) + clear_lead < gain)) return false;
  return true;
}

}  // namespace drawpoint::kriging::detail
