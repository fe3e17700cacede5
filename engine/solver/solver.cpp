// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/batch/batched_solver.h>
#include <drawpoint/engine/solver/impact_stage.h>
#include <drawpoint/engine/solver/sequential_solver.h>
#include <drawpoint/engine/solver/solver.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine {

std::string_view to_string(Method method) { return method == Method::sequential ? "sequential" : "coloured"; }

Method method_named(std::string_view name) {
  for (const Method method : {Method::sequential, Method::coloured})
    if (name == to_string(method)) return method;
  throw std::invalid_argument("engine::method_named: no method \"" + std::string(name) +
                              "\"; known: sequential, coloured");
}

ContactSolver::ContactSolver(const SolverOptions& options)
    : ContactSolver(options, std::make_shared<const detail::Parallel>(options.threads)) {}

ContactSolver::ContactSolver(const SolverOptions& options, std::shared_ptr<const detail::Parallel> parallel)
    : options_(options),
      parallel_(std::move(parallel)),
      coloured_(std::make_unique<detail::ColouredSolver>(options, parallel_)),
      impacts_(std::make_unique<detail::ImpactStage>()) {}
ContactSolver::~ContactSolver() = default;
ContactSolver::ContactSolver(ContactSolver&&) noexcept = default;
ContactSolver& ContactSolver::operator=(ContactSolver&&) noexcept = default;

SolverReport ContactSolver::solve(ContactProblem& problem) {
  impacts_->run(problem, *parallel_);
  SolverReport report =
      options_.method == Method::coloured ? coloured_->solve(problem) : solve_sequentially(problem, options_);
  impacts_->finish(problem, report.machine);
  return report;
}

SolverReport solve(ContactProblem& problem, const SolverOptions& options) {
  return ContactSolver(options).solve(problem);
}

}  // namespace drawpoint::engine
