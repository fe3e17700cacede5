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

/// A site of several runs, from the rows of L⁻ᵀ and of B. NaN where the other sites do not tell the trend.
inline void leave_site_out(const std::vector<Eigen::Index>& site, const Eigen::MatrixXd& rows,
                           const LeastSquares& gls, LeftOut& out) {
  const auto m = static_cast<Index>(site.size());
  Eigen::MatrixXd P(m, m), inverse;
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < m; ++j) {
      P(i, j) = 0.0;
      for (Index k = 0; k < rows.cols(); ++k) P(i, j) += rows(site[i], k) * rows(site[j], k);
      for (Index k = 0; k < gls.B.cols(); ++k) P(i, j) -= gls.B(site[i], k) * gls.B(site[j], k);
    }
  Eigen::VectorXd error = entries_of(gls.alpha, site), variance = error;
  double largest = 0.0;
  for (Index i = 0; i < m; ++i) largest = std::max(largest, P(i, i));
  bool known = factor(block_of(P), 1);
  for (Index i = 0; i < m; ++i) known = known && P(i, i) * P(i, i) > least_pivot * largest;
  if (known) {
    solve_lower(P, error);
    solve_lower_transposed(P, error);
    inverse_transposed(P, inverse);
    variance = row_squares(inverse);
  } else {
    error.setConstant(std::numeric_limits<double>::quiet_NaN());
    variance = error;
  }
  for (Index i = 0; i < m; ++i) out.error[site[i]] = error[i], out.variance[site[i]] = variance[i];
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
