// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/collision/contact_finder_options.hpp>
#include <drawpoint/engine/solver/solver_options.hpp>

/// How a world is stepped.
namespace drawpoint::engine {

struct WorldOptions {
  double step = 0.01;                                      ///< h [s], 1e-9 to 0.1
  Eigen::Vector3d gravity = Eigen::Vector3d(0, 0, -9.81);  ///< [m/s²]
  int threads = 1;                                         ///< 1 to 256; never changes a bit
  SolverOptions solver;
  /// Fraction of last step's impulses to start from, 0 to 1. Less than 1 forgets load that the iterations must
  /// then find again each step: a pile creeps.
  double warm_start = 1;
  ContactFinderOptions contacts;
};

}  // namespace drawpoint::engine
