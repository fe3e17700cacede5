// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a vertical line has of a rock: it is clipped against the half-spaces of the rock's faces, which is
/// exact for a convex polyhedron. World frame, z up, metres.

#include <drawpoint/engine/world/rock.hpp>
#include <optional>

namespace drawpoint::engine::granular {

/// Heights at which the line enters and leaves the rock [m].
struct Chord {
  double low = 0, high = 0;
};

/// Chord of a rock, whose shape is a polyhedron, along the vertical line over (x, y); empty where that misses it.
std::optional<Chord> chord(const engine::Rock& rock, const Eigen::Vector2d& place);

}  // namespace drawpoint::engine::granular
