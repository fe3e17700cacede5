// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far models can be relied on, all of a study with mean errors (kriging/mean_error.hpp).

#include <drawpoint/studies/model/modelled_study.h>
#include <drawpoint/doe/evaluations.hpp>

#include <Eigen/Core>
#include <cstddef>

namespace drawpoint::studies::detail {

/// Errors of the mean over the range, up to which a surrogate is good, and fair.
inline constexpr double good_error = 0.1, fair_error = 0.2;

/// Validation runs, below which errors are rough.
inline constexpr Eigen::Index enough_points = 10;

bool is_poor(const ModelledStudy& study, std::size_t response);

/// Whether single runs of a response scatter by more than its model misses the mean of many, by what the study
/// says of its noise, or else by the noise of the mean error: more runs of the kind do not help then.
bool is_noisy(const ModelledStudy& study, std::size_t response);

/// What a run scatters by in response j with one standard error: as it says itself, or else as the study says of
/// its runs, or else as the model has it. Not a number where nothing is known.
double scatter_of_run(const ModelledStudy& study, std::size_t j, const doe::Evaluation& run);

}  // namespace drawpoint::studies::detail
