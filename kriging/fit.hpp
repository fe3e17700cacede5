// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Fits Kriging to runs: `Model model = fit(X, y);`
///
/// θ, the exponents and λ maximise the concentrated log likelihood (likelihood.hpp), by default with a prior
/// (prior.hpp); search.hpp says how they are found. The default is regression Kriging with the Gaussian
/// correlation and a constant trend. Isotropic and additive correlations (correlation.hpp) are fitted alike,
/// with fewer and with more parameters.
///
/// Deterministic: equal input gives equal bits on any number of threads. Safe to call concurrently; the last
/// part of the searches then wait for each other. Cost: see search.hpp; O(n²) memory. A model is always
/// valid: see Status for what was met on the way.

#include <Eigen/Core>
#include <concepts>
#include <drawpoint/kriging/model.hpp>
#include <drawpoint/kriging/options.hpp>

namespace drawpoint::kriging {

/// X: n x d, one run per row, natural units; y: n, any unit. Throws std::invalid_argument for no run, unequal
/// lengths, numbers that are not finite, and options out of their range.
Model fit(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const FitOptions& options = {});

/// Stops the compiler at fit(y, X), which the types above would let through.
template <std::same_as<Eigen::VectorXd> Responses, std::same_as<Eigen::MatrixXd> Inputs>
Model fit(const Responses& y, const Inputs& X, const FitOptions& options = {}) {
  static_assert(
      !std::same_as<Responses, Responses>,
      "drawpoint: kriging::fit takes the inputs first: fit(X, y), X one run per row, y one response "
      "per run");
  return fit(X, y, options);
}

}  // namespace drawpoint::kriging

#ifndef DRAWPOINT_KRIGING_COMPILED
#include <drawpoint/kriging/detail/fit_definition.hpp>
#endif
