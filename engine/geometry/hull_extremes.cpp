// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/hull_extremes.h>
#include <cstddef>

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
    const auto height = at(k);
    where = hn::Add(where, step);
    const auto lower = hn::Lt(height, least);
    least = hn::IfThenElse(lower, height, least);
    index = hn::IfThenElse(lower, where, index);
  }
  double heights[4], indices[4];
  hn::StoreU(least, d, heights);
  hn::StoreU(index, d, indices);
  std::size_t best = 0;
  for (std::size_t k = 1; k < hn::Lanes(d); ++k)
    if (heights[k] < heights[best] || (heights[k] == heights[best] && indices[k] < indices[best])) best = k;
  return {heights[best], static_cast<int>(indices[best])};
}

void heights(const double* const* planes, std::size_t count, const double* point, double* result) {
  const Lanes d;
  const auto px = hn::Set(d, point[0]), py = hn::Set(d, point[1]), pz = hn::Set(d, point[2]);
  for (std::size_t k = 0; k < count; k += hn::Lanes(d)) {
    const auto along =
        hn::Add(hn::Add(hn::Mul(px, hn::LoadU(d, planes[0] + k)), hn::Mul(py, hn::LoadU(d, planes[1] + k))),
                hn::Mul(pz, hn::LoadU(d, planes[2] + k)));
    hn::StoreU(hn::Sub(along, hn::LoadU(d, planes[3] + k)), d, result + k);
  }
}

}  // namespace drawpoint::engine::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace drawpoint::engine::detail {
namespace {

HWY_EXPORT(lowest);
HWY_EXPORT(heights);

// Chosen once: asking Highway at every call would take longer than the loops.
struct Chosen {
  Chosen() {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    lowest = HWY_DYNAMIC_DISPATCH(lowest);
    heights = HWY_DYNAMIC_DISPATCH(heights);
  }
  decltype(&HWY_STATIC_DISPATCH(lowest)) lowest;
  decltype(&HWY_STATIC_DISPATCH(heights)) heights;
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

void heights(const CollisionHull& hull, const Eigen::Vector3d& point, double* result) {
  const double* planes[] = {hull.nx.data(), hull.ny.data(), hull.nz.data(), hull.no.data()};
  chosen().heights(planes, static_cast<std::size_t>(hull.nx.size()), point.data(), result);
}

}  // namespace drawpoint::engine::detail
#endif
