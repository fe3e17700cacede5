// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the page needs of a surrogate: its mean, as a formula that the browser evaluates, and which variables
/// matter.
///
/// The mean is trend + Σᵢ wᵢ exp(-Σₖ ϑₖ (sₖ(x) - cᵢₖ)²) with s scaling a box to [-1, 1]. The weights w are
/// recovered from the model's own means at the training points c, so that it does not matter how replicates
/// were treated. Cost n³/6.
///
/// Influence is the total Sobol index by Jansen's estimator (Jansen 1999, Comput. Phys. Commun. 117, eq. 9;
/// Saltelli et al. 2010, table 2): Tₖ = ½ E[(f(a) - f(aᵦₖ))²] / Var f, over the box with uniform weight, 512
/// (d + 2) means.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/model.hpp>

#include <Eigen/Core>
#include <optional>

namespace drawpoint::studies::detail {

struct Surface {
  Eigen::VectorXd lower, upper;  ///< box that s scales, natural units
  Eigen::MatrixXd X;             ///< n x d, the c, scaled
  Eigen::VectorXd weights;       ///< n, unit of the response
};

/// X: the training points, n x d, natural units. Nothing when the formula misses the model's mean by more
/// than 1 in 1000 of its range: then the model was not fitted to these points.
std::optional<Surface> surface(const kriging::Model& model, const doe::Problem& problem,
                               const Eigen::MatrixXd& X);

/// d total indices; all zero when the mean is constant. Deterministic.
Eigen::VectorXd influence(const kriging::Model& model, const doe::Problem& problem);

}  // namespace drawpoint::studies::detail
