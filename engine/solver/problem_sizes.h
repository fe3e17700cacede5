// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <drawpoint/engine/solver/contact_problem.hpp>

/// Whether the arrays of a ContactProblem belong together: what assertions at the entries of the solver ask.
///
/// Whoever assembles a problem keeps to it; a problem from a file is checked where it is read, with messages.
/// Cost: linear in the pairs, in builds with assertions alone.
namespace drawpoint::engine::detail {

/// A side of a contact is a body or a part of the machine.
inline bool side_exists(const ContactProblem& problem, int index) {
  if (index >= 0) return index < static_cast<int>(problem.bodies.size());
  return problem.machine && part_of(index) < static_cast<int>(problem.machine->part_maps.size());
}

/// The pairs' points lie one after another, pair after pair, and there are no others.
inline bool points_in_order(const ContactProblem& problem) {
  std::size_t next = 0;
  for (const ContactPair& pair : problem.pairs) {
    if (pair.count < 0 || static_cast<std::size_t>(pair.first) != next) return false;
    next += static_cast<std::size_t>(pair.count);
  }
  return next == problem.points.size();
}

inline bool sides_exist(const ContactProblem& problem) {
  return std::all_of(problem.pairs.begin(), problem.pairs.end(), [&](const ContactPair& pair) {
    return side_exists(problem, pair.a) && side_exists(problem, pair.b);
  });
}

/// Everything of the machine has as many coordinates as its velocity, and each part its origin.
inline bool machine_sizes_agree(const SuperBody& machine) {
  const auto r = machine.velocity.size();
  return machine.velocity_before.size() == r && machine.origins.size() == machine.part_maps.size() &&
         std::all_of(machine.part_maps.begin(), machine.part_maps.end(),
                     [r](const SpatialMap& map) { return map.cols() == r; }) &&
         std::all_of(machine.rows.begin(), machine.rows.end(),
                     [r](const SuperBodyRow& row) { return row.jacobian.size() == r; });
}

}  // namespace drawpoint::engine::detail
