// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Leave-one-out errors in closed form.
///
/// With P = R⁻¹ − R⁻¹F(FᵀR⁻¹F)⁻¹FᵀR⁻¹ the run i, predicted from all others with β estimated anew, is missed
/// by eᵢ = (P y)ᵢ/Pᵢᵢ (Dubrule 1983, Mathematical Geology 15, "Cross validation of kriging in a unique
/// neighborhood"), and P y = α. Cost n³/3.

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/least_squares.hpp>
#include <drawpoint/kriging/detail/model_state.hpp>

namespace drawpoint::kriging::detail {

/// Diagonal of P, n entries, from the factor L of R and what least squares left.
inline Eigen::VectorXd diagonal_of_P(Eigen::MatrixXd L, const LeastSquares& gls) {
  Eigen::MatrixXd X;
  inverse_transposed(L, X);
  Eigen::VectorXd P = row_squares(X);
  add_scaled(P.data(), -1.0, row_squares(gls.B).data(), P.size());
  return P;
}

/// n entries, standardised.
inline Eigen::VectorXd left_out_errors(const Eigen::MatrixXd& L, const LeastSquares& gls) {
  return entry_quotients(gls.alpha, diagonal_of_P(L, gls));
}

/// Root mean square of the leave-one-out errors, standardised.
inline double leave_one_out_error(const ModelState& s) {
  return std::sqrt(square(left_out_errors(s.L, s.gls)) / static_cast<double>(s.y.size()));
}

}  // namespace drawpoint::kriging::detail
