// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/tests/support/scenes.hpp>

/// The six rocks as bodies, for scenes.
namespace drawpoint::support {

/// One of the six rocks at a longest dimension [m].
inline engine::RockBody rock_body(int shape, double size, double density = 4500) {
  const auto scaled = engine::granular::rock_shapes()[shape].scaled(size);
  const auto properties = engine::mass_properties(scaled, density);
  return {shared(scaled), properties.mass, properties.inertia.diagonal(), 0};
}

}  // namespace drawpoint::support
