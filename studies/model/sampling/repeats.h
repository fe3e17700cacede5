// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points to run again, where the noise of runs limits the models: the criterion repeat.
///
/// A run again at a point lowers the mean variance of each model over the box by what kriging/run_gain.hpp
/// says, with the noise that the model found or, where runs tell theirs, is expected there. The points with
/// the largest sum over the responses, each divided by its range on the scale of its model, are chosen one
/// after the other; none where a new point would gain more than five times as much, nor where runs fail.
/// Responses with noise below 0.1 % of their range do not count, nor do standard errors that runs tell.

#include <drawpoint/studies/model/fits/failures.h>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/transformed_model.hpp>

#include <Eigen/Core>
#include <vector>

namespace drawpoint::studies {

struct RepeatSettings {
  doe::Seed seed = 1;  ///< of the places where the models are to be good
  int count = 1;       ///< points, 0 or more
  int replicates = 1;  ///< runs that each of them gets, 1 or more
};

/// `count` rows at most, points of runs that succeeded, natural units; a point may come more than once.
/// models: one per response, of these runs.
Eigen::MatrixXd points_to_repeat(const doe::Evaluations& runs,
                                 const std::vector<kriging::TransformedModel>& models,
                                 const Failures& failures, const RepeatSettings& settings);

}  // namespace drawpoint::studies
