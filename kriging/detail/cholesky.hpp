// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Cholesky factor A = L Lᵀ, triangular systems and the inverse A⁻¹ = L⁻ᵀ L⁻¹, by halves down to 16 columns.
///
/// All work of order n³ is one product, C ± A Bᵀ (matrix_product.hpp). Operations: factor n³/3, inverse of
/// the factor n³/3, inverse from that n³/3. Only the lower triangle of A and of its inverse is read or
/// written to effect; what stands above the diagonal is not defined. Results do not depend on the number of
/// threads. Source: Gustavson 1997, "Recursion leads to automatic variable blocking for dense linear-algebra
/// algorithms".

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include <drawpoint/kriging/detail/matrix_product.hpp>

namespace drawpoint::kriging::detail {

inline constexpr Index smallest = 16;

/// About half, a multiple of the smallest size.
inline Index half(Index n) { return std::max(smallest, n / 2 / smallest * smallest); }

/// X Lᵀ = B for at most 16 columns, in place, rows in strips that stay in the first cache.
inline void solve_few_columns(const Block& L, const Block& B) {
  constexpr Index strip = 128;
  for (Index i = 0; i < B.rows; i += strip) {
    const Index rows = std::min(strip, B.rows - i);
    for (Index j = 0; j < B.columns; ++j) {
      double* x = B.column(j) + i;
      for (Index k = 0; k < j; ++k) add_scaled(x, -L.column(k)[j], B.column(k) + i, rows);
      const double inverse = 1.0 / L.column(j)[j];
      for (Index r = 0; r < rows; ++r) x[r] *= inverse;
    }
  }
}

/// X Lᵀ = B in place. L: n x n lower, B: m x n.
inline void solve_right(const Block& L, const Block& B) {
  const Index n = L.rows;
  if (n <= smallest) return solve_few_columns(L, B);
  const Index first = half(n), second = n - first;
  const Block left = B.part(0, 0, B.rows, first), right = B.part(0, first, B.rows, second);
  solve_right(L.part(0, 0, first, first), left);
  add_product(left, L.part(first, 0, second, first), -1.0, right);
  solve_right(L.part(first, first, second, second), right);
}

/// The same with the rows of B shared out to threads.
inline void solve_right(const Block& L, const Block& B, int threads) {
  constexpr Index rows = 192;
  const int count = static_cast<int>((B.rows + rows - 1) / rows);
  if (L.rows < 4 * smallest) threads = 1;
  for_each_task(count, threads, [&](int t) {
    solve_right(L, B.part(t * rows, 0, std::min(rows, B.rows - t * rows), B.columns));
  });
}

/// False when A is not numerically positive definite.
inline bool factor_few_columns(const Block& A) {
  for (Index j = 0; j < A.columns; ++j) {
    double* x = A.column(j) + j;
    for (Index k = 0; k < j; ++k) add_scaled(x, -A.column(k)[j], A.column(k) + j, A.rows - j);
    if (!(x[0] > 0.0)) return false;
    const double root = std::sqrt(x[0]), inverse = 1.0 / root;
    for (Index r = 1; r < A.rows - j; ++r) x[r] *= inverse;
    x[0] = root;
  }
  return true;
}

/// A becomes L in its lower triangle. False when A is not numerically positive definite.
inline bool factor(const Block& A, int threads) {
  const Index n = A.rows;
  if (n <= smallest) return factor_few_columns(A);
  const Index first = half(n), second = n - first;
  const Block top = A.part(0, 0, first, first), low = A.part(first, 0, second, first);
  if (!factor(top, threads)) return false;
  solve_right(top, low, threads);
  const Block rest = A.part(first, first, second, second);
  add_product(low, low, -1.0, rest, Part::lower, threads);
  return factor(rest, threads);
}

/// X: n x n, zero at entry, becomes L⁻ᵀ (upper triangular).
inline void invert_transposed(const Block& L, const Block& X, int threads) {
  const Index n = L.rows;
  if (n <= smallest) {
    for (Index i = 0; i < n; ++i) X.column(i)[i] = 1.0;
    return solve_few_columns(L, X);
  }
  const Index first = half(n), second = n - first;
  const Block corner = X.part(0, first, first, second);
  invert_transposed(L.part(0, 0, first, first), X.part(0, 0, first, first), threads);
  for (Index i = 0; i < first; i += tile) {  // the zeros left of the diagonal are skipped tile by tile
    const Index height = std::min(tile, first - i);
    add_product(X.part(i, i, height, first - i), L.part(first, i, second, first - i), -1.0,
                corner.part(i, 0, height, second), Part::all, threads);
  }
  solve_right(L.part(first, first, second, second), corner, threads);
  invert_transposed(L.part(first, first, second, second), X.part(first, first, second, second), threads);
}

/// L⁻ᵀ, upper triangular with zeros below. L: n x n, lower triangle used.
inline void inverse_transposed(Eigen::MatrixXd& L, Eigen::MatrixXd& X, int threads = 1) {
  X.setZero(L.rows(), L.cols());
  invert_transposed(block_of(L), block_of(X), threads);
}

/// Lower triangle of K = X Xᵀ for upper triangular X = L⁻ᵀ, that is, of (L Lᵀ)⁻¹.
inline void product_of_upper(Eigen::MatrixXd& X, Eigen::MatrixXd& K, int threads = 1) {
  const Index n = X.rows(), rows = std::clamp<Index>(n / 4 / 8 * 8, 24, 96);
  K.setZero(n, n);
  const Block upper = block_of(X), result = block_of(K);
  const int count = static_cast<int>((n + rows - 1) / rows);
  if (n < 400) threads = 1;
  for_each_task(count, threads, [&](int t) {
    const Index i = t * rows, height = std::min(rows, n - i);
    add_product(upper.part(i, i, height, n - i), upper.part(0, i, i + height, n - i), 1.0,
                result.part(i, 0, height, i + height));
  });
}

}  // namespace drawpoint::kriging::detail
