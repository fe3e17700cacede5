// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Kriging of the runs of one neighbourhood N, with the trend and the variance of all runs.
///
///   α = R_NN⁻¹(y − Fβ)_N,  B = R_NN⁻¹F_N T⁻¹,  variance 1 − rᵀR_NN⁻¹r + |T⁻ᵀf − Bᵀr|²,  TᵀT = FᵀR⁻¹F of all

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/model_state.hpp>
#include <drawpoint/kriging/detail/nearest/least_nugget.hpp>
#include <optional>
#include <vector>

namespace drawpoint::kriging::detail {

struct Neighbourhood {
  std::vector<int> rows;  ///< ascending
  Eigen::VectorXd alpha;  ///< one entry a row
};

inline Eigen::MatrixXd rows_at(const Eigen::MatrixXd& A, const std::vector<int>& rows) {
  return rows_of(A, std::vector<Index>(rows.begin(), rows.end()));
}

/// F T⁻¹; F: points x q.
inline Eigen::MatrixXd whitened_trend(const ModelState& s, Eigen::MatrixXd F) {
  Eigen::MatrixXd lower = s.gls.T.transpose();
  solve_right(block_of(lower), block_of(F));
  return F;
}

/// L of R_NN.
class LocalFactor {
 public:
  LocalFactor(const ModelState& s, const std::vector<int>& rows) : rows_(rows) {
    fill_correlation(rows_at(s.X, rows), s.correlation, L_);
    const double floor = block_floor(s.noise.size() || s.known_noise > 0, L_.rows());
    for (Index a = 0; a < L_.rows(); ++a)
      L_(a, a) += s.nugget * (s.noise.size() ? s.noise[rows[static_cast<std::size_t>(a)]] : 1.0) + floor;
    factor(block_of(L_), 1);
    clear_upper(L_);
  }

  const Eigen::MatrixXd& matrix() const { return L_; }

  /// R_NN⁻¹ of the entries of z that belong to N.
  Eigen::VectorXd weights(const Eigen::VectorXd& z) const {
    Eigen::VectorXd w(L_.rows());
    for (Index a = 0; a < w.size(); ++a) w[a] = z[rows_[static_cast<std::size_t>(a)]];
    solve_lower(L_, w);
    solve_lower_transposed(L_, w);
    return w;
  }

 private:
  const std::vector<int>& rows_;
  Eigen::MatrixXd L_;
};

/// What predictions of a cell need: the runs of its neighbourhood, and for variances the factor.
struct LocalRuns {
  Eigen::MatrixXd X;  ///< N x d, scaled
  std::optional<LocalFactor> factor;
  Eigen::MatrixXd B;  ///< N x q

  /// whitened: F T⁻¹ of all runs; nullptr: means alone are wanted.
  LocalRuns(const ModelState& s, const std::vector<int>& rows, const Eigen::MatrixXd* whitened)
      : X(rows_at(s.X, rows)) {
    if (!whitened) return;
    factor.emplace(s, rows);
    B = rows_at(*whitened, rows);
    solve_lower(factor->matrix(), B);
    solve_lower_transposed(factor->matrix(), B);
  }

  /// In units of s². C: N x points, their correlations with the runs; F: points x q, T⁻ᵀf of each.
  Eigen::VectorXd relative_variance(const Eigen::MatrixXd& C, Eigen::MatrixXd F) const {
    Eigen::MatrixXd R = C.transpose();
    for (Index j = 0; j < F.cols(); ++j) add_product(column(F, j), -1.0, R, column(B, j));
    const Eigen::VectorXd missing = row_squares(F);
    solve_right(block_of(factor->matrix()), block_of(R));
    Eigen::VectorXd variance = row_squares(R);
    // Round-off may leave a small negative number at a run.
    for (Index i = 0; i < variance.size(); ++i) variance[i] = std::max(1.0 - variance[i] + missing[i], 0.0);
    return variance;
  }
};

}  // namespace drawpoint::kriging::detail
