// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/hull.h>

#include <drawpoint/engine/geometry/merged_faces.h>
#include <drawpoint/engine/geometry/qhull_facets.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <drawpoint/engine/base/constants.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

constexpr double flat_share = 1e-3;  // of the least width, that the tolerance is at most
constexpr int most_tries = 6;

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("engine::ConvexPolyhedron: " + what +
                              "; give at least four finite points that span a volume");
}

std::string too_flat(double width, double extent) {
  std::ostringstream text;
  text << "the points lie in one plane or nearly so: their least width is " << width
       << " m; allowed: at least " << constants::least_hull_width << " of the extent, here "
       << constants::least_hull_width * extent << " m";
  return text.str();
}

double extent_of(std::span<const Vector3d> points) {
  if (points.size() < 4) refuse(std::to_string(points.size()) + " points span no volume");
  Eigen::AlignedBox3d bounds;
  for (const Vector3d& p : points) {
    if (!p.allFinite()) refuse("a point has a coordinate that is not finite");
    bounds.extend(p);
  }
  return bounds.diagonal().norm();
}

// The first of those that are nearer to each other than `apart`, by cells of that size.
std::vector<Vector3d> distinct(std::span<const Vector3d> points, double apart) {
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;
  const auto key = [](const std::array<std::int64_t, 3>& cell) {
    std::uint64_t hash = 0;
    for (std::int64_t k : cell) hash = (hash ^ static_cast<std::uint64_t>(k)) * 0x9E3779B97F4A7C15u;
    return hash;
  };
  std::vector<Vector3d> kept;
  for (const Vector3d& p : points) {
    std::array<std::int64_t, 3> cell, near;
    for (int k = 0; k < 3; ++k) cell[k] = std::llround((p[k] - points[0][k]) / apart);
    const auto taken = [&](int shift) {
      for (int k = 0; k < 3; ++k) near[k] = cell[k] + shift % 3 - 1, shift /= 3;
      const auto found = cells.find(key(near));
      return found != cells.end() &&
             std::any_of(found->second.begin(), found->second.end(),
                         [&](std::size_t other) { return (kept[other] - p).norm() < apart; });
    };
    bool known = false;
    for (int shift = 0; shift < 27 && !known; ++shift) known = taken(shift);
    if (known) continue;
    cells[key(cell)].push_back(kept.size());
    kept.push_back(p);
  }
  return kept;
}

FaceList facets_of(const std::vector<Vector3d>& points) {
  if (points.size() < 4) refuse("fewer than four of the points are distinct");
  try {
    return qhull_facets(points);
  } catch (const std::invalid_argument& error) {
    refuse(std::string("the points lie in one plane (Qhull: ") + error.what() + ")");
  }
}

// Along the axis in which the points spread least.
double width_of(std::span<const Vector3d> points) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points) middle += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : points) spread += (p - middle) * (p - middle).transpose();
  const Vector3d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  double low = 0, high = 0;
  for (const Vector3d& p : points) {
    low = std::min(low, axis.dot(p - middle));
    high = std::max(high, axis.dot(p - middle));
  }
  return high - low;
}

// Vertices that faces have, in the order of the points.
Hull compact(const std::vector<Vector3d>& points, FaceList faces) {
  std::vector<int> index(points.size(), -1);
  for (const auto& face : faces)
    for (int v : face) index[v] = 0;
  Hull result;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (index[p] == 0) {
      index[p] = static_cast<int>(result.vertices.size());
      result.vertices.push_back(points[p]);
    }
  for (auto& face : faces)
    for (int& v : face) v = index[v];
  result.faces = std::move(faces);
  return result;
}

}  // namespace

Hull hull(std::span<const Vector3d> points) {
  const double extent = extent_of(points);
  const double width = width_of(points);
  if (!(width >= constants::least_hull_width * extent)) refuse(too_flat(width, extent));
  double tolerance = std::min(constants::hull_thickness * extent, flat_share * width);
  const std::vector<Vector3d> kept = distinct(points, tolerance);
  const FaceList facets = facets_of(kept);
  for (int k = 0; k <= most_tries; ++k, tolerance *= 0.1)
    if (FaceList faces = merged_faces(kept, facets, k < most_tries ? tolerance : 0); !faces.empty())
      return compact(kept, std::move(faces));
  refuse("the points are too flat: their hull does not close (extent " + std::to_string(extent) + " m)");
}

}  // namespace drawpoint::engine::detail
