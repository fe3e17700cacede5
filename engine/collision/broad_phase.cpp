// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>

#include <drawpoint/engine/collision/broad_phase.h>
#include <drawpoint/engine/collision/pair_sorter.h>
#include <algorithm>
#include <drawpoint/engine/base/constants.hpp>
#include <functional>

namespace drawpoint::engine::detail {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

// Where one box in so many has changed, colliding the trees is cheaper than single look-ups.
constexpr int full_share = 3;
constexpr int most_trees = 8;           // a look-up asks each of them
constexpr int look_ups_per_block = 64;  // that a thread takes at a time

// An FCL object that is nothing but its box: FCL would compute the box of a turned shape from its bounding
// sphere.
class BoxObject : public fcl::CollisionObjectd {
 public:
  BoxObject(const std::shared_ptr<fcl::CollisionGeometryd>& geometry, int id)
      : fcl::CollisionObjectd(geometry), id_(id) {}
  void set_box(const AlignedBox3d& box) {
    const Vector3d growth = Vector3d::Constant(constants::box_growth);
    aabb = fcl::AABBd(box.min() - growth, box.max() + growth);
  }
  int id() const { return id_; }

 private:
  int id_;
};

using Tree = fcl::DynamicAABBTreeCollisionManagerd;
using Objects = std::vector<fcl::CollisionObjectd*>;

struct Entry {
  std::unique_ptr<BoxObject> object;  // none for a half-space
  bool plane = false, moves = false, changed = false, dirty = false;
};

struct Collector {
  const std::vector<AlignedBox3d>& boxes;
  std::vector<BroadPhase::Pair>& pairs;
};

bool collect(fcl::CollisionObjectd* first, fcl::CollisionObjectd* second, void* data) {
  Collector& collector = *static_cast<Collector*>(data);
  const int a = static_cast<BoxObject*>(first)->id(), b = static_cast<BoxObject*>(second)->id();
  if (a != b && collector.boxes[a].intersects(collector.boxes[b]))
    collector.pairs.emplace_back(std::min(a, b), std::max(a, b));
  return false;  // go on
}

bool reaches(const AlignedBox3d& box, const Plane& plane) {
  const Vector3d lowest = (plane.normal.array() > 0).select(box.min(), box.max());
  return plane.normal.dot(lowest) <= plane.offset;
}

}  // namespace

class BroadPhase::Impl {
 public:
  explicit Impl(int threads)
      : moving_(static_cast<std::size_t>(std::min(threads, most_trees))), moved_(moving_.size()) {
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) tree_pairs_.emplace_back(&moving_[i], &moving_[j]);
      tree_pairs_.emplace_back(&moving_[i], &fixed_);
    }
  }

  std::size_t share_of(int id) const { return static_cast<std::size_t>(id) % moving_.size(); }
  Tree& tree(int id, bool moves) { return moves ? moving_[share_of(id)] : fixed_; }
  Entry& at(int id) { return entries_[static_cast<std::size_t>(id)]; }

  void mark(int id) {
    Entry& entry = at(id);
    if (!entry.changed) changed_.push_back(id);
    entry.changed = true;
  }

  Entry& make(int id, bool moves) {
    const auto size = std::max(entries_.size(), static_cast<std::size_t>(id) + 1);
    entries_.resize(size);
    boxes_.resize(size);
    changed_before_.resize(size);
    planes_.resize(size);
    at(id).moves = moves;
    mark(id);
    return at(id);
  }

  void add(int id, const AlignedBox3d& box, bool moves) {
    Entry& entry = make(id, moves);
    entry.object = std::make_unique<BoxObject>(geometry_, id);
    entry.object->set_box(box);
    boxes_[id] = box;
    tree(id, moves).registerObject(entry.object.get());
  }

  void add(int id, const Plane& plane, bool moves) {
    make(id, moves).plane = true;
    planes_[id] = plane;
    plane_ids_.push_back(id);
  }

  void remove(int id) {
    Entry& entry = at(id);
    mark(id);
    if (entry.object) tree(id, entry.moves).unregisterObject(entry.object.get());
    entry.object.reset();
    entry.plane = false;
    std::erase(plane_ids_, id);
  }

  void set_box(int id, const AlignedBox3d& box) {
    boxes_[id] = box;
    at(id).object->set_box(box);
    at(id).dirty = true;
    mark(id);
  }

  void set_plane(int id, const Plane& plane) {
    planes_[id] = plane;
    mark(id);
  }

  Changes update(const ThreadPool& pool) {
    for (int id : before_) changed_before_[static_cast<std::size_t>(id)] = false;
    before_.swap(changed_);
    changed_.clear();
    std::sort(before_.begin(), before_.end());
    for (Objects& moved : moved_) moved.clear();
    fixed_moved_.clear();
    for (int id : before_) {
      Entry& entry = at(id);
      entry.changed = false;
      changed_before_[static_cast<std::size_t>(id)] = true;
      if (entry.object && entry.dirty)
        (entry.moves ? moved_[share_of(id)] : fixed_moved_).push_back(entry.object.get());
      entry.dirty = false;
    }
    pool.blocks(static_cast<int>(moving_.size()), 1, [this](int begin, int end) {
      for (int k = begin; k < end; ++k) refresh(moving_[k], moved_[k]);
    });
    refresh(fixed_, fixed_moved_);
    return look_up(pool);
  }

  const std::vector<char>& changed() const { return changed_before_; }
  const AlignedBox3d& box(int id) const { return boxes_[static_cast<std::size_t>(id)]; }
  const std::vector<int>& pending() const { return changed_; }

  void set_pending(const std::vector<int>& ids) {
    // The trees must take the boxes over all the same.
    update(ThreadPool(1));
    for (int id : ids) mark(id);
  }

 private:
  static void refresh(Tree& tree, const Objects& moved) {
    if (!moved.empty())
      tree.update(moved);
    else
      tree.setup();
  }

  void meet_plane(int plane, int box, std::vector<Pair>& pairs) const {
    const Entry& entry = entries_[static_cast<std::size_t>(box)];
    if (entry.object && (entry.moves || entries_[static_cast<std::size_t>(plane)].moves) &&
        reaches(boxes_[box], planes_[plane]))
      pairs.emplace_back(std::min(plane, box), std::max(plane, box));
  }

  void meet_all(int plane, std::vector<Pair>& pairs) const {
    for (std::size_t id = 0; id < entries_.size(); ++id) meet_plane(plane, static_cast<int>(id), pairs);
  }

  // FCL's trees do not change while they are asked.
  void collide_all(const ThreadPool& pool) {
    const std::size_t trees = tree_pairs_.size();
    collect_blocks(pool, trees + plane_ids_.size(), 1, [&](std::size_t k, std::vector<Pair>& found) {
      if (k < trees)
        collide(*tree_pairs_[k].first, *tree_pairs_[k].second, found);
      else
        meet_all(plane_ids_[k - trees], found);
    });
  }

  void collide(Tree& first, Tree& second, std::vector<Pair>& found) const {
    Collector collector{boxes_, found};
    if (&first == &second)
      first.collide(&collector, collect);
    else if (!first.empty() && !second.empty())
      first.collide(&second, &collector, collect);
  }

  void look_up_one(int id, std::vector<Pair>& pairs) const {
    const Entry& entry = entries_[static_cast<std::size_t>(id)];
    if (entry.plane) meet_all(id, pairs);
    if (!entry.object) return;
    Collector collector{boxes_, pairs};
    for (const Tree& tree : moving_) tree.collide(entry.object.get(), &collector, collect);
    if (entry.moves) fixed_.collide(entry.object.get(), &collector, collect);
    for (int plane : plane_ids_) meet_plane(plane, id, pairs);
  }

  void look_up_changed(const ThreadPool& pool) {
    collect_blocks(pool, before_.size(), look_ups_per_block,
                   [&](std::size_t k, std::vector<Pair>& found) { look_up_one(before_[k], found); });
  }

  // What `find(k, found)` adds for each k, block by block in their order.
  template <class Find>
  void collect_blocks(const ThreadPool& pool, std::size_t count, int block, const Find& find) {
    const std::size_t blocks = (count + block - 1) / block;
    if (found_.size() < blocks) found_.resize(blocks);
    for (std::size_t k = 0; k < blocks; ++k) found_[k].clear();
    const auto find_all = [&](int begin, int end) {
      for (int k = begin; k < end; ++k) find(static_cast<std::size_t>(k), found_[begin / block]);
    };
    pool.blocks(static_cast<int>(count), block, std::ref(find_all));  // by reference: no memory
    for (std::size_t k = 0; k < blocks; ++k) pairs_.insert(pairs_.end(), found_[k].begin(), found_[k].end());
  }

  Changes look_up(const ThreadPool& pool) {
    pairs_.clear();
    if (before_.empty()) return {false, false, pairs_};
    std::size_t size = fixed_.size();
    for (const Tree& tree : moving_) size += tree.size();
    const bool everything = before_.size() * full_share > size;
    if (everything)
      collide_all(pool);
    else
      look_up_changed(pool);
    sorter_.sort(pairs_, entries_.size());
    return {true, everything, pairs_};
  }

  std::shared_ptr<fcl::CollisionGeometryd> geometry_ = std::make_shared<fcl::Sphered>(1.0);
  std::vector<Entry> entries_;
  std::vector<AlignedBox3d> boxes_;
  std::vector<Plane> planes_;
  std::vector<int> plane_ids_;
  std::vector<Tree> moving_;  // each a thread's share, brought up to date side by side
  Tree fixed_;
  std::vector<std::pair<Tree*, Tree*>> tree_pairs_;  // of a tree with itself or another, that find all pairs
  std::vector<int> changed_, before_;
  std::vector<char> changed_before_;  // by number: it is in before_
  std::vector<Objects> moved_;
  Objects fixed_moved_;
  std::vector<Pair> pairs_;
  std::vector<std::vector<Pair>> found_;  // by block
  PairSorter sorter_;
};

BroadPhase::BroadPhase(int threads) : impl_(std::make_unique<Impl>(threads)) {}
BroadPhase::~BroadPhase() = default;
BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;

void BroadPhase::add(int id, const AlignedBox3d& box, bool moves) { impl_->add(id, box, moves); }
void BroadPhase::add(int id, const Plane& plane, bool moves) { impl_->add(id, plane, moves); }
void BroadPhase::remove(int id) { impl_->remove(id); }
void BroadPhase::set_box(int id, const AlignedBox3d& box) { impl_->set_box(id, box); }
void BroadPhase::set_plane(int id, const Plane& plane) { impl_->set_plane(id, plane); }
BroadPhase::Changes BroadPhase::update(const ThreadPool& pool) { return impl_->update(pool); }
const std::vector<char>& BroadPhase::changed() const { return impl_->changed(); }
const AlignedBox3d& BroadPhase::box(int id) const { return impl_->box(id); }
const std::vector<int>& BroadPhase::pending() const { return impl_->pending(); }
void BroadPhase::set_pending(const std::vector<int>& ids) { impl_->set_pending(ids); }

}  // namespace drawpoint::engine::detail
