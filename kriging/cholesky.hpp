// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The inverse of a symmetric positive definite matrix from its Cholesky factor, K = L⁻ᵀ L⁻¹, by blocks of
/// columns that skip the zeros of the triangles: 2n³/3 operations, where solving for the n columns of the
/// identity takes 2n³.

#include <Eigen/Core>
#include <algorithm>

namespace drawpoint::kriging::detail {

inline constexpr Eigen::Index inverse_block = 48;

/// L: n x n, lower triangle used. Returns L⁻¹ with zeros above the diagonal.
inline Eigen::MatrixXd inverse_of_lower(const Eigen::MatrixXd& L) {
  const Eigen::Index n = L.rows();
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; j += inverse_block) {
    const Eigen::Index width = std::min(inverse_block, n - j), height = n - j;
    auto columns = inverse.block(j, j, height, width);
    columns.topRows(width).setIdentity();
    L.bottomRightCorner(height, height).triangularView<Eigen::Lower>().solveInPlace(columns);
  }
  return inverse;
}

/// Lower triangle of K = (L Lᵀ)⁻¹, diagonal included; what stands above the diagonal is not defined.
inline void inverse_from_cholesky(const Eigen::MatrixXd& L, Eigen::MatrixXd& K) {
  const Eigen::MatrixXd inverse = inverse_of_lower(L);
  const Eigen::Index n = L.rows();
  K.resize(n, n);
  for (Eigen::Index i = 0; i < n; i += inverse_block) {
    const Eigen::Index height = std::min(inverse_block, n - i), depth = n - i;
    K.block(i, 0, height, i + height).noalias() =
        inverse.block(i, i, depth, height).transpose() * inverse.block(i, 0, depth, i + height);
  }
}

}  // namespace drawpoint::kriging::detail
