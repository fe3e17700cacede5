// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Sparse>
#include <drawpoint/engine/solver/solver.hpp>

/// A contact problem as one sparse system, for methods that think in matrices; one whole step, S = 1.
///
/// Velocities x are 6 per body (linear; angular), then the machine's w. Rows of J, in this order: n, t1, t2
/// of each point, n, t1, t2 of each pair's moment, the machine's rows. With the impulses λ by row,
///     x = x_free + M⁻¹ Jᵀ λ,   g = J x + Σ λ − b,   but of normals g_n = max(u + Σ λ − b, u − c), u = (J x)_n,
/// with c = push_out_speed, beyond which overlapping bodies are not pushed apart. The law asks for: points 0 ≤ λ_n ⊥
/// g_n ≥ 0 and |λ_t| ≤ μ λ_n with g_t against λ_t; pairs the same with their arms times the pair's Σ λ_n as limits;
/// machine rows λ within [lower, upper], g complementary. The normals' Σ λ − min(b, Σ λ + c) grows with λ, by Σ at
/// most: g is still the gradient of a convex function where there is no friction, with J M⁻¹ Jᵀ + Σ as its bound.
namespace drawpoint::benchmarks {

struct MatrixForm {
  explicit MatrixForm(const engine::ContactProblem& problem);

  Eigen::Index point_row(std::size_t point) const { return 3 * static_cast<Eigen::Index>(point); }
  Eigen::Index pair_row(std::size_t pair) const { return pairs_begin + 3 * static_cast<Eigen::Index>(pair); }

  /// Onto the limits that the law sets at the present normal impulses: λ_n ≥ 0, then the discs of friction
  /// and moments, then the machine's limits.
  void project(const engine::ContactProblem& problem, Eigen::VectorXd& impulses) const;

  /// g of impulses by row whose velocities are x.
  Eigen::VectorXd errors(const Eigen::VectorXd& impulses, const Eigen::VectorXd& x) const;

  /// Writes the solution into the problem, all "out" fields, and returns the machine's part.
  engine::SolverReport store(engine::ContactProblem& problem, const Eigen::VectorXd& impulses,
                             const Eigen::VectorXd& x) const;

  Eigen::SparseMatrix<double, Eigen::RowMajor> J, inverse_mass;  ///< rows x velocities, velocities²
  Eigen::VectorXd x_free;                                        ///< after outer forces, before impulses
  Eigen::VectorXd sigma, b;                                      ///< by row
  Eigen::VectorXd start;  ///< impulses to start from, by row; not projected on their limits
  /// 1 / (diagonal of J M⁻¹ Jᵀ + Σ); tangents share the inverse of their sum, which is above the block's
  /// largest eigenvalue; 0 where nothing answers.
  Eigen::VectorXd step_size;
  Eigen::VectorXd lower, upper;  ///< of the machine's rows, from `machine_begin` on
  Eigen::Index pairs_begin = 0, machine_begin = 0, rows = 0;
  std::vector<Eigen::Matrix3d> frames;  ///< rows n, t1, t2: of each point, then of each pair
};

}  // namespace drawpoint::benchmarks
