// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <drawpoint/benchmarks/micro/contact_methods.hpp>
#include <stdexcept>

namespace drawpoint::benchmarks {
namespace {

using engine::ContactProblem;
using engine::Method;
using engine::SolverOptions;
using engine::SolverReport;

template <Method method>
SolverReport solve_by(ContactProblem& problem, const SolverOptions& options) {
  SolverOptions chosen = options;
  chosen.method = method;
  return engine::solve(problem, chosen);
}

// Made on first use, so that files may register in any order.
std::vector<ContactMethod>& table() {
  static std::vector<ContactMethod> methods{{"sequential", solve_by<Method::sequential>, true},
                                            {"coloured", solve_by<Method::coloured>, true}};
  return methods;
}

}  // namespace

std::vector<ContactMethod> contact_methods() {
  std::vector<ContactMethod> methods = table();
  std::sort(methods.begin(), methods.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return methods;
}

ContactMethod contact_method(const std::string& name) {
  std::string known;
  for (const ContactMethod& method : contact_methods()) {
    if (method.name == name) return method;
    known += (known.empty() ? "" : ", ") + method.name;
  }
  throw std::invalid_argument("no method \"" + name + "\"; known: " + known);
}

SolverOptions fixed_work(int substeps, int sweeps, int threads) {
  return {.substeps = substeps, .sweeps = sweeps, .spare_work = 0, .threads = threads};
}

RegisteredMethod::RegisteredMethod(const ContactMethod& method) { table().push_back(method); }

}  // namespace drawpoint::benchmarks
