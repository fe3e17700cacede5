// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/batch/machine_pairs.h>
#include <drawpoint/engine/solver/batch/pair_batches.h>
#include <drawpoint/engine/solver/motion_change.h>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <drawpoint/engine/solver/solver_options.hpp>
#include <drawpoint/engine/solver/solver_report.hpp>
#include <memory>
#include <optional>

/// The fast method: sixteen pairs at a time that share no body, subdomains of the scene on threads, single
/// precision.
///
/// A pile at rest costs one iteration: when the first substep leaves every velocity and impulse as it was, the others
/// would too, and are not made (constants::standing_speed).
///
/// Pairs that touch the machine are solved one after another in double precision before the others
/// (iteration_order.h), on the same velocities. Bodies that touch nothing keep double precision. Velocities
/// and impulses of the others have 24 bits: a residual below about 1e-6 of the load is round-off, and
/// momentum is kept to 6e-8 of a body's own an iteration. Positions stay in double precision outside. Cost
/// and figures: docs/measurements/contact-solving.md.
namespace drawpoint::engine::detail {

class BatchedSolver {
 public:
  BatchedSolver(const SolverOptions& options, std::shared_ptr<const ThreadPool> pool)
      : options_(options), pool_(std::move(pool)) {}

  SolverReport solve(ContactProblem& problem);

 private:
  template <class Kernel>
  void everywhere(const Kernel& kernel);  // for kernels that do not write bodies
  template <class Kernel>
  void each_stage(const Kernel& kernel);  // for kernels that do
  int most_parts() const;
  template <class Work>
  void each_block_of_rows(const Work& work);  // of the bodies: from the first row to before the last
  template <class Work>
  void each_row(const Work& work);
  void run_substep(int number);
  bool stands() const;
  bool bodies_stand(const std::vector<BodyRow>& rows) const;
  void stand();
  void run_machine_alone();
  void start();
  void extrapolate();
  void add_momentum(int k, Iteration& iteration);
  void iteration(const Iteration& this_iteration);
  void displacement(int row);
  void find_touched();
  void store_bodies();
  void store_body(int index);
  SolverReport report();
  float substep() const { return static_cast<float>(problem_->step / options_.substeps); }
  double change() const { return batches_.change() + machine_change_; }  // of impulses
  bool watches() const;
  void weigh();
  void begin_to_watch();
  void watch();  // what the iteration has changed of the motion since it was watched last
  double normal_load() const { return batches_.normal_load() + machine_->normal_load(); }

  SolverOptions options_;
  std::shared_ptr<const ThreadPool> pool_;
  PairBatches batches_;
  std::vector<BodyRow> travel_;        // by row: ∫ v dt, ∫ ω dt
  std::vector<BodyRow> previous_;      // by row: velocities that momentum goes on from
  std::vector<BodyRow> weights_;       // by row, of each component
  std::vector<BodyRow> watched_;       // by row: velocities after the last iteration
  std::vector<MotionChange> changes_;  // by block of rows
  std::vector<char> touched_;          // by body: in a pair
  std::vector<char> pushed_;           // by body, in the end: by a contact

  // During a solve.
  ContactProblem* problem_ = nullptr;
  std::optional<MachinePairs> machine_;
  int threads_ = 1;
  int iterations_ = 0;
  double motion_change_ = 0;   // by the last iteration that was watched [N s]
  double machine_change_ = 0;  // of the machine's pairs in the last iteration
};

}  // namespace drawpoint::engine::detail
