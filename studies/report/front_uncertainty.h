// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How sure the models of a study are of the front that they predict; models/front_uncertainty.h computes it.

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

}  // namespace drawpoint::studies
