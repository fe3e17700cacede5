// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A surrogate that says of every point what its first two coordinates say: mean x₀, variance x₁². With it
/// criteria are tested as functions of mean and deviation, without a fit.

#include <Eigen/Core>
#include <drawpoint/kriging/surrogate.hpp>

namespace drawpoint::kriging::reference {

struct NormalSurrogate {
  Eigen::Index first = 0;  ///< which coordinates

  Prediction predict(const Eigen::MatrixXd& X, Target = Target::latent) const {
    return {X.col(first), X.col(first + 1).cwiseAbs2()};
  }
  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const { return X.col(first); }
};

static_assert(Surrogate<NormalSurrogate>);

}  // namespace drawpoint::kriging::reference
