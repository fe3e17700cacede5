// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Matrices times vectors, triangular systems with few right-hand sides and sums of squares: all the linear
/// algebra of order n² in Kriging, made of two loops, y += a x and xᵀy.
///
/// What costs n³ is in matrix_product.hpp and cholesky.hpp. Plain functions stand here in the place of
/// Eigen's expressions because each kind of expression costs every program that includes the module tenths of
/// a second of compile time. Matrices are column-major, so both loops run along columns. xᵀy is summed in
/// eight interleaved parts on any processor: the same bits everywhere. Sizes are checked by Eigen's
/// assertions only.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <drawpoint/kriging/detail/simd.hpp>

namespace drawpoint::kriging::detail {

using Index = Eigen::Index;

[[gnu::always_inline]] inline double dot_kernel(const double* x, const double* y, Index n) {
  using Unaligned = Quad::Unaligned;  // in halves where the processor has no such vectors
  Quad::Vector a{}, b{};
  Index i = 0;
  for (; i + 8 <= n; i += 8) {
    a += *reinterpret_cast<const Unaligned*>(x + i) * *reinterpret_cast<const Unaligned*>(y + i);
    b += *reinterpret_cast<const Unaligned*>(x + i + 4) * *reinterpret_cast<const Unaligned*>(y + i + 4);
  }
  a += b;
  double rest = 0.0;
  for (; i < n; ++i) rest += x[i] * y[i];
  return ((a[0] + a[2]) + (a[1] + a[3])) + rest;
}

[[gnu::always_inline]] inline void add_scaled_kernel(double* y, double factor, const double* x, Index n) {
  using Unaligned = Quad::Unaligned;
  Index i = 0;
  for (; i + 4 <= n; i += 4)
    *reinterpret_cast<Unaligned*>(y + i) += factor * *reinterpret_cast<const Unaligned*>(x + i);
  for (; i < n; ++i) y[i] += factor * x[i];
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] inline double dot_quad(const double* x, const double* y, Index n) {
  return dot_kernel(x, y, n);
}
[[gnu::target("avx2")]] inline void add_scaled_quad(double* y, double factor, const double* x, Index n) {
  add_scaled_kernel(y, factor, x, n);
}
#endif

/// Σ xᵢyᵢ of n numbers each.
inline double dot(const double* x, const double* y, Index n) {
#if defined(__x86_64__)
  if (has_quad()) return dot_quad(x, y, n);
#endif
  return dot_kernel(x, y, n);
}

/// y += factor x.
inline void add_scaled(double* y, double factor, const double* x, Index n) {
#if defined(__x86_64__)
  if (has_quad()) return add_scaled_quad(y, factor, x, n);
#endif
  add_scaled_kernel(y, factor, x, n);
}

inline const double* column(const Eigen::MatrixXd& A, Index j) { return A.data() + j * A.rows(); }
inline double* column(Eigen::MatrixXd& A, Index j) { return A.data() + j * A.rows(); }

inline double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  return dot(x.data(), y.data(), x.size());
}

/// Σ AᵢⱼBᵢⱼ.
inline double dot(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return dot(A.data(), B.data(), A.size());
}

/// |x|².
inline double square(const Eigen::VectorXd& x) { return dot(x, x); }

/// xᵢyᵢ, and xᵢ/yᵢ.
inline Eigen::VectorXd entry_products(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  Eigen::VectorXd z = x;
  for (Index i = 0; i < z.size(); ++i) z[i] *= y[i];
  return z;
}
inline Eigen::VectorXd entry_quotients(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  Eigen::VectorXd z = x;
  for (Index i = 0; i < z.size(); ++i) z[i] /= y[i];
  return z;
}

/// x − y.
inline Eigen::VectorXd difference(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  Eigen::VectorXd z = x;
  for (Index i = 0; i < z.size(); ++i) z[i] -= y[i];
  return z;
}

/// factor x + shift.
inline Eigen::VectorXd affine(const Eigen::VectorXd& x, double factor, double shift = 0.0) {
  Eigen::VectorXd z = x;
  for (double& entry : z) entry = factor * entry + shift;
  return z;
}

/// These three need a vector of one entry or more.
inline double largest_entry(const Eigen::VectorXd& x) { return *std::max_element(x.begin(), x.end()); }
inline double smallest_entry(const Eigen::VectorXd& x) { return *std::min_element(x.begin(), x.end()); }
inline double mean_of(const Eigen::VectorXd& x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

/// Whether no number among n is infinite or NaN.
inline bool all_finite(const double* x, Index n) {
  return std::all_of(x, x + n, [](double v) { return std::isfinite(v); });
}
inline bool all_finite(const Eigen::MatrixXd& A) { return all_finite(A.data(), A.size()); }
inline bool all_finite(const Eigen::VectorXd& x) { return all_finite(x.data(), x.size()); }

/// y += factor A x.
inline void add_product(double* y, double factor, const Eigen::MatrixXd& A, const double* x) {
  for (Index j = 0; j < A.cols(); ++j) add_scaled(y, factor * x[j], column(A, j), A.rows());
}

/// A x.
inline Eigen::VectorXd product(const Eigen::MatrixXd& A, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(A.rows());
  add_product(y.data(), 1.0, A, x.data());
  return y;
}

/// A B, for a B of few columns.
inline Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(A.rows(), B.cols());
  for (Index j = 0; j < B.cols(); ++j) add_product(column(C, j), 1.0, A, column(B, j));
  return C;
}

/// Aᵀx.
inline Eigen::VectorXd transposed_product(const Eigen::MatrixXd& A, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(A.cols());
  for (Index j = 0; j < A.cols(); ++j) y[j] = dot(column(A, j), x.data(), A.rows());
  return y;
}

/// AᵀB, for a B of few columns.
inline Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  Eigen::MatrixXd C(A.cols(), B.cols());
  for (Index j = 0; j < B.cols(); ++j)
    for (Index i = 0; i < A.cols(); ++i) C(i, j) = dot(column(A, i), column(B, j), A.rows());
  return C;
}

/// A += factor x yᵀ.
inline void add_outer(Eigen::MatrixXd& A, double factor, const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  for (Index j = 0; j < A.cols(); ++j) add_scaled(column(A, j), factor * y[j], x.data(), A.rows());
}

/// B = L⁻¹B in place. L: n x n lower triangular, B: n x few.
inline void solve_lower(const Eigen::MatrixXd& L, double* B, Index columns) {
  const Index n = L.rows();
  for (Index j = 0; j < n; ++j)
    for (Index k = 0; k < columns; ++k) {
      double* x = B + j + k * n;
      *x /= L(j, j);
      add_scaled(x + 1, -*x, column(L, j) + j + 1, n - j - 1);
    }
}
inline void solve_lower(const Eigen::MatrixXd& L, Eigen::MatrixXd& B) { solve_lower(L, B.data(), B.cols()); }
inline void solve_lower(const Eigen::MatrixXd& L, Eigen::VectorXd& b) { solve_lower(L, b.data(), 1); }

/// B = L⁻ᵀB in place. L: n x n lower triangular, B: n x few.
inline void solve_lower_transposed(const Eigen::MatrixXd& L, double* B, Index columns) {
  const Index n = L.rows();
  for (Index j = n - 1; j >= 0; --j)
    for (Index k = 0; k < columns; ++k) {
      double* x = B + j + k * n;
      *x = (*x - dot(column(L, j) + j + 1, x + 1, n - j - 1)) / L(j, j);
    }
}
inline void solve_lower_transposed(const Eigen::MatrixXd& L, Eigen::MatrixXd& B) {
  solve_lower_transposed(L, B.data(), B.cols());
}
inline void solve_lower_transposed(const Eigen::MatrixXd& L, Eigen::VectorXd& b) {
  solve_lower_transposed(L, b.data(), 1);
}

/// T⁻¹x. T: q x q upper triangular.
inline Eigen::VectorXd solve_upper(const Eigen::MatrixXd& T, Eigen::VectorXd x) {
  for (Index j = T.rows() - 1; j >= 0; --j) {
    x[j] /= T(j, j);
    add_scaled(x.data(), -x[j], column(T, j), j);
  }
  return x;
}

/// Takes out of v its parts along the first `count` columns of Q, which are orthonormal; returns |v| then.
/// Twice each, which leaves round-off along them while v keeps a digit of its length (Giraud, Langou,
/// Rozložník 2005, "The loss of orthogonality in the Gram-Schmidt orthogonalization process"). `along`: the
/// parts are added to these `count` numbers.
inline double orthogonalize(const Eigen::MatrixXd& Q, Index count, double* v, double* along = nullptr) {
  const Index n = Q.rows();
  for (int pass = 0; pass < 2; ++pass)
    for (Index j = 0; j < count; ++j) {
      const double part = dot(column(Q, j), v, n);
      add_scaled(v, -part, column(Q, j), n);
      if (along) along[j] += part;
    }
  return std::sqrt(dot(v, v, n));
}

/// Σⱼ Aᵢⱼ², one entry per row.
inline Eigen::VectorXd row_squares(const Eigen::MatrixXd& A) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(A.rows());
  for (Index j = 0; j < A.cols(); ++j)
    for (Index i = 0; i < A.rows(); ++i) sums[i] += A(i, j) * A(i, j);
  return sums;
}

/// factor I: n x n.
inline Eigen::MatrixXd scaled_identity(Index n, double factor) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) A(i, i) = factor;
  return A;
}

inline Eigen::VectorXd diagonal(const Eigen::MatrixXd& A) {
  Eigen::VectorXd d(A.rows());
  for (Index i = 0; i < d.size(); ++i) d[i] = A(i, i);
  return d;
}

inline void add_to_diagonal(Eigen::MatrixXd& A, double value) {
  for (Index i = 0; i < A.rows(); ++i) A(i, i) += value;
}

/// Makes A symmetric by what stands below its diagonal.
inline void mirror_lower(Eigen::MatrixXd& A) {
  for (Index j = 0; j < A.cols(); ++j)
    for (Index i = 0; i < j; ++i) A(i, j) = A(j, i);
}

/// Zeros above the diagonal.
inline void clear_upper(Eigen::MatrixXd& A) {
  for (Index j = 1; j < A.cols(); ++j) std::fill_n(column(A, j), std::min(j, A.rows()), 0.0);
}

/// A with these entries of x, these rows and these columns of A, in their order.
inline Eigen::VectorXd entries_of(const Eigen::VectorXd& x, const std::vector<Index>& which) {
  Eigen::VectorXd some(static_cast<Index>(which.size()));
  for (Index i = 0; i < some.size(); ++i) some[i] = x[which[static_cast<std::size_t>(i)]];
  return some;
}
inline Eigen::MatrixXd rows_of(const Eigen::MatrixXd& A, const std::vector<Index>& which) {
  Eigen::MatrixXd some(static_cast<Index>(which.size()), A.cols());
  for (Index j = 0; j < A.cols(); ++j)
    for (Index i = 0; i < some.rows(); ++i) some(i, j) = A(which[static_cast<std::size_t>(i)], j);
  return some;
}
inline Eigen::MatrixXd columns_of(const Eigen::MatrixXd& A, const std::vector<Index>& which) {
  Eigen::MatrixXd some(A.rows(), static_cast<Index>(which.size()));
  for (Index j = 0; j < some.cols(); ++j)
    std::copy_n(column(A, which[static_cast<std::size_t>(j)]), A.rows(), column(some, j));
  return some;
}

}  // namespace drawpoint::kriging::detail
