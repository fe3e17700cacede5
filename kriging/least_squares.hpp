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

namespace drawpoint::kriging::detail {

struct LeastSquares {
  Eigen::VectorXd beta;       ///< q
  Eigen::VectorXd alpha;      ///< n
  Eigen::MatrixXd B;          ///< n x q
  Eigen::MatrixXd T;          ///< q x q, upper triangular
  double sum_of_squares = 0;  ///< (y − Fβ)ᵀα
};

/// Q = (Q as it comes) T⁻¹ with orthonormal columns; T: q x q, zero at entry, becomes upper triangular.
/// Gram-Schmidt, twice a column, which leaves round-off along the others while the columns are independent in
/// double precision (Giraud, Langou, Rozložník 2005, "The loss of orthogonality in the Gram-Schmidt
/// orthogonalization process"). Eigen's QR would do as well, at seconds of every user's compile time.
inline void orthonormalize(Eigen::MatrixXd& Q, Eigen::MatrixXd& T) {
  for (Eigen::Index j = 0; j < Q.cols(); ++j) {
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd along = Q.leftCols(j).transpose() * Q.col(j);
      Q.col(j) -= Q.leftCols(j) * along;
      T.col(j).head(j) += along;
    }
    T(j, j) = Q.col(j).norm();
    Q.col(j) /= T(j, j);
  }
}

/// F has independent columns, fewer than rows or as many.
inline LeastSquares least_squares(const Eigen::MatrixXd& L, const Eigen::MatrixXd& F,
                                  const Eigen::VectorXd& y) {
  const auto lower = L.triangularView<Eigen::Lower>();
  const Eigen::Index q = F.cols();
  Eigen::MatrixXd both(F.rows(), q + 1);  // solved together: a pass over L costs more than a column
  both << F, y;
  lower.solveInPlace(both);
  LeastSquares s;
  s.T.setZero(q, q);
  Eigen::MatrixXd Q = both.leftCols(q);
  orthonormalize(Q, s.T);
  Eigen::VectorXd residual = both.col(q);
  const Eigen::VectorXd share = Q.transpose() * residual;
  s.beta = s.T.triangularView<Eigen::Upper>().solve(share);
  residual -= Q * share;
  residual -= Q * (Q.transpose() * residual);  // once more takes away the round-off that is left along Q
  s.sum_of_squares = residual.squaredNorm();
  both << Q, residual;
  lower.transpose().solveInPlace(both);
  s.B = both.leftCols(q);
  s.alpha = both.col(q);
  return s;
}

/// Beside noise that may be 0 at a run, this is added to the diagonal of R.
inline constexpr double noise_floor = 1e-10;

/// −n/2 ln(2π s²) − ½ ln|L Lᵀ| − S/(2s²).
inline double concentrated_log_likelihood(const Eigen::MatrixXd& L, double sum_of_squares, double variance) {
  return -0.5 * static_cast<double>(L.rows()) * std::log(2.0 * std::numbers::pi * variance) -
         L.diagonal().array().log().sum() - 0.5 * sum_of_squares / variance;
}

}  // namespace drawpoint::kriging::detail
