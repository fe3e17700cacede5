// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/hull_extremes.h>
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <drawpoint/engine/base/constants.hpp>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "drawpoint/engine/geometry/hull_extremes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace drawpoint::engine::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// At most four lanes: hulls are padded to that.
using Lanes = hn::CappedTag<double, 4>;

Support lowest(const double* x, const double* y, const double* z, std::size_t count,
               const double* direction) {
  const Lanes d;
  const auto dx = hn::Set(d, direction[0]), dy = hn::Set(d, direction[1]), dz = hn::Set(d, direction[2]);
  const auto at = [&](std::size_t k) {
    return hn::Add(hn::Add(hn::Mul(dx, hn::LoadU(d, x + k)), hn::Mul(dy, hn::LoadU(d, y + k))),
                   hn::Mul(dz, hn::LoadU(d, z + k)));
  };
  auto least = at(0);
  auto index = hn::Iota(d, 0), where = index;
  const auto step = hn::Set(d, static_cast<double>(hn::Lanes(d)));
  for (std::size_t k = hn::Lanes(d); k < count; k += hn::Lanes(d)) {
    const auto here = at(k);
    where = hn::Add(where, step);
    const auto lower = hn::Lt(here, least);
    least = hn::IfThenElse(lower, here, least);
    index = hn::IfThenElse(lower, where, index);
  }
  const auto height = hn::MinOfLanes(d, least);
  const auto none = hn::Set(d, std::numeric_limits<double>::infinity());
  const auto first = hn::MinOfLanes(d, hn::IfThenElse(hn::Eq(least, height), index, none));
  return {hn::GetLane(height), static_cast<int>(hn::GetLane(first))};
}

// Bounds are single: hulls are padded to this.
using Singles = hn::CappedTag<float, CollisionHull::padding>;

// Appends the rows from `first` on whose bound is above the least; returns how many there are then.
template <class V>
int append_over(const V& most, const BoundQuery& q, std::size_t first, HullBound* found, int size) {
  const Singles d;
  const auto over = hn::And(hn::Gt(most, hn::Set(d, q.least)), hn::FirstN(d, q.count - first));
  if (hn::AllFalse(d, over)) return size;
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, over, bytes);
  std::uint64_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  float values[CollisionHull::padding];
  hn::StoreU(most, d, values);
  for (; bits; bits &= bits - 1) {
    const int lane = std::countr_zero(bits);
    found[size++] = {static_cast<int>(first) + lane, double(values[lane]) + double(q.ease)};
  }
  return size;
}

int faces_over(const BoundQuery& q, HullBound* found) {
  const Singles d;
  const auto x = hn::Set(d, q.points[0]), y = hn::Set(d, q.points[1]), z = hn::Set(d, q.points[2]);
  int size = 0;
  for (std::size_t k = 0; k < q.count; k += hn::Lanes(d)) {
    const auto column = [&](std::size_t c) { return hn::LoadU(d, q.columns + c * q.stride + k); };
    const auto along = hn::Add(hn::Add(hn::Mul(x, column(0)), hn::Mul(y, column(1))), hn::Mul(z, column(2)));
    size = append_over(hn::Sub(along, column(3)), q, k, found, size);
  }
  return size;
}

// The height over an edge is a cosine of the direction: it is largest at an end, or inside when it is positive
// and the point lies beyond both faces. There it is the distance from the edge, by its parts along and across
// the left face.
int edges_over(const BoundQuery& q, HullBound* found) {
  const Singles d;
  const auto inside = hn::Set(d, -q.ease);
  int size = 0;
  for (std::size_t k = 0; k < q.count; k += hn::Lanes(d)) {
    const auto column = [&](std::size_t c) { return hn::LoadU(d, q.columns + c * q.stride + k); };
    auto most = hn::Set(d, std::numeric_limits<float>::infinity());
    for (const float* p = q.points; p < q.points + 3 * q.points_count; p += 3) {
      const auto x = hn::Sub(hn::Set(d, p[0]), column(0)), y = hn::Sub(hn::Set(d, p[1]), column(1)),
                 z = hn::Sub(hn::Set(d, p[2]), column(2));
      const auto along = [&](std::size_t c) {
        return hn::Add(hn::Add(hn::Mul(x, column(c)), hn::Mul(y, column(c + 1))), hn::Mul(z, column(c + 2)));
      };
      const auto left = along(3), right = along(6), beyond_left = along(9), beyond_right = along(12);
      const auto end = hn::Max(left, right);
      const auto away = hn::Sqrt(hn::Add(hn::Mul(left, left), hn::Mul(beyond_left, beyond_left)));
      const auto beyond =
          hn::And(hn::Gt(end, inside), hn::And(hn::Gt(beyond_left, inside), hn::Gt(beyond_right, inside)));
      most = hn::Min(most, hn::IfThenElse(beyond, hn::Max(end, away), end));
    }
    size = append_over(most, q, k, found, size);
  }
  return size;
}

}  // namespace drawpoint::engine::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace drawpoint::engine::detail {
namespace {

HWY_EXPORT(lowest);
HWY_EXPORT(faces_over);
HWY_EXPORT(edges_over);

// Chosen once: asking Highway at every call would take longer than the loops.
struct Chosen {
  Chosen() {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    lowest = HWY_DYNAMIC_DISPATCH(lowest);
    faces_over = HWY_DYNAMIC_DISPATCH(faces_over);
    edges_over = HWY_DYNAMIC_DISPATCH(edges_over);
  }
  decltype(&HWY_STATIC_DISPATCH(lowest)) lowest;
  decltype(&HWY_STATIC_DISPATCH(faces_over)) faces_over;
  decltype(&HWY_STATIC_DISPATCH(edges_over)) edges_over;
};
// At the first call, which may come from another file's globals before main().
const Chosen& chosen() {
  static const Chosen once;
  return once;
}

}  // namespace

Support lowest(const CollisionHull& hull, const Eigen::Vector3d& direction) {
  return chosen().lowest(hull.x.data(), hull.y.data(), hull.z.data(), static_cast<std::size_t>(hull.x.size()),
                         direction.data());
}

namespace {

// `points`: what the query looks at, x, y, z of each; they are written here.
BoundQuery query_of(const Eigen::ArrayXXf& rows, std::size_t count, std::span<const Eigen::Vector3d> points,
                    float* singles) {
  BoundQuery query{rows.data(), static_cast<std::size_t>(rows.rows()), count, singles, points.size(), 0, 0};
  for (const Eigen::Vector3d& p : points)
    for (int i = 0; i < 3; ++i) *singles++ = static_cast<float>(p[i]);
  return query;
}

void set_limits(const CollisionHull& hull, std::span<const Eigen::Vector3d> points, double least,
                BoundQuery& query) {
  double farthest = 0;
  for (const Eigen::Vector3d& p : points) farthest = std::max(farthest, p.squaredNorm());
  const double ease = constants::single_round_off * (std::sqrt(farthest) + hull.reach);
  query.ease = static_cast<float>(ease);
  query.least = static_cast<float>(least - ease);
}

}  // namespace

int faces_over(const CollisionHull& hull, const Eigen::Vector3d& point, double least, HullBound* found) {
  float singles[3];
  const std::span<const Eigen::Vector3d> points(&point, 1);
  BoundQuery query = query_of(hull.face_planes, hull.normals.size(), points, singles);
  set_limits(hull, points, least, query);
  return chosen().faces_over(query, found);
}

int edges_over(const CollisionHull& hull, std::span<const Eigen::Vector3d> points, double least,
               HullBound* found) {
  assert(points.size() <= most_points && "no more points than there is room for");
  float singles[3 * most_points];
  BoundQuery query = query_of(hull.edge_frames, hull.edges.size(), points, singles);
  set_limits(hull, points, least, query);
  return chosen().edges_over(query, found);
}

}  // namespace drawpoint::engine::detail
#endif
