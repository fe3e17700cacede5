// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/model/fits/surface_error.h>
#include <drawpoint/kriging/detail/parameter_places.hpp>
#include <drawpoint/kriging/detail/parameter_uncertainty.hpp>

#include <cmath>

namespace drawpoint::studies::detail {

namespace {

void add_parameters(SurfaceError& error, const kriging::detail::ModelState& state) {
  const kriging::detail::ParameterEffects effects = kriging::detail::parameter_effects(state);
  if (effects.none()) return;
  const Eigen::Index d = state.X.cols();
  const Eigen::MatrixXd& spread = state.parameter_spread;
  const auto places = kriging::detail::places_among(state.correlation, d, spread.rows());
  error.theta_spread.resize(d, spread.cols());
  if (places.exponents) error.exponent_spread.resize(d, spread.cols());
  for (Eigen::Index k = 0; k < d; ++k) {
    error.theta_spread.row(k) = spread.row(places.theta(k));
    if (places.exponents) error.exponent_spread.row(k) = spread.row(places.exponent(k));
  }
  error.alpha_effects = state.y_scale * effects.alpha;
  error.beta_effects = state.y_scale * effects.beta;
}

}  // namespace

std::optional<SurfaceError> surface_error(const kriging::TransformedModel& model) {
  const auto& state = model.model().state();
  if (state.trend.by_user() || state.correlation.structure == kriging::Structure::additive) return {};
  if (state.X.rows() > most_runs_of_a_band) return {};
  SurfaceError error;
  if (state.X.rows() == 0) {
    error.process_variance = state.constant_variance;
  } else {
    error.noise = kriging::detail::added_noise(state);
    error.process_variance = model.model().process_variance();
    error.B = state.gls.B;
    error.T = state.gls.T;
    add_parameters(error, state);
  }
  if (!std::isfinite(error.process_variance)) return {};
  return error;
}

}  // namespace drawpoint::studies::detail
