// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <drawpoint/benchmarks/micro/contact_methods.hpp>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <memory>
#include <stdexcept>

namespace drawpoint::benchmarks {
namespace {

using engine::ContactProblem;
using engine::Method;
using engine::SolverReport;

template <Method method>
Ready set_up(const MethodOptions& options) {
  engine::SolverOptions chosen = options;
  chosen.method = method;
  const auto solver = std::make_shared<engine::ContactSolver>(
      chosen, std::make_shared<const engine::ThreadPool>(options.threads));
  return [solver](ContactProblem& problem) { return solver->solve(problem); };
}

template <Method method>
SolverReport solve_by(ContactProblem& problem, const MethodOptions& options) {
  return set_up<method>(options)(problem);
}

// Made on first use, so that files may register in any order.
std::vector<ContactMethod>& table() {
  static std::vector<ContactMethod> methods{
      {"sequential", solve_by<Method::sequential>, true, set_up<Method::sequential>},
      {"batched", solve_by<Method::batched>, true, set_up<Method::batched>}};
  return methods;
}

}  // namespace

std::vector<ContactMethod> contact_methods() {
  std::vector<ContactMethod> methods = table();
  std::sort(methods.begin(), methods.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  const auto same = [](const auto& a, const auto& b) { return a.name == b.name; };
  const auto twice = std::adjacent_find(methods.begin(), methods.end(), same);
  if (twice != methods.end())
    throw std::logic_error("contact methods: two have the name \"" + twice->name + "\"; give one another");
  return methods;
}

Ready ready(const ContactMethod& method, const MethodOptions& options) {
  if (method.set_up) return method.set_up(options);
  return [solve = method.solve, options](ContactProblem& problem) { return solve(problem, options); };
}

ContactMethod contact_method(const std::string& name) {
  std::string known;
  for (const ContactMethod& method : contact_methods()) {
    if (method.name == name) return method;
    known += (known.empty() ? "" : ", ") + method.name;
  }
  throw std::invalid_argument("no method \"" + name + "\"; known: " + known);
}

MethodOptions fixed_work(int substeps, int iterations, int threads) {
  MethodOptions options;
  options.substeps = substeps;
  options.iterations = iterations;
  options.iteration_budget = 0;
  options.threads = threads;
  return options;
}

RegisteredMethod::RegisteredMethod(const ContactMethod& method) { table().push_back(method); }

}  // namespace drawpoint::benchmarks
