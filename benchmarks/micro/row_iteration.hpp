// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/benchmarks/micro/matrix_form.hpp>

/// Projected Gauss-Seidel iterations on a MatrixForm, for methods that accelerate them; whole steps, S = 1.
///
/// Impulses and velocities lie in plain vectors, so a method may look at what an iteration changed, mix iterations
/// and go on from there: x = x_free + M⁻¹ Jᵀ λ is linear, and the same combination serves both. An iteration takes
/// the steps of the engine's sequential method (contact_law-inl.h): machine rows, then each pair's points and
/// moments. Cost: about 150 ns per point and iteration, the products of sparse rows with x.
namespace drawpoint::benchmarks {

class RowIteration {
 public:
  /// Starts from form.start, projected. Keeps references to both.
  RowIteration(const engine::ContactProblem& problem, const MatrixForm& form);

  /// One iteration, through the pairs in their order or, if not `forth`, back.
  void iterate(bool forth = true);
  /// Puts the impulses on the law's limits and makes the velocities go with them anew.
  void project();

  Eigen::VectorXd impulses, velocities;  ///< λ by row; x

 private:
  Eigen::Vector3d velocity(Eigen::Index row) const;
  void apply(Eigen::Index row, const Eigen::Vector3d& delta);
  void iterate_machine();
  void iterate_pair(std::size_t pair);
  void solve_point(Eigen::Index row, double friction);
  void solve_moment(std::size_t pair, double load);

  const engine::ContactProblem& problem_;
  const MatrixForm& form_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> response_;  // rows x velocities: (M⁻¹ Jᵀ)ᵀ
  std::vector<Eigen::Matrix3d> blocks_;                    // W of each point, then of each pair
};

}  // namespace drawpoint::benchmarks
