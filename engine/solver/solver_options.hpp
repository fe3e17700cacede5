// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

/// Which method solves a contact problem, and how much work it may do; what the numbers mean stands in
/// solver.hpp.
namespace drawpoint::engine {

enum class Method { sequential, batched };

/// "sequential", "batched".
std::string_view to_string(Method method);
/// Throws std::invalid_argument with the known names.
Method method_named(std::string_view name);

struct SolverOptions {
  Method method = Method::batched;
  int substeps = 16;   ///< S ≥ 1
  int iterations = 1;  ///< per substep, at least, ≥ 1
  /// A substep adds iterations until one changes the bodies' momentum by less than `tolerance` of the normal
  /// load, as long as iterations times points stay below `iteration_budget`: a pile at rest needs none, rocks
  /// in motion some, and small problems, which are cheap, as many as it takes. With 0 none is added. A
  /// machine that digs needs some five iterations per substep: with one, its bucket loads half as much again
  /// (docs/decisions/0011).
  int iteration_budget = 8000;
  /// Share of Σ λ_n by which an iteration changes momenta (motion_change.h) when the iterations end; 0 uses all
  /// that the budget allows. In loading cycles velocities were off by 1 to 3 times what the last iteration changed
  /// (docs/measurements/contact-solving.md): the default solves small problems to the end, 0.02 is enough for
  /// a machine in a large pile.
  double tolerance = 1e-5;
};

/// The most iterations per substep for a number of points.
inline int most_iterations(const SolverOptions& options, std::size_t points) {
  return std::max(options.iterations, options.iteration_budget / std::max(1, static_cast<int>(points)));
}

/// Whether iteration k of a substep, counted from 0, is made, after one that changed momenta by `change`
/// under a load Σ λ_n = `load`, both [N s].
inline bool goes_on(const SolverOptions& options, std::size_t points, int k, double change, double load) {
  return k < options.iterations || (k < most_iterations(options, points) &&
                                    (change > options.tolerance * load || options.tolerance == 0));
}

}  // namespace drawpoint::engine
