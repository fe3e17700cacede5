// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Local non-linearity: how far the neighbours of a site lie off the plane through it.
///
/// With P the positions of k neighbours relative to the site (k x d) and Δy their responses less the site's:
///   gradient      g = argmin |P g − Δy|, the shortest one when there are fewer neighbours than inputs
///   non-linearity E = Σ_i |Δy_i − p_i · g|
/// E = 0 for a linear response, and with k <= d neighbours in general position. Noise counts as
/// non-linearity: average replicates first. Unit: that of y. Cost O(k d²).
/// Source: Crombecq, Gorissen, Deschrijver, Dhaene 2011, SIAM J. Sci. Comput. 33(4), equations 3.8-3.10; the
/// right side printed there lacks "less the site's".

#include <Eigen/Dense>

namespace drawpoint::doe {

/// P: k x d, dy: k. d entries.
inline Eigen::VectorXd local_gradient(const Eigen::MatrixXd& P, const Eigen::VectorXd& dy) {
  if (P.rows() == 0) return Eigen::VectorXd::Zero(P.cols());
  return P.completeOrthogonalDecomposition().solve(dy);
}

/// P: k x d, dY: k x r. r entries, one a response.
inline Eigen::VectorXd nonlinearity(const Eigen::MatrixXd& P, const Eigen::MatrixXd& dY) {
  if (P.rows() == 0) return Eigen::VectorXd::Zero(dY.cols());
  const Eigen::MatrixXd G = P.completeOrthogonalDecomposition().solve(dY);
  return (dY - P * G).cwiseAbs().colwise().sum().transpose();
}

}  // namespace drawpoint::doe
