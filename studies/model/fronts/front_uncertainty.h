// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How likely each point of a predicted front is on the front, and where the front may lie, by draws of the
/// models (pareto/non_domination.hpp, pareto/attainment.hpp).
///
/// Each response is drawn at all points of the front together (kriging/sample_paths.hpp), so that points near
/// each other err alike, and the responses err together as far as the runs that are left out show it
/// (kriging/error_correlation.hpp). They are of the mean of many runs: the
/// noise of single runs is not in them. A response on another scale is drawn there and taken back, and values
/// are kept within the response's range.
///
/// Simplified: only the points of the front compete, so that a better point between them, or elsewhere, is
/// not counted against them, and the band is no narrower than that of more points. Where runs fail is not in
/// the draws. Probabilities are known within 0.016, one standard error. Cost: with n points about 10 n³ per
/// response and a sort per draw. Equal seeds give equal bits.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <drawpoint/pareto/search.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace drawpoint::studies {

/// Where the best trade-off of two objectives alone may lie, the other objectives left free: values of the
/// second that some point reaches which is as good as `at` in the first, in 5, 50 and 95 of 100 draws of the
/// models. Infinite where fewer draws reach it.
struct PairBand {
  std::size_t first = 0, second = 0;  ///< columns of the front
  Eigen::VectorXd at = {};            ///< rising, unit of the first
  Eigen::VectorXd optimistic = {}, median = {}, pessimistic = {};
};

/// Empty where it is unknown.
struct FrontUncertainty {
  Eigen::VectorXd non_dominated = {};  ///< probability of each point of the front
  std::vector<PairBand> bands = {};    ///< of each pair of objectives
};

/// One model per response, in order. Empty without a front, and where a model knows no variance.
FrontUncertainty uncertainty_of(const pareto::Front& front,
                                const std::vector<kriging::TransformedModel>& models,
                                const doe::Problem& problem, doe::Seed seed);

}  // namespace drawpoint::studies
