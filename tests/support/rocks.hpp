// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/pile.hpp>
#include <drawpoint/tests/support/scenes.hpp>

/// The six rocks as bodies, for scenes.
namespace drawpoint::support {

/// One of the six rocks at a longest dimension [m].
inline engine::RockBody rock_body(int shape, double size, double density = 4500) {
  return engine::granular::RockLibrary(density).body({shape, size});
}

}  // namespace drawpoint::support
