// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// By how much a model misses the mean response, and what single runs scatter by beside it.

#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/kriging/mean_error.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <drawpoint/studies/headline.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// What runs may report of their noise, unit of the response squared: it is squared again.
inline constexpr double most_told_variance = 1e150;

/// By the noise that the validation runs report of the response (doe::Response::standard_error), or else by
/// the noise of the model. Noise below a tenth of the error, or as small beside the range of the runs as the
/// least that a fit can have, counts as none, and so does what a flat model takes for noise where no run
/// reports any: it holds the signal that the model did not find. Its range is that of all runs, training runs too: a
/// dozen validation runs span what chance gives them. NaN without validation runs.
kriging::MeanError mean_error_of(const kriging::Validation& v, const kriging::TransformedModel& model,
                                 const doe::Evaluations& training, const doe::Evaluations& validation,
                                 const doe::Response& response);

/// The same by the noise of the model alone.
kriging::MeanError mean_error_of(const kriging::Validation& v, const kriging::TransformedModel& model,
                                 const doe::Problem& problem);

/// What the study itself says that single runs of a response scatter by: its headline noise_of_RESPONSE, in
/// the response's unit; not a number where it has none.
inline double told_noise(const std::vector<Headline>& headlines, const std::string& response) {
  for (const Headline& h : headlines)
    if (h.name == "noise_of_" + response) return h.value;
  return std::numeric_limits<double>::quiet_NaN();
}

/// What a run itself says of its standard error in response j, by the values of all its responses; not a number
/// where it says nothing.
inline double told_error(const doe::Problem& problem, std::size_t j, const Eigen::VectorXd& values) {
  const std::string& name = problem.responses[j].standard_error;
  if (name.empty()) return std::numeric_limits<double>::quiet_NaN();
  return values[doe::response_index(problem, name)];
}

/// Whether single runs scatter by more than the model misses the mean of many, so that more runs of the kind
/// do not help; by what the study says of its noise (`told`), or else by that of the mean error.
inline bool noise_leads(const kriging::Validation& v, const kriging::MeanError& error, double told) {
  if (std::isfinite(told)) return 2 * told * told > v.rmse * v.rmse;
  return error.noise > error.rmse;
}

}  // namespace drawpoint::studies
