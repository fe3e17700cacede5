// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>

/// Sums up what the impulses of a problem give to its bodies and its machine: Jᵀ λ, linear in the points.

namespace drawpoint::engine::detail {

struct ReceivedImpulses {
  std::vector<Eigen::Vector3d> linear, angular;  ///< by body, about its centre [N s, N m s]
  Eigen::VectorXd machine;                       ///< Δw, of contacts and rows; empty without a machine
};

/// Which impulses, and what to multiply them with.
struct ImpulseChoice {
  Eigen::Vector3d ContactPoint::*point = &ContactPoint::impulse;
  Eigen::Vector3d ContactPair::*pair = &ContactPair::impulse;
  std::vector<double> SuperBodySolution::*rows = &SuperBodySolution::row_impulses;
  double factor = 1;
};

inline constexpr ImpulseChoice of_the_step{};
/// The last of S substeps.
inline ImpulseChoice of_the_last_substep(int substeps) {
  return {&ContactPoint::start, &ContactPair::start, &SuperBodySolution::row_starts, 1.0 / substeps};
}

ReceivedImpulses received_impulses(const ContactProblem& problem, const SuperBodySolution& machine,
                                   const ImpulseChoice& choice);

}  // namespace drawpoint::engine::detail
