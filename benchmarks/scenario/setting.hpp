// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/world.hpp>
#include <string>

/// A choice of step and work of the solver, in one word: STEPxSUBSTEPSxITERATIONS, with +BUDGET for iteration
/// budget and ~TOLERANCE after that. "10x16x1+20000~0.02" is 10 ms, 16 substeps of at least one iteration, and more up
/// to 20 000 iterations times points, until one changes less than 0.02 of the load.
namespace drawpoint::benchmarks {

struct Setting {
  double step = 0;  ///< [s]
  int substeps = 1, iterations = 1, iteration_budget = 0;
  double tolerance = engine::SolverOptions{}.tolerance;
};

/// Throws std::invalid_argument with the text, the form and the ranges: 0.01 to 10 ms, up to 1000 substeps,
/// 1e6 iterations, 1e9 iteration budget, tolerance of 0 to 1.
Setting setting_of(const std::string& text);
std::string name_of(const Setting& setting);

/// The options with this step and work; all else stays.
engine::WorldOptions with(engine::WorldOptions options, const Setting& setting);

}  // namespace drawpoint::benchmarks
