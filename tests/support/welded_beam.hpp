// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>

/// A welded beam with five limits (Ragsdell, Phillips 1976), shared by tests and benchmarks. Its cheapest design,
/// 1.86164, lies where three limits meet: found by differential evolution with 240 000 runs.
namespace drawpoint::support {

/// `thickest`: weld and bar [in].
inline doe::Problem beam(double thickest) {
  return {.variables = {{"weld_height", "in", 0.125, thickest},
                        {"weld_length", "in", 0.1, 10.0},
                        {"bar_depth", "in", 0.1, 10.0},
                        {"bar_width", "in", 0.125, thickest}},
          .responses = {{"cost", "USD", doe::Goal::minimize},
                        {"shear_stress", "psi", doe::Goal::at_most, 13600.0},
                        {"bending_stress", "psi", doe::Goal::at_most, 30000.0},
                        {"weld_beyond_bar", "in", doe::Goal::at_most, 0.0},
                        {"deflection", "in", doe::Goal::at_most, 0.25},
                        {"buckling_load", "lbf", doe::Goal::at_least, 6000.0}}};
}

inline doe::Outcome weld(const Eigen::VectorXd& x) {
  const double h = x[0], l = x[1], t = x[2], b = x[3];
  const double q = 0.25 * (h + t) * (h + t), arm = std::sqrt(0.25 * l * l + q);
  const double direct = 6000.0 / (std::sqrt(2.0) * h * l);
  const double twist = 6000.0 * (14.0 + 0.5 * l) * arm / (2.0 * std::sqrt(2.0) * h * l * (l * l / 12.0 + q));
  return {1.10471 * h * h * l + 0.04811 * t * b * (14.0 + l),
          std::sqrt(direct * direct + twist * twist + l * direct * twist / arm),
          504000.0 / (t * t * b),
          h - b,
          2.1952 / (t * t * t * b),
          64746.022 * (1.0 - 0.0282346 * t) * t * b * b * b};
}

}  // namespace drawpoint::support
