// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>
#include <drawpoint/engine/solver/solver_options.hpp>
#include <vector>

/// Small groups of touching bodies whose masses differ too much for iterations: they are solved directly.
///
/// An island is what contacts join through bodies that can move. One of at most 64 points whose heaviest body has
/// at least 3000 times the mass of its lightest is solved once more, alone, by Newton's method (direct_solution.h), and
/// that solution replaces the one of the iterations. A tower of 10⁶ : 1 then stands; iterations need as
/// many as the ratio. Islands that touch the machine and larger ones keep what the iterations found.
namespace drawpoint::engine::detail {

/// Whether the heaviest body that moves has 3000 times the mass of the lightest.
bool masses_differ(const std::vector<SolverBody>& bodies);
/// Whether they do, in a problem small enough, and without a machine.
bool solvable_directly(const ContactProblem& problem);

class HeavyIslands {
 public:
  /// Copies the islands out, before a solve changes them. Costs a look at the masses where there is none.
  void take(const ContactProblem& problem);
  /// Solves them and writes bodies, pairs and points back.
  void solve(ContactProblem& problem, const SolverOptions& options);

 private:
  struct Island {
    ContactProblem problem;
    std::vector<int> bodies, pairs;  // of the whole problem
  };

  Island copy(const ContactProblem& problem, const std::vector<int>& pairs);
  void put(const Island& island, ContactProblem& problem) const;

  std::vector<Island> islands_;
  std::vector<int> place_;  // of a body in the island that is copied, -1 elsewhere
};

}  // namespace drawpoint::engine::detail
