// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>
#include <drawpoint/engine/contact/broad_phase.hpp>

namespace drawpoint::engine::contact::detail {
namespace {

// An FCL object that is nothing but its box: FCL would compute the box of a turned shape from its bounding
// sphere.
class BoxObject : public fcl::CollisionObjectd {
 public:
  BoxObject(const std::shared_ptr<fcl::CollisionGeometryd>& geometry, int id)
      : fcl::CollisionObjectd(geometry), id_(id) {}
  void set_box(const Eigen::AlignedBox3d& box) { aabb = fcl::AABBd(box.min(), box.max()); }
  int id() const { return id_; }

 private:
  int id_;
};

struct Entry {
  std::unique_ptr<BoxObject> object;
  bool moves = false, changed = false, changed_before = false, dirty = false;
};

bool collect(fcl::CollisionObjectd* first, fcl::CollisionObjectd* second, void* pairs) {
  const int a = static_cast<BoxObject*>(first)->id(), b = static_cast<BoxObject*>(second)->id();
  if (a != b)
    static_cast<std::vector<BroadPhase::Pair>*>(pairs)->emplace_back(std::min(a, b), std::max(a, b));
  return false;  // go on
}

// Above this share of changed boxes one sweep of the trees is cheaper than single look-ups.
constexpr int sweep_share = 4;

}  // namespace

class BroadPhase::Impl {
 public:
  fcl::DynamicAABBTreeCollisionManagerd& tree(bool moves) { return moves ? moving_ : fixed_; }
  Entry& at(int id) { return entries_[static_cast<std::size_t>(id)]; }

  void mark(int id) {
    Entry& entry = at(id);
    if (!entry.changed) changed_.push_back(id);
    entry.changed = true;
  }

  void add(int id, const Eigen::AlignedBox3d& box, bool moves) {
    if (static_cast<std::size_t>(id) >= entries_.size()) entries_.resize(static_cast<std::size_t>(id) + 1);
    Entry& entry = at(id);
    entry.object = std::make_unique<BoxObject>(geometry_, id);
    entry.object->set_box(box);
    entry.moves = moves;
    tree(moves).registerObject(entry.object.get());
    mark(id);
  }

  void remove(int id) {
    Entry& entry = at(id);
    tree(entry.moves).unregisterObject(entry.object.get());
    entry.object.reset();
    mark(id);
  }

  void set_box(int id, const Eigen::AlignedBox3d& box) {
    at(id).object->set_box(box);
    at(id).dirty = true;
    mark(id);
  }

  void set_moves(int id, bool moves) {
    Entry& entry = at(id);
    if (entry.moves == moves) return;
    tree(entry.moves).unregisterObject(entry.object.get());
    entry.moves = moves;
    entry.dirty = false;
    tree(moves).registerObject(entry.object.get());
    mark(id);
  }

  Changes update() {
    for (int id : before_) at(id).changed_before = false;
    before_.swap(changed_);
    changed_.clear();
    std::sort(before_.begin(), before_.end());
    moved_.clear();
    fixed_moved_.clear();
    for (int id : before_) {
      Entry& entry = at(id);
      entry.changed = false;
      entry.changed_before = true;
      if (entry.object && entry.dirty) (entry.moves ? moved_ : fixed_moved_).push_back(entry.object.get());
      entry.dirty = false;
    }
    refresh(moving_, moved_);
    refresh(fixed_, fixed_moved_);
    return look_up();
  }

  bool changed(int id) const { return entries_[static_cast<std::size_t>(id)].changed_before; }

 private:
  void refresh(fcl::DynamicAABBTreeCollisionManagerd& tree,
               const std::vector<fcl::CollisionObjectd*>& moved) {
    if (!moved.empty())
      tree.update(moved);
    else
      tree.setup();
  }

  Changes look_up() {
    pairs_.clear();
    if (before_.empty()) return {false, false, pairs_, 0};
    const bool everything = before_.size() * sweep_share > moving_.size() + fixed_.size();
    int look_ups = everything ? 2 : 0;
    if (everything) {
      moving_.collide(&pairs_, collect);
      if (moving_.size() > 0 && fixed_.size() > 0) moving_.collide(&fixed_, &pairs_, collect);
    } else {
      for (int id : before_) {
        Entry& entry = at(id);
        if (!entry.object) continue;
        ++look_ups;
        moving_.collide(entry.object.get(), &pairs_, collect);
        if (entry.moves) fixed_.collide(entry.object.get(), &pairs_, collect);
      }
    }
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    return {true, everything, pairs_, look_ups};
  }

  std::shared_ptr<fcl::CollisionGeometryd> geometry_ = std::make_shared<fcl::Sphered>(1.0);
  std::vector<Entry> entries_;
  fcl::DynamicAABBTreeCollisionManagerd moving_, fixed_;
  std::vector<int> changed_, before_;
  std::vector<fcl::CollisionObjectd*> moved_, fixed_moved_;
  std::vector<Pair> pairs_;
};

BroadPhase::BroadPhase() : impl_(std::make_unique<Impl>()) {}
BroadPhase::~BroadPhase() = default;
BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;

void BroadPhase::add(int id, const Eigen::AlignedBox3d& box, bool moves) { impl_->add(id, box, moves); }
void BroadPhase::remove(int id) { impl_->remove(id); }
void BroadPhase::set_box(int id, const Eigen::AlignedBox3d& box) { impl_->set_box(id, box); }
void BroadPhase::set_moves(int id, bool moves) { impl_->set_moves(id, moves); }
BroadPhase::Changes BroadPhase::update() { return impl_->update(); }
bool BroadPhase::changed(int id) const { return impl_->changed(id); }

}  // namespace drawpoint::engine::contact::detail
