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

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace drawpoint::doe {

namespace detail {

/// Orthonormal columns that span those of P, by Gram-Schmidt: the longest column first, each once more made
/// orthogonal to those before. What round-off leaves of a column counts as nothing. Eigen's decompositions
/// would do as well, but half of what users wait for adaptive.hpp to compile.
inline Eigen::MatrixXd orthonormal_basis(Eigen::MatrixXd P) {
  const Eigen::Index most = std::min(P.rows(), P.cols());
  Eigen::MatrixXd Q(P.rows(), most);
  double nothing = 0.0;
  for (Eigen::Index r = 0; r < most; ++r) {
    Eigen::Index longest = 0;
    const double length = std::sqrt(P.colwise().squaredNorm().maxCoeff(&longest));
    if (r == 0)
      nothing = static_cast<double>(P.rows() + P.cols()) * std::numeric_limits<double>::epsilon() * length;
    if (!(length > nothing)) return Q.leftCols(r);
    Eigen::VectorXd q = P.col(longest) / length;
    for (Eigen::Index j = 0; j < r; ++j) q -= Q.col(j).dot(q) * Q.col(j);
    Q.col(r) = q.normalized();
    for (Eigen::Index j = 0; j < P.cols(); ++j) P.col(j) -= Q.col(r).dot(P.col(j)) * Q.col(r);
  }
  return Q;
}

}  // namespace detail

/// P: k x d, dy: k. d entries. With Q spanning the columns of P and V the rows of QᵀP, g = V (QᵀP V)⁻¹ Qᵀ dy.
inline Eigen::VectorXd local_gradient(const Eigen::MatrixXd& P, const Eigen::VectorXd& dy) {
  const Eigen::MatrixXd Q = detail::orthonormal_basis(P);
  if (Q.cols() == 0) return Eigen::VectorXd::Zero(P.cols());
  Eigen::MatrixXd B(Q.cols(), P.cols());
  for (Eigen::Index j = 0; j < P.cols(); ++j) B.col(j) = Q.transpose() * P.col(j);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(P.cols()), left = Q.transpose() * dy;
  Eigen::MatrixXd V(P.cols(), B.rows());  // rows of B made orthonormal, one after the other
  for (Eigen::Index i = 0; i < B.rows(); ++i) {
    Eigen::VectorXd v = B.row(i);
    for (int pass = 0; pass < 2; ++pass)
      for (Eigen::Index j = 0; j < i; ++j) v -= V.col(j).dot(v) * V.col(j);
    V.col(i) = v.normalized();
    g += (left[i] - B.row(i).dot(g)) / B.row(i).dot(V.col(i)) * V.col(i);
  }
  return g;
}

/// P: k x d, dY: k x r. r entries, one per response. The residual needs no gradient: it is what stands off the
/// span.
inline Eigen::VectorXd nonlinearity(const Eigen::MatrixXd& P, const Eigen::MatrixXd& dY) {
  const Eigen::MatrixXd Q = detail::orthonormal_basis(P);
  Eigen::VectorXd E(dY.cols());
  for (Eigen::Index k = 0; k < dY.cols(); ++k) {
    Eigen::VectorXd off = dY.col(k);
    for (Eigen::Index j = 0; j < Q.cols(); ++j) off -= Q.col(j).dot(off) * Q.col(j);
    E[k] = off.cwiseAbs().sum();
  }
  return E;
}

}  // namespace drawpoint::doe
