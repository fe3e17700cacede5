// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Leave-one-out errors in closed form, site by site.
///
/// With P = R⁻¹ − R⁻¹F(FᵀR⁻¹F)⁻¹FᵀR⁻¹ the runs G of a site, predicted from all others with β estimated anew,
/// are missed by e = P_GG⁻¹ (P y)_G with the covariance s² P_GG⁻¹, their noise included; for a single run (P
/// y)ᵢ/Pᵢᵢ and s²/Pᵢᵢ (Dubrule 1983, Mathematical Geology 15, "Cross validation of kriging in a unique
/// neighborhood"). P y = α. Cost n³/3.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/least_squares.hpp>
#include <drawpoint/kriging/detail/model_state.hpp>
#include <drawpoint/kriging/detail/sites.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// Diagonal of P, n entries, from the factor L of R and what least squares left.
inline Eigen::VectorXd diagonal_of_P(Eigen::MatrixXd L, const LeastSquares& gls) {
  Eigen::MatrixXd X;
  inverse_transposed(L, X);
  Eigen::VectorXd P = row_squares(X);
  add_scaled(P.data(), -1.0, row_squares(gls.B).data(), P.size());
  return P;
}

/// How each run is missed by a prediction without its site, standardised.
struct LeftOut {
  Eigen::VectorXd error, variance;  ///< n entries; variance over s², with the run's noise
};

inline constexpr double least_pivot =
    1e-12;  // of P's diagonal; below it the trend is not known without the site

/// A⁻¹r and the diagonal of A⁻¹ for the matrix A of one site's runs; NaN where it is singular, since the other
/// sites do not tell enough.
inline LeftOut solve_site(Eigen::MatrixXd A, Eigen::VectorXd r) {
  double largest = 0.0;
  for (Index i = 0; i < A.rows(); ++i) largest = std::max(largest, A(i, i));
  bool known = factor(block_of(A), 1);
  for (Index i = 0; i < A.rows(); ++i) known = known && A(i, i) * A(i, i) > least_pivot * largest;
  if (!known) {
    r.setConstant(std::numeric_limits<double>::quiet_NaN());
    return {r, r};
  }
  Eigen::MatrixXd inverse;
  solve_lower(A, r);
  solve_lower_transposed(A, r);
  inverse_transposed(A, inverse);
  return {r, row_squares(inverse)};
}

/// P of the runs of one site, from the rows of L⁻ᵀ and of B.
inline Eigen::MatrixXd block_of_P(const std::vector<Eigen::Index>& site, const Eigen::MatrixXd& rows,
                                  const LeastSquares& gls) {
  const auto m = static_cast<Index>(site.size());
  Eigen::MatrixXd P(m, m);
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < m; ++j) {
      P(i, j) = 0.0;
      for (Index k = 0; k < rows.cols(); ++k) P(i, j) += rows(site[i], k) * rows(site[j], k);
      for (Index k = 0; k < gls.B.cols(); ++k) P(i, j) -= gls.B(site[i], k) * gls.B(site[j], k);
    }
  return P;
}

/// A site of several runs.
inline void leave_site_out(const std::vector<Eigen::Index>& site, const Eigen::MatrixXd& rows,
                           const LeastSquares& gls, LeftOut& out) {
  const LeftOut of_site = solve_site(block_of_P(site, rows, gls), entries_of(gls.alpha, site));
  for (std::size_t i = 0; i < site.size(); ++i) {
    out.error[site[i]] = of_site.error[static_cast<Index>(i)];
    out.variance[site[i]] = of_site.variance[static_cast<Index>(i)];
  }
}

/// X: n x d, whose equal rows are sites; L: the factor of R.
inline LeftOut left_out(Eigen::MatrixXd L, const LeastSquares& gls, const Eigen::MatrixXd& X) {
  Eigen::MatrixXd rows;
  inverse_transposed(L, rows);
  Eigen::VectorXd P = row_squares(rows);
  add_scaled(P.data(), -1.0, row_squares(gls.B).data(), P.size());
  LeftOut out{entry_quotients(gls.alpha, P), entry_quotients(Eigen::VectorXd::Ones(P.size()), P)};
  for (const std::vector<Eigen::Index>& site : sites_of(X))
    if (site.size() > 1) leave_site_out(site, rows, gls, out);
  return out;
}

/// Root mean square of the leave-one-out errors, standardised.
inline double leave_one_out_error(const ModelState& s) {
  return std::sqrt(square(left_out(s.L, s.gls, s.X).error) / static_cast<double>(s.y.size()));
}

}  // namespace drawpoint::kriging::detail
