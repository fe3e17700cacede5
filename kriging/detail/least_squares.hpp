// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Generalised least squares: the trend's coefficients when errors have the covariance s² R, R = L Lᵀ.
///
///   L⁻¹F = Q T (Q: n x q orthonormal, T upper), β = T⁻¹Qᵀ L⁻¹y, α = R⁻¹(y − Fβ), B = L⁻ᵀQ
/// so that P = R⁻¹ − R⁻¹F(FᵀR⁻¹F)⁻¹FᵀR⁻¹ = R⁻¹ − B Bᵀ and α = P y. No normal equations are formed, so digits
/// are lost by the condition of L⁻¹F once, not squared. Cost O(n² q).

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include <drawpoint/kriging/detail/dense.hpp>

namespace drawpoint::kriging::detail {

struct LeastSquares {
  Eigen::VectorXd beta;       ///< q
  Eigen::VectorXd alpha;      ///< n
  Eigen::MatrixXd B;          ///< n x q
  Eigen::MatrixXd T;          ///< q x q, upper triangular
  double sum_of_squares = 0;  ///< (y − Fβ)ᵀα
};

/// Q = (Q as it comes) T⁻¹ with orthonormal columns; T: q x q, zero at entry, becomes upper triangular. The
/// columns have to be independent in double precision.
inline void orthonormalize(Eigen::MatrixXd& Q, Eigen::MatrixXd& T) {
  for (Index j = 0; j < Q.cols(); ++j) {
    T(j, j) = orthogonalize(Q, j, column(Q, j), column(T, j));
    for (Index i = 0; i < Q.rows(); ++i) Q(i, j) /= T(j, j);
  }
}

/// F has independent columns, fewer than rows or as many.
inline LeastSquares least_squares(const Eigen::MatrixXd& L, const Eigen::MatrixXd& F,
                                  const Eigen::VectorXd& y) {
  LeastSquares s;
  s.B = F;
  s.T.setZero(F.cols(), F.cols());
  solve_lower(L, s.B);
  orthonormalize(s.B, s.T);
  s.alpha = y;
  solve_lower(L, s.alpha);
  const Eigen::VectorXd share = transposed_product(s.B, s.alpha);
  s.beta = solve_upper(s.T, share);
  add_product(s.alpha.data(), -1.0, s.B, share.data());
  // Once more takes away the round-off that is left along Q.
  add_product(s.alpha.data(), -1.0, s.B, transposed_product(s.B, s.alpha).data());
  s.sum_of_squares = square(s.alpha);
  solve_lower_transposed(L, s.B);
  solve_lower_transposed(L, s.alpha);
  return s;
}

/// Beside noise that may be 0 at a run, this is added to the diagonal of R.
inline constexpr double noise_floor = 1e-10;

/// −n/2 ln(2π s²) − ½ ln|L Lᵀ| − S/(2s²).
inline double concentrated_log_likelihood(const Eigen::MatrixXd& L, double sum_of_squares, double variance) {
  double half_log_determinant = 0;
  for (Index i = 0; i < L.rows(); ++i) half_log_determinant += std::log(L(i, i));
  return -0.5 * static_cast<double>(L.rows()) * std::log(2.0 * std::numbers::pi * variance) -
         half_log_determinant - 0.5 * sum_of_squares / variance;
}

}  // namespace drawpoint::kriging::detail
