// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What the search for contacts can be told.
namespace drawpoint::engine {

struct ContactFinderOptions {
  double margin =
      0.01;  ///< [m] ≥ 0; points with a gap up to this are reported: a fast rock's travel in a step
  double slack = 0.02;  ///< [m] ≥ 0; growth of the boxes of the broad phase, in addition to the margin
  double reuse_distance = 1e-3;  ///< [m] ≥ 0; relative motion below which a manifold is carried along
  double reuse_angle = 2e-3;     ///< [rad] ≥ 0; the same for rotation
  double hysteresis = 1e-4;  ///< [m] ≥ 0; last time's axis is kept while its overlap is the least within this
};

}  // namespace drawpoint::engine
