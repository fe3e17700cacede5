// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <drawpoint/engine/base/constants.hpp>
#include <utility>

/// Nearest points of two line segments of positive length (Ericson 2005, Real-Time Collision
/// Detection, 5.1.9). Parallel segments give one of the nearest pairs.
namespace drawpoint::engine::detail {

struct Segment {
  Eigen::Vector3d start, end;
};

inline std::pair<Eigen::Vector3d, Eigen::Vector3d> nearest_points(const Segment& first,
                                                                  const Segment& second) {
  const Eigen::Vector3d d1 = first.end - first.start, d2 = second.end - second.start,
                        r = first.start - second.start;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r), c = d1.dot(r), b = d1.dot(d2);
  assert(a > 0 && e > 0 && "segments of positive length");
  const double determinant = a * e - b * b;  // vanishes for parallel segments
  double s = determinant > constants::parallel_edges * a * e
                 ? std::clamp((b * f - c * e) / determinant, 0.0, 1.0)
                 : 0.0;
  double t = (b * s + f) / e;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((b * t - c) / a, 0.0, 1.0);
  }
  return {first.start + s * d1, second.start + t * d2};
}

}  // namespace drawpoint::engine::detail
