// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Fits Kriging to thousands of runs: `NearestModel model = fit_nearest(X, y);`, or fit_any(X, y), which is
/// fit(X, y) up to 2000 runs.
///
/// θ, the exponents and λ maximise Vecchia's likelihood (detail/nearest/vecchia.hpp), with the prior and the
/// options of fit. Simplified: a run is conditioned on the nearest of earlier ones only, and a prediction
/// rests on the nearest runs (nearest_model.hpp). NearestError says what twice as many would change. Of
/// smooth functions without noise the error of the mean is three to six times that of exact Kriging on the
/// same runs, of rough ones the same. Noise is averaged over the neighbourhood alone: with 2000 runs the
/// error is half as large again, and more runs lower it little (docs/measurements/kriging.md, thousands of
/// runs). λ is never below what the largest blocks need to be factored (detail/nearest/least_nugget.hpp),
/// 1.4e-10 by default.
/// Runs are sorted first and then put in random order, so the order of the rows changes no bit; nor does the
/// number of threads. Cost: a value of the likelihood 4 n neighbours², a gradient three times that, the model
/// 3 n neighbourhood², choosing neighbours 4 n² d/neighbours; memory n (2 d + 30)
/// numbers. Refused: Structure::additive, whose runs tell of each other at any distance, and Trend::blind.

#include <Eigen/Core>
#include <drawpoint/kriging/any_surrogate.hpp>
#include <drawpoint/kriging/nearest_model.hpp>
#include <drawpoint/kriging/options.hpp>

namespace drawpoint::kriging {

/// X: n x d, one run per row, natural units; y: n, any unit. Throws std::invalid_argument as fit, for options
/// out of their range, and for more repeats at one point than half of the neighbours. Repeats that all agree
/// count once, as in fit.
NearestModel fit_nearest(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const FitOptions& given = {},
                         const NearestOptions& nearest = {});

/// fit(X, y, options), bit for bit, up to nearest.exact_up_to runs and fit_nearest(X, y, options, nearest)
/// beyond. Throws as these.
AnySurrogate fit_any(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const FitOptions& options = {},
                     const NearestOptions& nearest = {});

}  // namespace drawpoint::kriging

#ifndef DRAWPOINT_KRIGING_COMPILED
#include <drawpoint/kriging/detail/nearest/fit_definition.hpp>
#endif
