// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/batch/iteration_order.h>
#include <drawpoint/engine/solver/batch/pair_batch.h>
#include <drawpoint/engine/solver/sequential_iteration.h>
#include <drawpoint/engine/base/thread_pool.hpp>

/// A ContactProblem laid out in batches, and back. Buffers are kept from solve to solve.
namespace drawpoint::engine::detail {

constexpr int batches_per_block = 8, bodies_per_block = 256;  // that a thread claims at a time: microseconds

class PairBatches {
 public:
  /// Lays out the pairs of the problem that the order has.
  void fill(const ContactProblem& problem, IterationOrder order, int substeps, const ThreadPool& pool);

  BatchArrays arrays() {
    return {pairs_.data(),      points_.data(),    bodies.data(), begin.data(),
            corrections.data(), responses_.data(), sums_.data()};
  }
  int count() const { return static_cast<int>(plans_.size()); }
  const IterationOrder& order() const { return order_; }

  double change() const;               ///< Σ|Δλ| of the last iteration [N s]
  double normal_load() const;          ///< Σ λ_n of the same [N s]
  ResidualSums residual_sums() const;  ///< after evaluate_batches()

  /// Writes the impulses of the step and the last substep into the problem.
  void store(ContactProblem& problem, int substeps, const ThreadPool& pool) const;

  /// Velocities now, those at the end of the last substep, and what the next one starts from less than it
  /// would by extrapolation. Rows are in order of place; rows beyond the bodies stand for fixed ones.
  std::vector<BodyRow> bodies, begin, corrections;
  std::vector<int> row_of;  ///< of each body

 private:
  /// Where a batch's pairs, points and own rows are. Fixed bodies and lanes without a pair have own rows.
  struct Plan {
    const int* members;
    int pairs, points, first_point, first_row;
  };

  void plan(const ContactProblem& problem);
  int own_rows(const ContactProblem& problem, const int* members, int pairs) const;
  void fill_bodies(const ContactProblem& problem, const ThreadPool& pool);
  void fill_row(int row, const SolverBody& body);
  inline void prefetch_ahead(const ContactProblem& problem, int index, int lane) const;
  void fill_batch(const ContactProblem& problem, int batch, int substeps);
  void fill_lane(const ContactProblem& problem, PairBatch& batch, int lane, const ContactPair& pair,
                 int substeps);
  void store_lane(ContactProblem& problem, const PairBatch& batch, int lane, ContactPair& pair,
                  int substeps) const;

  IterationOrder order_;
  std::vector<Plan> plans_;
  std::vector<PairBatch> pairs_;
  std::vector<PointBatch> points_;
  std::vector<BodyResponse> responses_;
  std::vector<BatchSums> sums_;
  int rows_ = 0, point_batches_ = 0;
};

}  // namespace drawpoint::engine::detail
