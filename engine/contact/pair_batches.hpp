// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/contact/colouring.hpp>
#include <drawpoint/engine/contact/pair_batch.hpp>

/// A ContactProblem laid out in batches, and back.
namespace drawpoint::engine::contact::detail {

class PairBatches {
 public:
  PairBatches(const ContactProblem& problem, const Colouring& colouring, int substeps);

  BatchArrays arrays() {
    return {pairs_.data(), points_.data(), bodies.data(), end.data(), responses_.data()};
  }
  int count() const { return static_cast<int>(pairs_.size()); }
  const std::vector<BatchRange>& colours() const { return colours_; }

  double change() const;       ///< Σ|Δλ| of the last sweep [N s]
  double normal_load() const;  ///< Σ λ_n of the substep [N s]

  /// Writes the impulses of the step and the last substep into the problem.
  void store(ContactProblem& problem, int substeps) const;

  /// Velocities now, at the end of the last substep, and at its beginning. Row k is body k; rows beyond the
  /// bodies stand for fixed ones.
  std::vector<BodyRow> bodies, end, begin;

 private:
  void add_batch(const ContactProblem& problem, const int* members, int count, int substeps);
  void add_pair(const ContactProblem& problem, PairBatch& batch, int lane, int index, int substeps);
  int row_of(const ContactProblem& problem, int body);
  void add_row(const SolverBody& body);

  std::vector<PairBatch> pairs_;
  std::vector<PointBatch> points_;
  std::vector<BodyResponse> responses_;
  std::vector<BatchRange> colours_;
  std::vector<int> members_;  // pair of each lane, in the order of batches and lanes
};

}  // namespace drawpoint::engine::contact::detail
