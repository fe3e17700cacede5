// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How far a point is from the first-order conditions of a Pareto optimum.
///
/// x is Pareto-stationary iff Σ λ_j ∇f_j + Σ μ_c ∇g_c = 0 with λ, μ >= 0, Σ λ_j = 1, over the objectives and
/// the active constraints g_c <= 0 (Fritz John; active bounds are constraints). The residual is
///   r = min ‖Σ λ_j ∇f_j + Σ μ_c ∇g_c‖ / max_j ‖∇f_j‖,
/// 0 at a stationary point, 1 where all gradients agree. It depends on how variables and objectives are
/// scaled. With q the least square of the norm, the minimum over z = (λ, μ) >= 0 of ‖A z‖² + (Σ λ_j - 1)² is
/// q/(1 + q), reached at a multiple of the same z: so non-negative least squares solves it exactly (Lawson,
/// Hanson 1974, algorithm 23.10). Cost: a few factorisations of d x (m + active constraints).

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

namespace drawpoint::pareto {

namespace detail {

/// Coefficients of the chosen columns of A whose sum is nearest to b; 0 for a column that those before it
/// make up to twelve digits. By Gram-Schmidt, twice per column: Eigen's QR costs its users seconds of compile
/// time.
inline Eigen::VectorXd nearest_sum(const Eigen::MatrixXd& A, const std::vector<int>& chosen,
                                   Eigen::VectorXd b) {
  const auto count = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd Q(A.rows(), count), T = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    Eigen::VectorXd v = A.col(chosen[static_cast<std::size_t>(k)]);
    const double least = 1e-12 * v.norm();
    for (int pass = 0; pass < 2; ++pass)
      for (Eigen::Index j = 0; j < k; ++j) {
        const double part = Q.col(j).dot(v);
        v -= part * Q.col(j);
        T(j, k) += part;
      }
    T(k, k) = v.norm();
    Q.col(k) = v;
    if (!(T(k, k) > least)) {
      Q.col(k).setZero();
      T(k, k) = std::numeric_limits<double>::infinity();
      continue;
    }
    Q.col(k) /= T(k, k);
    z[k] = Q.col(k).dot(b);
    b -= z[k] * Q.col(k);
  }
  for (Eigen::Index k = count - 1; k >= 0; --k) {
    z[k] /= T(k, k);
    for (Eigen::Index j = 0; j < k; ++j) z[j] -= T(j, k) * z[k];
  }
  return z;
}

/// min ‖A z - b‖ over z >= 0. Ends when no gradient beyond rounding points inwards, or after 3 n exchanges.
inline Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::Index n = A.cols();
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
  std::vector<int> passive;
  const double rounding = 1e-14 * A.cwiseAbs().colwise().sum().maxCoeff() * b.cwiseAbs().maxCoeff();
  for (Eigen::Index exchange = 0; exchange < 3 * n; ++exchange) {
    const Eigen::VectorXd miss = b - A * z, pull = A.transpose() * miss;
    int entering = -1;
    for (int j = 0; j < n; ++j)
      if (std::find(passive.begin(), passive.end(), j) == passive.end() && pull[j] > rounding &&
          (entering < 0 || pull[j] > pull[entering]))
        entering = j;
    if (entering < 0) break;
    passive.push_back(entering);
    while (!passive.empty()) {
      const Eigen::VectorXd s = nearest_sum(A, passive, b);
      if (s.minCoeff() > 0.0) {
        z.setZero();
        for (std::size_t k = 0; k < passive.size(); ++k) z[passive[k]] = s[static_cast<Eigen::Index>(k)];
        break;
      }
      double step = 1.0;  // as far towards s as every number stays non-negative
      for (std::size_t k = 0; k < passive.size(); ++k)
        if (const double to = s[static_cast<Eigen::Index>(k)]; to <= 0.0)
          step = std::min(step, z[passive[k]] / (z[passive[k]] - to + 1e-300));
      for (std::size_t k = 0; k < passive.size(); ++k)
        z[passive[k]] += step * (s[static_cast<Eigen::Index>(k)] - z[passive[k]]);
      const auto gone = [&](int j) { return z[j] <= 1e-15 * z.maxCoeff(); };
      for (const int j : passive)
        if (gone(j)) z[j] = 0.0;
      passive.erase(std::remove_if(passive.begin(), passive.end(), [&](int j) { return z[j] == 0.0; }),
                    passive.end());
    }
  }
  return z;
}

}  // namespace detail

/// The residual r and the weights that reach it.
struct Stationarity {
  double residual = 0.0;
  Eigen::VectorXd weights;      ///< λ: m, sum 1; at an optimum the trade-off rates between the objectives
  Eigen::VectorXd multipliers;  ///< μ of the constraint gradients, as given
};

/// objectives: m x d gradients of what is minimised; constraints: k x d gradients of the active g_c <= 0 (an
/// active lower bound of x_i has -e_i, an upper one e_i).
inline Stationarity stationarity(const Eigen::MatrixXd& objectives, const Eigen::MatrixXd& constraints) {
  const Eigen::Index m = objectives.rows(), k = constraints.rows(), d = objectives.cols();
  const double scale = std::max(objectives.rowwise().norm().maxCoeff(), 1e-300);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(d + 1, m + k);
  A.topLeftCorner(d, m) = objectives.transpose() / scale;
  for (Eigen::Index c = 0; c < k; ++c)
    A.col(m + c).head(d) = constraints.row(c).transpose() / std::max(constraints.row(c).norm(), 1e-300);
  A.row(d).head(m).setOnes();
  const Eigen::VectorXd z = detail::non_negative_least_squares(A, Eigen::VectorXd::Unit(d + 1, d));
  const double sum = z.head(m).sum();
  Stationarity result{0.0, z.head(m) / sum, z.tail(k) / sum};
  result.residual = (A.topRows(d) * z).norm() / sum;
  for (Eigen::Index c = 0; c < k; ++c)
    result.multipliers[c] *= scale / std::max(constraints.row(c).norm(), 1e-300);
  return result;
}

}  // namespace drawpoint::pareto
