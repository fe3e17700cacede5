// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/batch/pair_batch.h>
#include <drawpoint/engine/solver/sequential_iteration.h>

/// The machine's rows and the pairs that touch it, swept in double precision on the velocities of a batch
/// solve.
namespace drawpoint::engine::detail {

class MachinePairs {
 public:
  /// `row_of`: of each body in the batch solve.
  MachinePairs(const ContactProblem& problem, const std::vector<int>& row_of, int substeps);

  void refresh(const std::vector<BodyRow>& end);
  void start(std::vector<BodyRow>& bodies);
  void extrapolate() { iteration_.extrapolate(); }
  void correct(std::vector<BodyRow>& bodies);
  void add_momentum(double share) { iteration_.add_momentum(share); }  ///< the bodies are the caller's
  double iteration(std::vector<BodyRow>& bodies);                      ///< returns Σ|Δλ|
  double moved() { return iteration_.machine_moved(); }                ///< as SuperBodyMotion::moved()
  bool touches_bodies() const;                                         ///< that move
  bool stands(double speed) const { return iteration_.stands(speed); }
  void repeat(int substeps) { iteration_.repeat(substeps); }
  std::size_t points() const { return part_.points.size(); }
  void finish() { iteration_.finish(); }
  double normal_load() const { return iteration_.normal_load(); }
  ResidualSums residual_sums(const std::vector<BodyRow>& bodies);
  SuperBodySolution store(ContactProblem& problem);

 private:
  static ContactProblem part_of_problem(const ContactProblem& problem, const std::vector<int>& row_of,
                                        std::vector<int>& rows, std::vector<int>& members);
  void gather_bodies(const std::vector<BodyRow>& bodies);
  void put_back(std::vector<BodyRow>& bodies) const;

  std::vector<int> rows_, members_;  // body row of each body, pair of each pair of the part
  ContactProblem part_;
  SequentialIteration iteration_;
};

}  // namespace drawpoint::engine::detail
