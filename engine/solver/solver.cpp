// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/batch/batched_solver.h>
#include <drawpoint/engine/solver/heavy_islands.h>
#include <drawpoint/engine/solver/impact_stage.h>
#include <drawpoint/engine/solver/problem_sizes.h>
#include <drawpoint/engine/solver/sequential_solver.h>
#include <cassert>
#include <cmath>
#include <drawpoint/engine/base/checks.hpp>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/solver/solver.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::engine {
namespace {

void check(const SolverOptions& options) {
  const auto require = [](const std::string& name, double value, const detail::Range& allowed) {
    detail::require("engine::ContactSolver: " + name, value, allowed);
  };
  require("method", static_cast<int>(options.method), {0, 1, "(Method::sequential, Method::batched)"});
  require("substeps", options.substeps, {1, 1e4, "per step"});
  require("iterations", options.iterations, {1, 1e6, "per substep"});
  require("iteration_budget", options.iteration_budget, {0, 1e9, "iterations times points"});
  require("tolerance", options.tolerance, {0, 1, "of the load"});
}

void check_step(double step) {
  if (step > 0 && std::isfinite(step)) return;
  throw std::invalid_argument("engine::solve: the problem's step is " + detail::text(step) +
                              " s; allowed: above 0, finite; set ContactProblem::step");
}

// No force, so no moment; the methods that go by points never come to such a pair.
void clear_pairs_without_points(ContactProblem& problem) {
  for (ContactPair& pair : problem.pairs)
    if (pair.count == 0) pair.start = pair.impulse = Eigen::Vector3d::Zero();
}

}  // namespace

std::string_view to_string(Method method) { return method == Method::sequential ? "sequential" : "batched"; }

Method method_named(std::string_view name) {
  for (const Method method : {Method::sequential, Method::batched})
    if (name == to_string(method)) return method;
  throw std::invalid_argument("engine::method_named: no method \"" + std::string(name) +
                              "\"; known: sequential, batched");
}

ContactSolver::ContactSolver(const SolverOptions& options, std::shared_ptr<const ThreadPool> pool)
    : options_((check(options), options)),
      pool_(pool ? std::move(pool) : std::make_shared<const ThreadPool>(1)),
      batched_(std::make_unique<detail::BatchedSolver>(options, pool_)),
      impacts_(std::make_unique<detail::ImpactStage>()),
      islands_(std::make_unique<detail::HeavyIslands>()) {}
ContactSolver::~ContactSolver() = default;
ContactSolver::ContactSolver(ContactSolver&&) noexcept = default;
ContactSolver& ContactSolver::operator=(ContactSolver&&) noexcept = default;

SolverReport ContactSolver::solve(ContactProblem& problem) {
  assert(detail::points_in_order(problem) && "the pairs' points lie pair after pair, without gaps");
  assert(detail::sides_exist(problem) && "each side of a pair is a body or a part of the machine");
  assert((!problem.machine || detail::machine_sizes_agree(*problem.machine)) &&
         "the machine's maps, origins and rows have its number of coordinates");
  check_step(problem.step);
  clear_pairs_without_points(problem);
  impacts_->run(problem, *pool_);
  islands_->take(problem);
  SolverReport report =
      options_.method == Method::batched ? batched_->solve(problem) : solve_sequentially(problem, options_);
  islands_->solve(problem, options_);
  impacts_->finish(problem, report.machine);
  return report;
}

SolverReport solve(ContactProblem& problem, const SolverOptions& options,
                   std::shared_ptr<const ThreadPool> pool) {
  return ContactSolver(options, std::move(pool)).solve(problem);
}

}  // namespace drawpoint::engine
