// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <drawpoint/engine/solver/contact_problem.hpp>

/// What an iteration does to motion, by which its solver decides whether to go on.
///
/// Σ m (|Δv| + r|Δω|) over the bodies, r the radius of gyration. Not the change of the impulses: points that
/// share a load in many ways hand it to and fro for thousands of iterations without moving anything.
/// Velocities have a last bit: below what it is worth nothing converges, and a body that goes by at 4 m/s has
/// more of it, in single precision, than a pile at rest.
namespace drawpoint::engine::detail {

/// Mass and mass times radius of gyration of a body, 0 for a fixed one.
struct MotionWeight {
  float mass = 0, turning = 0;  // [kg], [kg m]

  static MotionWeight of(const SolverBody& body) {
    if (!(body.inverse_mass > 0)) return {};
    const double inertia = 3 / body.inverse_inertia.trace();
    return {static_cast<float>(1 / body.inverse_mass),
            std::isfinite(inertia) ? static_cast<float>(std::sqrt(inertia / body.inverse_mass)) : 0.0f};
  }
};

/// Σ|Δp| of an iteration and what of it is the last bit of velocities [N s].
struct MotionChange {
  double moved = 0, last_bit = 0;

  MotionChange& operator+=(const MotionChange& other) {
    moved += other.moved, last_bit += other.last_bit;
    return *this;
  }
  /// Beyond the last bit.
  double beyond() const { return moved > last_bit ? moved : 0; }
};

}  // namespace drawpoint::engine::detail
