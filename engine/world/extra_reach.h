// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/motion.h>
#include <drawpoint/engine/geometry/shape.hpp>
#include <drawpoint/engine/world/rock.hpp>
#include <limits>
#include <vector>

/// How much farther around rocks and machine parts contacts are looked for than their velocities say, within the
/// present step.
///
/// Contacts are looked for as far as the velocities before the step carry. An impact within the step may
/// carry a rock elsewhere: through what it was not near, or out of step with one that flies along with it. So
/// after a solve each displacement d is held against h v: where |d − h v| > r + h² g + reach, with r the
/// least distance of the rock's surface from its centre, the reach becomes 2 |d − h v|, and the step is
/// searched and solved again. What is missed below that has its centre still before the surface that it
/// entered: the way out is the way it came in, and the next step takes it. Each round at least doubles a
/// reach, and no displacement is without bound, so the rounds end; a rock struck against a plate takes one. A
/// rock of 0.3 m in a step of 0.01 s needs a change of some 10 m/s, as after a fall of 5 m: a pile gives
/// none. A part of a machine, which its motors may start or stop within a step, has r of its thinnest shape: of its
/// surface from its middle. Cost: some ns per rock; a round costs a search and a solve.
namespace drawpoint::engine::detail {

class ExtraReach {
 public:
  /// Adds the next rock, in the order of their numbers.
  void add(const Shape& shape);
  /// `radius`: of the part's surface about its origin [m].
  void add_part(int part, const Shape& shape, double radius);
  void forget_parts() { parts_.clear(); }
  void begin_step();
  /// After a solve of a step of h [s], the rocks still where they were: whether a reach grew.
  bool grow(const std::vector<Rock>& rocks, const SolvedRocks& solved, double h);
  /// The same of the machine's parts.
  bool grow(const SuperBody& machine, const SuperBodySolution& solved, double h);
  double of(int rock) const { return reach_[static_cast<std::size_t>(rock)]; }             ///< [m]
  double of_part(int part) const { return parts_[static_cast<std::size_t>(part)].reach; }  ///< [m]

 private:
  struct Part {
    double allowed = std::numeric_limits<double>::infinity(), radius = 0, reach = 0;  // [m]
  };

  std::vector<double> allowed_, reach_;  // by rock [m]
  std::vector<Part> parts_;
  bool any_ = false;  // reach above 0
};

}  // namespace drawpoint::engine::detail
