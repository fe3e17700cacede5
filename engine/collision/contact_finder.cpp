// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/collision/contact_finder.hpp>

#include <drawpoint/engine/collision/fat_boxes.h>
#include <drawpoint/engine/collision/finder_state.h>
#include <drawpoint/engine/collision/narrow_phase.h>
#include <drawpoint/engine/collision/swept_contact.h>
#include <chrono>
#include <cmath>
#include <drawpoint/engine/base/checks.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::engine {
namespace {

using detail::Placement;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int moves_per_block = 128, boxes_per_block = 64;  // that a thread takes at a time

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("engine::ContactFinder: " + what);
}

void check(const ContactFinderOptions& options) {
  const auto at_least_zero = [](const char* name, double value, const char* unit) {
    if (!(value >= 0) || !std::isfinite(value))
      refuse(std::string(name) + " is " + std::to_string(value) + " " + unit +
             "; give a finite value of at least 0");
  };
  at_least_zero("margin", options.margin, "m");
  at_least_zero("slack", options.slack, "m");
  at_least_zero("reuse_distance", options.reuse_distance, "m");
  at_least_zero("reuse_angle", options.reuse_angle, "rad");
  at_least_zero("hysteresis", options.hysteresis, "m");
}

void check(int collider, const Isometry3d& pose) {
  const Vector3d p = pose.translation();
  const double off = detail::off_orthonormal(pose.linear());
  if (p.allFinite() && off < detail::orthonormal.value) return;
  const std::string fault = p.allFinite() ? "axes that are off orthonormal by " + detail::text(off) +
                                                "; allowed: " + detail::orthonormal.text
                                          : "translation " + detail::text(p) + " m, which is not finite";
  refuse("the pose of collider " + std::to_string(collider) + " has " + fault + "; give a rigid motion");
}

void check_speculative_margin(int collider, double distance) {
  if (!(distance >= 0) || !std::isfinite(distance))
    refuse("the speculative margin of collider " + std::to_string(collider) + " is " +
           std::to_string(distance) + " m; give a finite value of at least 0");
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

class ContactFinder::Impl {
 public:
  Impl(const ContactFinderOptions& options, std::shared_ptr<const ThreadPool> pool)
      : options_((check(options), options)),
        fat_(0.5 * (options.margin + options.reuse_distance), options.slack),
        pool_(pool ? std::move(pool) : std::make_shared<const ThreadPool>(1)),
        boxes_(pool_->threads()),
        fcl_(options.narrow),
        narrow_(options, pool_->threads(), fcl_),
        swept_(static_cast<std::size_t>(pool_->threads())) {}

  int add(const Collider& collider, const Isometry3d& X_WB) {
    const int id = items_.size();
    check(id, X_WB);
    items_.add(hulls_.make_item(collider), X_WB);
    fcl_.add(id, items_.item[id].hull.get());
    if (items_.item[id].hull)
      boxes_.add(id, fat_.first(items_, id), collider.moves);
    else
      boxes_.add(id, fat_.plane(items_, id), collider.moves);
    return id;
  }

  void remove(int id) {
    require(id);
    boxes_.remove(id);
    items_.remove(id);
    fcl_.remove(id);
  }

  const Collider& collider(int id) const {
    require(id);
    return items_.item[id].collider;
  }

  void set_pose(int id, const Isometry3d& X_WB) {
    require(id);
    check(id, X_WB);
    items_.place(id, X_WB);
    check_box(id);
  }

  Isometry3d shape_pose(int id) const {
    require(id);
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() = items_.placed[id].R;
    pose.translation() = items_.placed[id].p;
    return pose;
  }

  void set_speculative_margin(int id, double reach) {
    require(id);
    check_speculative_margin(id, reach);
    items_.extend(id, reach);
    check_box(id);
  }

  void move(std::span<const ColliderMove> moves) {
    const ThreadPool::Region region(*pool_);
    const int count = static_cast<int>(moves.size());
    leaves_.resize(moves.size());
    pool_->blocks(count, moves_per_block, [&](int begin, int end) {
      for (const ColliderMove& move : moves.subspan(begin, end - begin)) {
        require(move.collider);
        check(move.collider, move.X_WB);
        check_speculative_margin(move.collider, move.speculative_margin);
      }
    });
    pool_->blocks(count, moves_per_block, [&](int begin, int end) {
      for (const ColliderMove& move : moves.subspan(begin, end - begin)) {
        items_.place(move.collider, move.X_WB);
        items_.extend(move.collider, move.speculative_margin);
      }
      for (int k = begin; k < end; ++k) leaves_[k] = leaves_box(moves[k].collider);
    });
    for (int k = 0; k < count; ++k)
      if (leaves_[k]) renew_box(moves[k].collider);
  }

  const std::vector<Manifold>& find() {
    const ThreadPool::Region region(*pool_);
    times_ = {};
    const auto start = std::chrono::steady_clock::now();
    broad_phase();
    times_.broad = seconds_since(start);
    const auto middle = std::chrono::steady_clock::now();
    times_.computed = narrow_.run(items_, pairs_, manifolds_, *pool_);
    times_.refused = narrow_.refused();
    times_.narrow = seconds_since(middle);
    return manifolds_;
  }

  void forget() {
    pairs_.forget();
    for (int id = 0; id < items_.size(); ++id) {
      items_.motion_bound[id] = 0;
      if (items_.item[id].hull) boxes_.set_box(id, fat_.first(items_, id));
    }
  }

  bool first_touch(const Manifold& m, const RigidMotion& a, const RigidMotion& b, double h, int thread,
                   FirstTouch& touch) {
    touch.manifold = m;
    const RigidMotion shape_a = of_shape(m.collider_a, a), shape_b = of_shape(m.collider_b, b);
    return swept_[static_cast<std::size_t>(thread)].find(
        {items_.placed[m.collider_a], shape_a, items_.item[m.collider_a].cylinder},
        {items_.placed[m.collider_b], shape_b, items_.item[m.collider_b].cylinder}, h,
        pairs_.held(m.slot).contact.feature, touch);
  }

  bool meets_face(const Manifold& m, const RigidMotion& a, const RigidMotion& b, double h, int point,
                  const Vector3d& shift) const {
    return detail::meets_face(m, {items_.placed[m.collider_a], a}, {items_.placed[m.collider_b], b}, h,
                              pairs_.held(m.slot).contact, point, shift);
  }

  // A cylinder that turns about its axis stays where it is.
  RigidMotion of_shape(int id, const RigidMotion& body) const {
    if (!items_.item[id].cylinder) return body;
    const Placement& placed = items_.placed[id];
    const Vector3d axis = placed.R.col(1), &w = body.angular_velocity;
    return {placed.centre, body.at(placed.centre), w - axis.dot(w) * axis, body.acceleration};
  }

  bool with_half_space(const Manifold& m) const {
    return !items_.placed[m.collider_a].hull || !items_.placed[m.collider_b].hull;
  }

  int slots() const { return pairs_.slots(); }

  int slot_of(int a, int b) const {
    const bool known =
        a >= 0 && a < b && b < items_.size() && items_.traits[a].alive && items_.traits[b].alive;
    return known ? pairs_.slot_of({a, b}) : -1;
  }

  std::vector<std::byte> save() const { return detail::save_state({options_, items_, boxes_, pairs_}); }

  void restore(std::span<const std::byte> bytes) {
    const detail::FinderState state = detail::read_state({options_, items_, boxes_, pairs_}, bytes);
    dirty_.clear();
    for (int id = 0; id < items_.size(); ++id) {
      if (!items_.traits[id].alive) continue;
      const auto& saved = state.colliders[id];
      items_.placed[id].R = saved.R, items_.placed[id].p = saved.p, items_.placed[id].centre = saved.centre;
      items_.motion_bound[id] = saved.motion_bound;
      items_.speculative_margin[id] = saved.speculative_margin;
      items_.item[id].boxed_at = saved.boxed_at;
      items_.item[id].dirty = saved.dirty;
      if (saved.dirty) dirty_.push_back(id);
      if (items_.item[id].hull)
        boxes_.set_box(id, saved.box);
      else
        boxes_.set_plane(id, fat_.plane(items_, id));
    }
    boxes_.set_pending(state.pending);
    pairs_.assign(state.entries, state.near, state.held);
  }

  const FinderTimes& times() const { return times_; }

 private:
  void require(int id) const {
    if (id < 0 || id >= items_.size() || !items_.traits[id].alive)
      refuse("there is no collider " + std::to_string(id) +
             "; use a number that add() gave and remove() has not taken");
  }

  bool leaves_box(int id) { return !items_.item[id].dirty && fat_.has_left(items_, id, boxes_.box(id)); }

  void check_box(int id) {
    if (leaves_box(id)) renew_box(id);
  }

  void renew_box(int id) {
    items_.item[id].dirty = true;
    dirty_.push_back(id);
  }

  void broad_phase() {
    new_boxes_.resize(dirty_.size());
    pool_->blocks(static_cast<int>(dirty_.size()), boxes_per_block, [&](int begin, int end) {
      for (int k = begin; k < end; ++k)
        if (items_.item[dirty_[k]].hull) new_boxes_[k] = fat_.next(items_, dirty_[k], boxes_.box(dirty_[k]));
    });
    for (std::size_t k = 0; k < dirty_.size(); ++k) {
      const int id = dirty_[k];
      if (!items_.traits[id].alive) continue;
      items_.item[id].dirty = false;
      if (items_.item[id].hull) {
        boxes_.set_box(id, new_boxes_[k]);
      } else {
        boxes_.set_plane(id, fat_.plane(items_, id));
        pairs_.forget(id);
      }
    }
    dirty_.clear();
    const auto changes = boxes_.update(*pool_);
    if (changes.any) pairs_.update(boxes_, changes, [this](int a, int b) { return items_.may_touch(a, b); });
    times_.pairs = static_cast<int>(pairs_.entries().size());
  }

  ContactFinderOptions options_;
  detail::FatBoxes fat_;
  detail::Items items_;
  detail::HullLibrary hulls_;
  std::shared_ptr<const ThreadPool> pool_;
  detail::BroadPhase boxes_;
  detail::PairCache pairs_;
  detail::FclAxes fcl_;
  detail::NarrowPhase narrow_;
  std::vector<detail::SweptContact> swept_;     // by thread
  std::vector<char> leaves_;                    // by move: leaves its box
  std::vector<int> dirty_;                      // have left their boxes, or are half-spaces that were moved
  std::vector<Eigen::AlignedBox3d> new_boxes_;  // theirs
  std::vector<Manifold> manifolds_;
  FinderTimes times_;
};

ContactFinder::ContactFinder(const ContactFinderOptions& options, std::shared_ptr<const ThreadPool> pool)
    : impl_(std::make_unique<Impl>(options, std::move(pool))) {}
ContactFinder::~ContactFinder() = default;
ContactFinder::ContactFinder(ContactFinder&&) noexcept = default;
ContactFinder& ContactFinder::operator=(ContactFinder&&) noexcept = default;

int ContactFinder::add(const Collider& collider, const Isometry3d& X_WB) {
  return impl_->add(collider, X_WB);
}
void ContactFinder::remove(int collider) { impl_->remove(collider); }
const Collider& ContactFinder::collider(int collider) const { return impl_->collider(collider); }
void ContactFinder::set_pose(int collider, const Isometry3d& X_WB) { impl_->set_pose(collider, X_WB); }
Isometry3d ContactFinder::shape_pose(int collider) const { return impl_->shape_pose(collider); }
void ContactFinder::set_speculative_margin(int collider, double reach) {
  impl_->set_speculative_margin(collider, reach);
}
void ContactFinder::move(std::span<const ColliderMove> moves) { impl_->move(moves); }
const std::vector<Manifold>& ContactFinder::find() { return impl_->find(); }
const FinderTimes& ContactFinder::times() const { return impl_->times(); }
bool ContactFinder::first_touch(const Manifold& manifold, const RigidMotion& a, const RigidMotion& b,
                                double h, int thread, FirstTouch& touch) const {
  return impl_->first_touch(manifold, a, b, h, thread, touch);
}
bool ContactFinder::meets_face(const Manifold& manifold, const RigidMotion& a, const RigidMotion& b, double h,
                               int point, const Vector3d& shift) const {
  return impl_->meets_face(manifold, a, b, h, point, shift);
}
bool ContactFinder::with_half_space(const Manifold& manifold) const {
  return impl_->with_half_space(manifold);
}
int ContactFinder::slots() const { return impl_->slots(); }
int ContactFinder::slot_of(int collider_a, int collider_b) const {
  return impl_->slot_of(collider_a, collider_b);
}
void ContactFinder::forget() { impl_->forget(); }
std::vector<std::byte> ContactFinder::save() const { return impl_->save(); }
void ContactFinder::restore(std::span<const std::byte> bytes) { impl_->restore(bytes); }

}  // namespace drawpoint::engine
