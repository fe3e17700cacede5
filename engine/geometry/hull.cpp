// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/hull.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("engine::ConvexPolyhedron: " + what +
                              "; give at least four finite points that span a volume");
}

std::string too_flat(double extent) {
  std::ostringstream text;
  text << "the points are too flat or too nearly in one plane: widths and heights of faces must be at least "
       << constants::least_triple_height << " of the extent, here " << constants::least_triple_height * extent
       << " m";
  return text.str();
}

struct FacePlane {
  Vector3d normal;
  double offset;
};

std::vector<Vector3d> distinct(std::span<const Vector3d> points, double tolerance) {
  std::vector<Vector3d> result;
  for (const Vector3d& p : points) {
    const auto same = [&](const Vector3d& q) { return (p - q).norm() <= tolerance; };
    if (std::none_of(result.begin(), result.end(), same)) result.push_back(p);
  }
  return result;
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

// +1 or -1 when all points lie below the plane or its reverse, 0 when it cuts the set.
int side(const std::vector<Vector3d>& points, const FacePlane& plane, double tolerance) {
  bool above = false, below = false;
  for (const Vector3d& p : points) {
    const double distance = plane.normal.dot(p) - plane.offset;
    above = above || distance > tolerance;
    below = below || distance < -tolerance;
    if (above && below) return 0;
  }
  if (!above && !below) refuse("the points lie in one plane");
  return above ? -1 : 1;
}

// Planar hull (Andrew's monotone chain), counter-clockwise about the normal; collinear points are dropped.
std::vector<int> outline(const std::vector<Vector3d>& points, const std::vector<int>& members,
                         const Vector3d& normal, double tolerance) {
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<std::pair<Eigen::Vector2d, int>> flat;
  for (int m : members) flat.push_back({{u.dot(points[m]), v.dot(points[m])}, m});
  std::sort(flat.begin(), flat.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.x(), a.first.y()) < std::pair(b.first.x(), b.first.y());
  });
  const auto turns_left = [&](const auto& a, const auto& b, const auto& c) {
    const Eigen::Vector2d ab = b.first - a.first, ac = c.first - a.first;
    return ab.x() * ac.y() - ab.y() * ac.x() > tolerance * ac.norm();
  };
  std::vector<std::pair<Eigen::Vector2d, int>> chain;
  const auto grow = [&](const auto& point, std::size_t fixed) {
    while (chain.size() >= fixed + 2 && !turns_left(chain[chain.size() - 2], chain.back(), point))
      chain.pop_back();
    chain.push_back(point);
  };
  for (const auto& p : flat) grow(p, 0);
  const std::size_t lower = chain.size() - 1;
  for (auto p = flat.rbegin() + 1; p != flat.rend(); ++p) grow(*p, lower);
  chain.pop_back();
  std::vector<int> result;
  for (const auto& p : chain) result.push_back(p.second);
  return result;
}

// Every edge must be walked once each way, and Euler's formula must hold.
bool is_closed(const std::vector<std::vector<int>>& faces, std::size_t vertex_count) {
  std::set<std::pair<int, int>> edges;
  for (const auto& face : faces)
    for (std::size_t k = 0; k < face.size(); ++k)
      if (!edges.emplace(face[k], face[(k + 1) % face.size()]).second) return false;
  const bool paired = std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
    return edges.count({e.second, e.first}) == 1;
  });
  return paired && vertex_count + faces.size() == edges.size() / 2 + 2;
}

class Search {
 public:
  Search(std::vector<Vector3d> points, double extent)
      : points_(std::move(points)), extent_(extent), tolerance_(constants::hull_thickness * extent) {}

  Hull run() {
    const int n = static_cast<int>(points_.size());
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j)
        for (int k = j + 1; k < n; ++k) try_plane({i, j, k});
    return compact();
  }

 private:
  void try_plane(const std::array<int, 3>& t) {
    const Vector3d u = points_[t[1]] - points_[t[0]], v = points_[t[2]] - points_[t[0]], area = u.cross(v);
    const double longest = std::sqrt(std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()}));
    if (area.norm() < constants::least_triple_height * extent_ * longest || known(t)) return;
    FacePlane plane{area.normalized(), 0};
    plane.offset = plane.normal.dot(points_[t[0]]);
    const int outward = side(points_, plane, tolerance_);
    if (outward == 0) return;
    std::vector<int> members;
    std::vector<bool> mark(points_.size(), false);
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (std::abs(plane.normal.dot(points_[p]) - plane.offset) <= tolerance_) {
        members.push_back(static_cast<int>(p));
        mark[p] = true;
      }
    faces_.push_back(outline(points_, members, outward * plane.normal, tolerance_));
    marks_.push_back(std::move(mark));
  }

  bool known(const std::array<int, 3>& t) const {
    return std::any_of(marks_.begin(), marks_.end(),
                       [&](const auto& mark) { return mark[t[0]] && mark[t[1]] && mark[t[2]]; });
  }

  Hull compact() const {
    std::vector<int> index(points_.size(), -1);
    for (const auto& face : faces_)
      for (int v : face) index[v] = 0;
    Hull result;
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (index[p] == 0) {
        index[p] = static_cast<int>(result.vertices.size());
        result.vertices.push_back(points_[p]);
      }
    for (const auto& face : faces_) {
      result.faces.emplace_back();
      for (int v : face) result.faces.back().push_back(index[v]);
    }
    if (!is_closed(result.faces, result.vertices.size())) refuse(too_flat(extent_));
    return result;
  }

  std::vector<Vector3d> points_;
  double extent_, tolerance_;
  std::vector<std::vector<int>> faces_;
  std::vector<std::vector<bool>> marks_;
};

}  // namespace

Hull hull(std::span<const Vector3d> points) {
  const double extent = extent_of(points);
  auto kept = distinct(points, constants::hull_thickness * extent);
  if (kept.size() < 4) refuse("fewer than four of the points are distinct");
  return Search(std::move(kept), extent).run();
}

}  // namespace drawpoint::engine::detail
