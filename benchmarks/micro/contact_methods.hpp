// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/solver.hpp>
#include <functional>
#include <string>
#include <vector>

/// The contact methods that the benchmarks know, by name.
///
/// A method is a function that solves a problem in place: it fills every "out" field of bodies, pairs and
/// points, and returns the machine's part. The engine's own are in the table; any other is one file in
/// methods/ that holds the function and a `const RegisteredMethod` at namespace scope. The build takes every
/// file there.
namespace drawpoint::benchmarks {

struct MethodOptions : engine::SolverOptions {
  int threads = 1;  ///< for the methods that know them
};

using Solve = engine::SolverReport (*)(engine::ContactProblem&, const MethodOptions&);

/// A method that is set up: with its threads, and with buffers that keep their size from solve to solve.
using Ready = std::function<engine::SolverReport(engine::ContactProblem&)>;

struct ContactMethod {
  std::string name;
  Solve solve;
  bool takes_substeps = false;                      ///< else it is only asked for S = 1
  Ready (*set_up)(const MethodOptions&) = nullptr;  ///< for methods that have something to set up
};

/// By set_up(), or solve with these options where there is nothing to set up.
Ready ready(const ContactMethod& method, const MethodOptions& options);

/// By name.
std::vector<ContactMethod> contact_methods();
/// Throws std::invalid_argument with the known names.
ContactMethod contact_method(const std::string& name);

/// Just so many substeps and iterations, whatever they reach.
MethodOptions fixed_work(int substeps, int iterations, int threads = 1);

struct RegisteredMethod {
  explicit RegisteredMethod(const ContactMethod& method);
};

}  // namespace drawpoint::benchmarks
