// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/lhd.hpp>
#include <string>
#include <vector>

/// What makes the machine look like a loader in pictures, besides the surfaces that touch rock: rims, round
/// cylinders, teeth, cab windows, hood, lamps, pins. None of it touches anything, and all of it follows the
/// machine's measures.
namespace drawpoint::engine::loading {

/// In the frame of its body.
struct DrawnPart {
  int body = -1;
  engine::ConvexPolyhedron shape;
  std::string color;  ///< `#rrggbb`
};

std::vector<DrawnPart> machine_looks(const Lhd& lhd);

/// Whether a surface is drawn as it is: all that touch are. The bars in place of the cylinders are not, which
/// machine_looks has round.
bool is_drawn_as_it_is(const LhdSurface& surface);

}  // namespace drawpoint::engine::loading
