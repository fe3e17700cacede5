// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What fit.hpp declares.

#include <Eigen/Core>
#include <algorithm>
#include <drawpoint/kriging/detail/blind.hpp>
#include <drawpoint/kriging/detail/compiled.hpp>
#include <drawpoint/kriging/detail/fit_prepared.hpp>
#include <drawpoint/kriging/detail/training_data.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <vector>

namespace drawpoint::kriging {
namespace detail {

inline constexpr double exact_nugget = 1e-6;  // at most, of exact runs: round-off of smooth responses

/// What Noise::none stands for.
inline FitOptions with_exact_runs(FitOptions options) {
  options.estimation = Estimation::maximum_likelihood;
  options.nugget_upper = std::max(options.nugget_lower, std::min(options.nugget_upper, exact_nugget));
  return options;
}

}  // namespace detail

DRAWPOINT_KRIGING_INLINE Model fit(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                                   const FitOptions& given) {
  const FitOptions options = given.noise == Noise::none ? detail::with_exact_runs(given) : given;
  const detail::TrainingData data = detail::prepare(X, y, options);
  if (data.y.size() == 0) return detail::constant_model(data, options);
  const Model model = detail::fit_prepared(data, options);
  if (options.trend != Trend::blind) return model;
  const std::vector<TrendTerm> terms = detail::blind_terms(model.state());
  if (terms.size() == 1) return model;
  detail::TrainingData chosen = data;
  detail::set_trend(chosen, X, {terms, {}, {}});
  const Model blind = detail::fit_prepared(chosen, options);
  return detail::leave_one_out_error(blind.state()) < detail::leave_one_out_error(model.state()) ? blind
                                                                                                 : model;
}

}  // namespace drawpoint::kriging
