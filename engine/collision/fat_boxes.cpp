// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/collision/fat_boxes.h>
#include <algorithm>

namespace drawpoint::engine::detail {
namespace {

using Eigen::AlignedBox3d;

AlignedBox3d grown(const AlignedBox3d& box, double by) {
  const Eigen::Vector3d growth = Eigen::Vector3d::Constant(by);
  return {box.min() - growth, box.max() + growth};
}

}  // namespace

AlignedBox3d FatBoxes::needed(const Items& items, int id) const {
  return grown(items.box(id), growth_ + items.speculative_margin[id]);
}

bool FatBoxes::has_left(Items& items, int id, const AlignedBox3d& last) const {
  Item& item = items.item[id];
  if (!item.hull) return true;
  if (items.motion_bound[id] - item.boxed_at <= slack_) return false;
  const AlignedBox3d box = needed(items, id);
  const double room = std::min((box.min() - last.min()).minCoeff(), (last.max() - box.max()).minCoeff());
  if (!(room > 0)) return true;
  item.boxed_at = items.motion_bound[id] + room - slack_;
  return false;
}

AlignedBox3d FatBoxes::first(Items& items, int id) const {
  items.item[id].boxed_at = items.motion_bound[id];
  return grown(needed(items, id), slack_);
}

AlignedBox3d FatBoxes::next(Items& items, int id, const AlignedBox3d& last) const {
  items.item[id].boxed_at = items.motion_bound[id];
  const AlignedBox3d box = needed(items, id);
  AlignedBox3d result = grown(box, slack_);
  if (!box.intersects(last)) return result;  // it was put elsewhere
  for (int i = 0; i < 3; ++i) {
    if (box.min()[i] < last.min()[i]) result.min()[i] -= slack_;
    if (box.max()[i] > last.max()[i]) result.max()[i] += slack_;
  }
  return result;
}

Plane FatBoxes::plane(const Items& items, int id) const {
  Plane plane = items.plane(id);
  plane.offset += growth_ + items.speculative_margin[id];
  return plane;
}

}  // namespace drawpoint::engine::detail
