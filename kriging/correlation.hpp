// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The Gaussian correlation c(a, b) = exp(−Σₖ θₖ (aₖ − bₖ)²).
///
/// Points are on the scale of [-1, 1] a variable, so that the θₖ of different variables compare: correlation
/// across the whole range of variable k is exp(−4 θₖ). θₖ = 1/(8 l²) where l is the length scale on [0, 1] of
/// the usual form exp(−½ Σ ((aₖ − bₖ)/lₖ)²). Differences are squared one by one; the expanded form |a|² +
/// |b|² − 2a·b would lose the digits of close points, on which a nearly singular matrix depends. Cost O(n²
/// d).
///
/// Source: Forrester, Sóbester, Keane 2008, "Engineering Design via Surrogate Modelling", section 2.4.

#include <Eigen/Core>

namespace drawpoint::kriging {

/// Fills the lower triangle, diagonal included, of C: n x n, with the correlations of the rows of X: n x d.
inline void fill_correlation(const Eigen::MatrixXd& X, const Eigen::VectorXd& theta, Eigen::MatrixXd& C) {
  const Eigen::Index n = X.rows();
  C.resize(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    auto column = C.col(j).tail(n - j).array();
    column.setZero();
    for (Eigen::Index k = 0; k < X.cols(); ++k)
      column -= theta[k] * (X.col(k).tail(n - j).array() - X(j, k)).square();
    column = column.exp();
  }
}

/// Correlations of the rows of X: n x d with the rows of Z: m x d, as an n x m matrix.
inline Eigen::MatrixXd cross_correlation(const Eigen::MatrixXd& X, const Eigen::MatrixXd& Z,
                                         const Eigen::VectorXd& theta) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(X.rows(), Z.rows());
  for (Eigen::Index j = 0; j < Z.rows(); ++j) {
    auto column = C.col(j).array();
    for (Eigen::Index k = 0; k < X.cols(); ++k) column -= theta[k] * (X.col(k).array() - Z(j, k)).square();
    column = column.exp();
  }
  return C;
}

}  // namespace drawpoint::kriging
