// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A block of runs given its neighbours N, and the derivatives of its log density.
///
/// With R = L Lᵀ of (N, block), z = y − Fβ and u the entries of L⁻¹z that belong to the block,
///   ln p = −Σ ln Lᵢᵢ − n_b/2 ln(2π s²) − |u|²/(2s²), i in the block
///   ∂ln p = Σ Wₐ_b ∂Rₐ_b,  W = ½ (ααᵀ − α_Nα_Nᵀ)/s² − ½ HHᵀ
/// with α = R⁻¹z, α_N = (R_NN⁻¹z_N, 0) and H the block's columns of L⁻ᵀ, for HHᵀ = R⁻¹ − R_NN⁻¹. Cost k³/3
/// for k runs in all; slopes k² (n_b + 3 d) more.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/likelihood.hpp>
#include <drawpoint/kriging/detail/nearest/least_nugget.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

/// θ and the exponents of p.
inline void set_correlation(const ParameterPlaces& places, const Eigen::VectorXd& p, CorrelationFunction& f) {
  f.theta.resize(places.variables());
  if (places.exponents) f.exponent.resize(places.variables());
  for (Index k = 0; k < places.variables(); ++k) {
    f.theta[k] = std::exp(p[places.theta(k)]);
    if (places.exponents) f.exponent[k] = p[places.exponent(k)];
  }
}

/// Neighbours and behind them `own` runs.
struct Family {
  std::vector<Index> rows;
  Index own = 0;

  Index neighbours() const { return static_cast<Index>(rows.size()) - own; }
};

class Conditional {
 public:
  /// Asks regular() first: the rest is defined where R is numerically positive definite. All are kept by
  /// reference.
  Conditional(const LikelihoodProblem& in, const CorrelationFunction& f, double nugget, const Family& family)
      : in_(in), f_(f), nugget_(nugget), family_(family), X_(rows_of(in.X, family.rows)) {
    fill_correlation(X_, f, C_);
    L_ = C_;
    const double floor = block_floor(in.noise.size() || in.known_noise > 0, L_.rows());
    for (Index a = 0; a < L_.rows(); ++a) L_(a, a) += nugget * noise_weight(a) + floor;
    regular_ = factor(block_of(L_), 1);
    clear_upper(L_);
  }

  bool regular() const { return regular_; }

  /// Σ ln Lᵢᵢ of the block.
  double half_log_determinant() const {
    double sum = 0;
    for (Index a = family_.neighbours(); a < L_.rows(); ++a) sum += std::log(L_(a, a));
    return sum;
  }

  /// The block's entries of L⁻¹z for each column of z, n rows: own x columns.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& z) const {
    Eigen::MatrixXd u = rows_of(z, family_.rows);
    solve_lower(L_, u);
    return u.bottomRows(family_.own);
  }

  /// Adds ∂ln p/∂p to g; z: n entries, y − Fβ.
  void add_slopes(const ParameterPlaces& places, const Eigen::VectorXd& z, double s2, double* g) const {
    const Eigen::MatrixXd W = multipliers(z, s2), points = X_.transpose();
    for (Index j = 0; j < W.rows(); ++j) {
      for (Index i = j + 1; i < W.rows(); i += chunk_rows)
        add_slopes_of(places, W, j, {X_, i, std::min(chunk_rows, W.rows() - i), &points(0, j)}, g);
      g[places.count() - 1] += nugget_ * noise_weight(j) * W(j, j);
    }
  }

 private:
  double noise_weight(Index a) const {
    return in_.noise.size() ? in_.noise[family_.rows[static_cast<std::size_t>(a)]] : 1.0;
  }

  // Lower triangle of W.
  Eigen::MatrixXd multipliers(const Eigen::VectorXd& z, double s2) const {
    const Index k = L_.rows(), m = family_.neighbours();
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(k, family_.own), a(k, 2), W = Eigen::MatrixXd::Zero(k, k);
    for (Index j = 0; j < H.cols(); ++j) H(m + j, j) = 1.0;
    solve_lower_transposed(L_, H);
    a.col(0) = entries_of(z, family_.rows);
    solve_lower(L_, a.data(), 1);
    a.col(1).head(m) = a.col(0).head(m);
    a.col(1).tail(family_.own).setZero();
    solve_lower_transposed(L_, a);
    for (Index j = 0; j < k; ++j) {
      add_scaled(column(W, j) + j, 0.5 * a(j, 0) / s2, column(a, 0) + j, k - j);
      add_scaled(column(W, j) + j, -0.5 * a(j, 1) / s2, column(a, 1) + j, k - j);
    }
    for (double& entry : H.reshaped()) entry *= std::sqrt(0.5);
    add_product(block_of(H), block_of(H), -1.0, block_of(W), Part::lower);
    return W;
  }

  // Σ Wₐ_b ∂Rₐ_b of these rows of column j and of their mirror.
  void add_slopes_of(const ParameterPlaces& places, const Eigen::MatrixXd& W, Index j, const Rows& rows,
                     double* g) const {
    Chunk weight(rows.count);
    for (Index i = 0; i < rows.count; ++i)
      weight.number[i] = 2.0 * W(rows.first + i, j) * C_(rows.first + i, j);
    for (Index k = 0; k < X_.cols(); ++k) {
      if (f_.family == Correlation::gaussian && !is_category(f_.levels, k)) {
        g[places.theta(k)] -=
            f_.theta[k] * weighted_squares(weight.number, rows.column(k), rows.x[k], rows.count);
        continue;
      }
      const Chunk h = distances(f_, rows, k);
      g[places.theta(k)] += dot(weight, slope_in_theta(f_, k, h));
      if (places.exponents) g[places.exponent(k)] += dot(weight, slope_in_exponent(f_, k, h));
    }
  }

  const LikelihoodProblem& in_;
  const CorrelationFunction& f_;
  double nugget_;
  const Family& family_;
  Eigen::MatrixXd X_, C_, L_;
  bool regular_ = false;
};

}  // namespace drawpoint::kriging::detail
