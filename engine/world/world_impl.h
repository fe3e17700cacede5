// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/contact_assembly.h>
#include <drawpoint/engine/world/scene.h>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/solver/solver.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <memory>
#include <vector>

/// The pipeline of a step and its owners: the scene, the assembly of its contacts, the solver.
namespace drawpoint::engine {

struct World::Impl {
  Impl(const WorldOptions& options, const MaterialTable& materials);

  StepReport step(double h);
  const std::vector<Manifold>& find_contacts(StepReport& report);
  SolverReport solve(const std::vector<Manifold>& manifolds, StepReport& report);
  void check_solution(const SuperBodySolution& solved) const;

  std::vector<PairForce> pair_forces() const;
  template <class Wanted>
  std::vector<PairForce> forces_of(const Wanted& of) const;
  Wrench wrench_on(const SurfaceOwner& body, const Eigen::Vector3d& about) const;

  WorldOptions options;
  std::shared_ptr<const ThreadPool> pool;
  detail::Scene scene;
  detail::ContactAssembly contacts;
  ContactSolver solver;
  Observer before_solve;
  long steps = 0;
  double time = 0;
  double last_step = 0;  // [s]; 0 before the first
};

}  // namespace drawpoint::engine
