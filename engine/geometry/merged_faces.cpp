// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/merged_faces.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

std::uint64_t edge_key(int from, int to) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(from)) << 32 | static_cast<std::uint32_t>(to);
}

// The plane of facets, each of which counts by its area.
class MeanPlane {
 public:
  void add(const std::vector<Vector3d>& points, const std::vector<int>& facet) {
    const Vector3d area = twice_area(points, facet);
    Vector3d middle = Vector3d::Zero();
    for (int v : facet) middle += points[v] / static_cast<double>(facet.size());
    area_ += area;
    weight_ += area.norm();
    moment_ += area.norm() * middle;
    normal_ = area_.normalized();
    offset_ = weight_ > 0 ? normal_.dot(moment_ / weight_) : normal_.dot(middle);
  }
  double distance(const Vector3d& p) const { return std::abs(normal_.dot(p) - offset_); }

 private:
  Vector3d area_ = Vector3d::Zero(), moment_ = Vector3d::Zero(), normal_ = Vector3d::Zero();
  double weight_ = 0, offset_ = 0;
};

class Merger {
 public:
  Merger(const std::vector<Vector3d>& points, const FaceList& facets, double tolerance)
      : points_(points), facets_(facets), tolerance_(tolerance), group_(facets.size(), -1) {}

  FaceList run() {
    left_of_.reserve(4 * facets_.size());
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for_edges(facets_[f], [&](int from, int to) { left_of_[edge_key(from, to)] = static_cast<int>(f); });
    gather();
    count_groups();
    FaceList faces(members_.size());
    for (std::size_t g = 0; g < members_.size(); ++g)
      if (!outline(static_cast<int>(g), faces[g])) return {};
    return is_closed(faces) ? faces : FaceList{};
  }

 private:
  template <class Visit>
  static void for_edges(const std::vector<int>& face, const Visit& visit) {
    for (std::size_t k = 0; k < face.size(); ++k) visit(face[k], face[(k + 1) % face.size()]);
  }

  void gather() {
    std::vector<std::pair<double, int>> largest_first;
    for (std::size_t f = 0; f < facets_.size(); ++f)
      largest_first.emplace_back(-twice_area(points_, facets_[f]).norm(), static_cast<int>(f));
    std::sort(largest_first.begin(), largest_first.end());
    for (const auto& [area, facet] : largest_first)
      if (group_[facet] < 0) grow(facet);
  }

  // Again and again over the neighbours, as the plane of many facets is better known than that of one.
  void grow(int seed) {
    MeanPlane plane;
    std::vector<int>& members = members_.emplace_back();
    take(seed, plane, members);
    for (std::size_t before = 0; before < members.size() && tolerance_ > 0;) {
      before = members.size();
      for (std::size_t next = 0; next < members.size(); ++next)
        for_edges(facets_[members[next]], [&](int from, int to) {
          const int beyond = left_of_.at(edge_key(to, from));
          if (group_[beyond] < 0 && in_plane(beyond, plane)) take(beyond, plane, members);
        });
    }
  }

  void take(int facet, MeanPlane& plane, std::vector<int>& members) {
    group_[facet] = static_cast<int>(members_.size()) - 1;
    members.push_back(facet);
    plane.add(points_, facets_[facet]);
  }

  bool in_plane(int facet, const MeanPlane& plane) const {
    return std::all_of(facets_[facet].begin(), facets_[facet].end(),
                       [&](int v) { return plane.distance(points_[v]) <= tolerance_; });
  }

  void count_groups() {
    struct Seen {
      int groups = 0, first = -1, second = -1;
    };
    std::vector<Seen> seen(points_.size());
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for (int v : facets_[f]) {
        Seen& s = seen[v];
        if (group_[f] == s.first || group_[f] == s.second) continue;
        (s.groups == 0 ? s.first : s.second) = group_[f];  // from the third on their number does not count
        ++s.groups;
      }
    for (const Seen& s : seen) is_corner_.push_back(s.groups >= 3);
  }

  // The border of a group, which must be one loop, without the points that are no corners.
  bool outline(int group, std::vector<int>& face) const {
    std::unordered_map<int, int> next;
    bool simple = true;
    int first = -1;
    for (int facet : members_[group])
      for_edges(facets_[facet], [&](int from, int to) {
        if (group_[left_of_.at(edge_key(to, from))] == group) return;
        simple = simple && next.emplace(from, to).second;
        if (is_corner_[from] && (first < 0 || from < first)) first = from;
      });
    if (!simple || first < 0) return false;
    std::size_t walked = 0;
    for (int at = first; walked == 0 || at != first; at = next.at(at), ++walked) {
      if (walked > next.size()) return false;
      if (is_corner_[at]) face.push_back(at);
    }
    return walked == next.size() && face.size() >= 3;
  }

  // Every edge must be walked once each way, and Euler's formula must hold.
  static bool is_closed(const FaceList& faces) {
    std::vector<std::uint64_t> edges, back;
    for (const auto& face : faces)
      for_edges(face, [&](int from, int to) {
        edges.push_back(edge_key(from, to));
        back.push_back(edge_key(to, from));
      });
    std::sort(edges.begin(), edges.end());
    std::sort(back.begin(), back.end());
    const bool once = std::adjacent_find(edges.begin(), edges.end()) == edges.end();
    std::size_t vertices = edges.empty() ? 0 : 1;
    for (std::size_t k = 1; k < edges.size(); ++k) vertices += edges[k] >> 32 != edges[k - 1] >> 32;
    return once && edges == back && vertices + faces.size() == edges.size() / 2 + 2;
  }

  const std::vector<Vector3d>& points_;
  const FaceList& facets_;
  double tolerance_;
  std::unordered_map<std::uint64_t, int> left_of_;  // by edge
  std::vector<int> group_;                          // by facet
  FaceList members_;                                // facets by group
  std::vector<bool> is_corner_;                     // by point
};

}  // namespace

Vector3d twice_area(const std::vector<Vector3d>& points, const std::vector<int>& face) {
  Vector3d area = Vector3d::Zero();
  const Vector3d& origin = points[face[0]];
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    area += (points[face[k]] - origin).cross(points[face[k + 1]] - origin);
  return area;
}

FaceList merged_faces(const std::vector<Vector3d>& points, const FaceList& facets, double tolerance) {
  FaceList faces = Merger(points, facets, tolerance).run();
  std::vector<std::pair<std::vector<int>, std::vector<int>>> ordered;
  for (const auto& face : faces) {
    ordered.emplace_back(face, face);
    std::sort(ordered.back().first.begin(), ordered.back().first.end());
  }
  std::sort(ordered.begin(), ordered.end());
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = std::move(ordered[f].second);
  return faces;
}

}  // namespace drawpoint::engine::detail
