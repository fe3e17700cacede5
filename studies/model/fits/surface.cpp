// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/model/fits/surface.h>
#include <drawpoint/doe/sensitivity.hpp>
#include <drawpoint/kriging/surrogates.hpp>

#include <tuple>

namespace drawpoint::studies::detail {

std::optional<Surface> surface(const kriging::TransformedModel& model) {
  const auto& state = model.model().state();
  if (state.trend.by_user() || state.correlation.structure == kriging::Structure::additive)
    return std::nullopt;
  Surface s{state.input.centre, state.input.factor, state.correlation, state.X, {}, {}, {},
            state.y_centre,     model.transform()};
  if (s.transform.scale != kriging::Scale::linear)
    std::tie(s.noise, s.noise_weights) = kriging::noise_points(model.noise_variance());
  if (state.X.rows() == 0) return s;
  s.weights = state.y_scale * state.gls.alpha;
  s.terms = state.trend.terms;
  s.coefficients = model.model().trend_coefficients();
  return s;
}

std::vector<Eigen::VectorXd> influence(const std::vector<kriging::TransformedModel>& models,
                                       const doe::Problem& problem) {
  std::vector<Eigen::VectorXd> total;
  if (models.empty()) return total;
  const doe::Sensitivity found =
      doe::sobol_indices(kriging::Surrogates(models), problem, {.samples = 512, .resamples = 100});
  for (const doe::SobolIndices& response : found.responses)
    total.push_back(response.total.value.array().isFinite().select(response.total.value, 0.0));
  return total;
}

}  // namespace drawpoint::studies::detail
