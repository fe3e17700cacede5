// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/kriging/acquisition.hpp>
#include <drawpoint/kriging/acquisition_constraints.hpp>
#include <drawpoint/kriging/acquisition_gradient.hpp>
#include <drawpoint/kriging/acquisition_hypervolume.hpp>
#include <drawpoint/kriging/acquisition_joint.hpp>
#include <drawpoint/kriging/any_surrogate.hpp>
#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/compare.hpp>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/count_model.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/error_correlation.hpp>
#include <drawpoint/kriging/fidelity_model.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/fit_fidelities.hpp>
#include <drawpoint/kriging/fit_nearest.hpp>
#include <drawpoint/kriging/fit_radial.hpp>
#include <drawpoint/kriging/mean_error.hpp>
#include <drawpoint/kriging/model.hpp>
#include <drawpoint/kriging/moderated_noise.hpp>
#include <drawpoint/kriging/nearest_model.hpp>
#include <drawpoint/kriging/noise_model.hpp>
#include <drawpoint/kriging/nonstationarity.hpp>
#include <drawpoint/kriging/optimize.hpp>
#include <drawpoint/kriging/options.hpp>
#include <drawpoint/kriging/outliers.hpp>
#include <drawpoint/kriging/polynomial.hpp>
#include <drawpoint/kriging/radial.hpp>
#include <drawpoint/kriging/reinterpolation.hpp>
#include <drawpoint/kriging/replicates.hpp>
#include <drawpoint/kriging/sample_paths.hpp>
#include <drawpoint/kriging/score.hpp>
#include <drawpoint/kriging/signal.hpp>
#include <drawpoint/kriging/success_model.hpp>
#include <drawpoint/kriging/surrogate.hpp>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/kriging/transform.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <drawpoint/kriging/validate.hpp>

/// Kriging models and other surrogates of runs: the whole of the module, in the order of use.
///
/// Fit:
///   fit.hpp                        `Model model = fit(X, y);` by penalised likelihood
///   options.hpp                    what a fit can be told, and what it reports
///   correlation.hpp                Gaussian, power-exponential and Matern correlations
///   transform.hpp                  scales for responses with bounds: square root, logarithm, logit
///   transformed_model.hpp          a model on such a scale, predicting on the response's own
///   choose_fit.hpp                 the way to fit, and the scale, that leave-one-out prefers
///   fit_nearest.hpp                thousands of runs: each prediction by the nearest of them, and fit_any
///   nearest_model.hpp              that model
///   fit_fidelities.hpp             co-Kriging: few true runs and more of a cheaper setting, in one model
///   fidelity_model.hpp             that model
///   replicates.hpp                 repeated runs as one run with a known noise
///   moderated_noise.hpp            variances of few samples, each drawn towards those of all
///   noise_model.hpp                the noise that a run has at a place, from what runs tell of theirs
///   polynomial.hpp                 polynomial regression
///   radial.hpp                     radial basis functions
///   fit_radial.hpp                 their fit
///   count_model.hpp                responses that are counts, often none
///   success_model.hpp              how likely a run succeeds, from runs that did and that failed
///
/// Use:
///   model.hpp                      prediction, variance, gradients; a value that threads may share
///   append.hpp                     more runs without a new fit
///   reinterpolation.hpp            a model that interpolates what a noisy one predicts at its runs
///   sample_paths.hpp               draws of the function at many points at once
///   error_correlation.hpp          responses whose models err together, and draws that do
///   surrogate.hpp                  what all kinds have in common, as concepts
///   any_surrogate.hpp              any kind behind one type
///   surrogates.hpp                 several surrogates as one black box, for searches and polishing
///
/// Validate:
///   validate.hpp                   how well a model predicts runs that it has not seen
///   cross_validation.hpp           leave-one-out, k-fold, hold-out
///   outliers.hpp                   runs that do not belong to the others
///   nonstationarity.hpp            responses that jump, or are rougher or noisier in one part of the box
///   score.hpp                      RMSE, NRMSE, Q2 and their kin
///   mean_error.hpp                 the error of the mean response from noisy runs, with its interval
///   signal.hpp                     whether a model says anything, or is flat within its own error
///   compare.hpp                    several ways to fit, scored alike, and the best of them
///
/// The next run:
///   optimize.hpp                   `Optimum found = optimize(simulate, problem, 60);`: the optimum in one call
///   acquisition.hpp                criteria for doe::propose and doe::refine, such as expected improvement
///   acquisition_constraints.hpp    how likely a point keeps its limits
///   acquisition_gradient.hpp       the knowledge gradient: noisy runs that lower the best prediction most
///   acquisition_hypervolume.hpp    expected hypervolume improvement
///   acquisition_joint.hpp          batches that are worth most together
///   run_gain.hpp                   what one more run teaches, and which runs to make again
///
/// Apart from these, and not included here because they need nlohmann-json: save.hpp, save_fidelities.hpp and
/// save_nearest.hpp, models as JSON files.
/// What stands in detail/ may change in any version. Needs doe, Eigen and Ipopt.
namespace drawpoint::kriging {}
