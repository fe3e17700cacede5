// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How sure a surrogate is of its mean, as numbers beside its formula (surface.h): the
/// browser computes the same variance as kriging::Model (kriging/model.hpp has the formula), noise of single
/// runs left out.
///
/// With r the correlations of x with the n runs, f the q terms of the trend and L Lᵀ = R, which the browser
/// factors itself from the runs and `noise`:
///   variance of z  s² (1 − |L⁻¹r|² + |f T⁻¹ − r B|²) + |W|²
///   W = Σᵢ wᵢ rᵢ Σₖ (∂ln rᵢ/∂ln θₖ θ_spreadₖ + ∂ln rᵢ/∂pₖ exponent_spreadₖ) + r α_effects + f β_effects
/// The last part is what the estimates of θ, the exponents and the nugget leave unknown
/// (kriging/detail/parameter_uncertainty.hpp). Cost in the browser: n³/3 once, n²/2 per point.

#include <drawpoint/kriging/transformed_model.hpp>

#include <Eigen/Core>
#include <optional>

namespace drawpoint::studies::detail {

/// Beyond so many runs a band costs the browser too long.
inline constexpr Eigen::Index most_runs_of_a_band = 800;

struct SurfaceError {
  Eigen::VectorXd noise;                        ///< n: what the diagonal of R has beyond 1
  double process_variance = 0.0;                ///< s², unit of z squared
  Eigen::MatrixXd B, T;                         ///< n x q, and q x q upper triangular
  Eigen::MatrixXd theta_spread;                 ///< d rows; no columns where the parameters count as known
  Eigen::MatrixXd exponent_spread;              ///< d rows, or none
  Eigen::MatrixXd alpha_effects, beta_effects;  ///< n and q rows, unit of z
};

/// Nothing where surface() has none, where no variance is known, and beyond most_runs_of_a_band.
std::optional<SurfaceError> surface_error(const kriging::TransformedModel& model);

}  // namespace drawpoint::studies::detail
