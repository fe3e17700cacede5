// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The models of a study: one Kriging model per response, its scale, correlation and trend chosen by
/// leave-one-out, and validated on the validation runs. Failed runs are left out. Deterministic.

#include <drawpoint/studies/model/fits/run_noise.h>
#include <drawpoint/studies/model/fits/tables.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/validate.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace drawpoint::studies {

/// What the runs that succeeded tell of the noise of a response (doe::Response::standard_error); nothing
/// where they do not, tell none but 0, or one tells what cannot be.
kriging::RunNoise told_noise(const doe::Evaluations& runs, const doe::Response& response);

struct StudyWay : kriging::WayToFit {
  kriging::NoiseSource noise_source = kriging::NoiseSource::estimated;
};

/// The ways to fit a response of runs on this scale that are compared: smooth and less smooth, without and with a
/// slope, with noise from this source. The first is the default.
std::vector<StudyWay> ways_to_fit(const doe::Evaluations& runs, const doe::Response& response,
                                  kriging::Scale scale,
                                  kriging::NoiseSource source = kriging::NoiseSource::estimated);

/// Where noise is taken from without a reason for another source: of what the runs tell, together, or of their
/// likelihood where they tell nothing.
kriging::NoiseSource first_source(const kriging::RunNoise& noise);

struct Models {
  std::vector<kriging::TransformedModel> models;  ///< one per response, in order
  std::vector<std::string> ways;                  ///< how each was fitted: a name of ways_to_fit
  std::vector<kriging::NoiseSource> noise;        ///< where each has the noise of a run from
  std::vector<kriging::Validation> validations;   ///< one per response; empty without validation runs
  std::vector<kriging::MeanError> mean_errors;    ///< one per validation
};

/// The scale is that of kriging::choose_scale among those that the response's range allows, the way to fit on
/// it that of kriging::choose_fit, and where the runs tell their noise, the source of it that of
/// kriging::choose_refitted. Throws std::invalid_argument if the runs do not allow models.
Models fit_models(const Tables& tables);

/// The same, for who cannot go on without: std::runtime_error says what to do.
Models models_or_reason(const Tables& tables);

/// "NRMSE production 0.03 of the mean (0.21 of runs), spill 0.09", but for standard errors; empty without
/// validation runs.
std::string nrmse_text(const Models& fitted, const doe::Problem& problem);

/// The points (n x d) with what the models expect of one run there, its noise included, within the ranges of
/// the problem's responses.
PlannedPoints with_predictions(const std::vector<kriging::TransformedModel>& models,
                               const doe::Problem& problem, const Eigen::MatrixXd& X);

}  // namespace drawpoint::studies
