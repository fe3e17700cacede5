// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/base/prefetch.h>
#include <drawpoint/engine/collision/narrow_phase.h>
#include <drawpoint/engine/geometry/hull_extremes.h>
#include <drawpoint/engine/geometry/round_contact.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Pairs a block: some 20 µs of work, large against the hand-over of a block and small against a step.
constexpr int block_size = 128;

// Writes manifolds over those of the step before: to make them anew costs as much as to fill them.
class Manifolds {
 public:
  explicit Manifolds(std::vector<Manifold>& all) : all_(all) {}
  ~Manifolds() { all_.resize(count_); }
  Manifolds(const Manifolds&) = delete;
  Manifolds& operator=(const Manifolds&) = delete;

  Manifold& add() {
    if (count_ == all_.size()) all_.emplace_back();
    return all_[count_++];
  }
  void take_back() { --count_; }

 private:
  std::vector<Manifold>& all_;
  std::size_t count_ = 0;
};

// How the smaller shape of a pair stands in the frame of the larger.
struct Stand {
  Stand(const Placement& a, const Placement& b)
      : a_smaller(a.hull->radius < b.hull->radius), small(a_smaller ? a : b), large(a_smaller ? b : a) {}
  Vector3d centre() const { return large.R.transpose() * (small.centre - large.p); }
  Matrix3d orientation() const { return large.R.transpose() * small.R; }
  double radius() const { return small.hull->radius; }

  bool a_smaller;
  const Placement &small, &large;
};

void start_manifold(const Items& items, const PairEntry& entry, int slot, const Vector3d& normal,
                    Manifold& manifold) {
  const Traits &a = items.traits[entry.a], &b = items.traits[entry.b];
  manifold.collider_a = entry.a, manifold.collider_b = entry.b;
  manifold.body_a = a.body, manifold.body_b = b.body;
  manifold.slot = slot;
  manifold.normal = normal;
  manifold.radius = 1 / (a.inverse_radius + b.inverse_radius);
  manifold.count = 0;
}

}  // namespace

// One thread's part: buffers only, nothing that one pair leaves behind for another.
struct NarrowPhase::Worker {
  Worker(const ContactFinderOptions& o, const FclAxes& f) : options(o), fcl(f) {}

  // Brings the pairs [first, last) up to date and replaces `found` by their manifolds.
  void process(const Items& items, PairCache& pairs, int first, int last, std::vector<Manifold>& found) {
    Manifolds manifolds(found);
    for (; first < last; first += block_size)
      process_block(items, pairs, first, std::min(last, first + block_size), manifolds);
  }

  // First the pairs are listed that have moved, then those that touch: a list is gone through without a guess
  // at what the next pair is, and what lies ahead on it is prefetched.
  void process_block(const Items& items, PairCache& pairs, int first, int last, Manifolds& manifolds) {
    PairEntry* const entries = pairs.entries().data();
    moved.list(first, last, [&](int k) { return motion_of(items, entries[k]) > entries[k].limit; });
    for (int i = 0; i < moved.size; ++i) {
      prefetch_moved(items, pairs, i);
      PairEntry& entry = entries[moved.pairs[i]];
      if (with_plane(items, entry))
        entry.limit = PairEntry::at_once;  // nothing is remembered of a plane
      else
        refresh(items, entry, pairs);
    }
    touching.list(first, last, [&](int k) {  // without a branch, as lists are made
      return static_cast<bool>((entries[k].count > 0) | (entries[k].limit == PairEntry::at_once));
    });
    for (int i = 0; i < touching.size; ++i) {
      prefetch_touching(items, pairs, i);
      PairEntry& entry = entries[touching.pairs[i]];
      if (entry.count > 0)
        carry_along(items, entry, pairs, manifolds);
      else
        touch_plane(items, entry, pairs, manifolds);
    }
  }

  // What the pairs after this one need: where they are and what is remembered of them, then their hulls, which
  // the former name.
  [[gnu::always_inline]] void prefetch_moved(const Items& items, const PairCache& pairs, int i) const {
    constexpr int first = 3, second = 1;  // pairs ahead
    const PairEntry* const entries = pairs.entries().data();
    if (i + first < moved.size) {
      const PairEntry& soon = entries[moved.pairs[i + first]];
      prefetch(&items.placed[soon.b], sizeof(Placement));
      prefetch(&pairs.near(soon), sizeof(NearState));
    }
    if (i + second < moved.size) {
      const PairEntry& next = entries[moved.pairs[i + second]];
      if (const int held = pairs.near(next).held; held >= 0) prefetch(&pairs.held(held), sizeof(PairState));
      const CollisionHull* hull = items.placed[next.b].hull;
      if (!hull) return;
      for (const auto* numbers : {&hull->x, &hull->y, &hull->z})
        prefetch(numbers->data(), static_cast<std::size_t>(numbers->size()) * sizeof(double));
      prefetch(hull->face_planes.data(), static_cast<std::size_t>(hull->face_planes.size()) * sizeof(float));
    }
  }

  [[gnu::always_inline]] void prefetch_touching(const Items& items, const PairCache& pairs, int i) const {
    constexpr int first = 8, second = 4;  // pairs ahead
    const std::vector<PairEntry>& entries = pairs.entries();
    if (i + first < touching.size)
      prefetch(&pairs.near(entries[touching.pairs[i + first]]), sizeof(NearState));
    if (i + second >= touching.size) return;
    const PairEntry& soon = entries[touching.pairs[i + second]];
    prefetch(&items.placed[soon.b], sizeof(Placement));
    if (const int held = pairs.near(soon).held; held >= 0)
      prefetch(&pairs.held(held).contact,
               offsetof(ConvexContact, points) + static_cast<std::size_t>(soon.count) * sizeof(Anchors));
  }

  static double motion_of(const Items& items, const PairEntry& entry) {
    return items.motion_bound[entry.a] + items.motion_bound[entry.b];
  }
  static bool with_plane(const Items& items, const PairEntry& entry) {
    return !items.placed[entry.a].hull || !items.placed[entry.b].hull;
  }

  // How near the shapes of a pair must come to be reported.
  double margin_of(const Items& items, const PairEntry& entry) const {
    return options.margin + items.speculative_margin[entry.a] + items.speculative_margin[entry.b];
  }

  void refresh(const Items& items, PairEntry& entry, PairCache& pairs) {
    const Placement &a = items.placed[entry.a], &b = items.placed[entry.b];
    const double motion_bound = motion_of(items, entry);
    margin = margin_of(items, entry);
    const bool known = entry.limit != PairEntry::at_once;
    NearState& near = pairs.near(entry);
    if (known && entry.count > 0 && still_stands(a, b, motion_bound, entry, pairs.held(near.held))) return;
    if (known && entry.count == 0 && still_apart(a, b, motion_bound, entry, near)) return;
    compute(items, motion_bound, entry, near, pairs);
  }

  // The plane on A that separated the shapes last time.
  bool still_apart(const Placement& a, const Placement& b, double motion_bound, PairEntry& entry,
                   const NearState& plane) const {
    const Vector3d normal = a.R * plane.normal;
    const double least = lowest(*b.hull, b.R.transpose() * normal).height + normal.dot(b.p - a.p);
    const double separation = least - plane.support;
    if (!(separation > margin + options.reuse_distance)) return false;
    entry.limit = motion_bound + (separation - margin);
    return true;
  }

  bool still_stands(const Placement& a, const Placement& b, double motion_bound, PairEntry& entry,
                    const PairState& state) const {
    if (margin > state.margin) return false;
    const Stand now(a, b);
    const double distance = (now.centre() - state.centre).norm();
    if (distance > options.reuse_distance) return false;
    // ‖ΔR‖_F/√2 is the largest displacement of a unit vector, 2 sin(θ/2).
    const double turn = (now.orientation() - state.orientation).norm() / std::numbers::sqrt2;
    if (turn > options.reuse_angle) return false;
    entry.limit = motion_bound +
                  std::min(options.reuse_distance - distance, (options.reuse_angle - turn) * now.radius());
    return true;
  }

  void compute(const Items& items, double motion_bound, PairEntry& entry, NearState& near, PairCache& pairs) {
    const Placement &a = items.placed[entry.a], &b = items.placed[entry.b];
    ++computed;
    const HullPair pair{*a.hull, *b.hull, pose_against(a, b)};
    fresh.normal = near.normal, fresh.count = 0;  // where to look first
    ConvexContact& contact = near.held < 0 ? fresh : pairs.held(near.held).contact;
    const AxisQuery query{margin + options.reuse_distance, options.hysteresis, near.feature, margin};
    if (!fcl.on())
      convex.find(pair, query, contact);
    else if (!find_by_fcl(fcl, entry.a, entry.b, pair, query, convex, contact))
      ++refused;
    round_off(items.item[entry.a].cylinder, items.item[entry.b].cylinder, pair, query.margin, contact);
    entry.count = contact.count;
    near.feature = contact.feature;
    if (entry.count == 0) {
      near.normal = contact.normal, near.support = contact.support;
      entry.limit = motion_bound + (contact.separation - margin);
      pairs.let_go(near);
      return;
    }
    const bool first = near.held < 0;
    PairState& state = pairs.hold(near);
    if (first) state.contact = fresh;
    const Stand now(a, b);
    state.centre = now.centre(), state.margin = margin;
    state.orientation = pair.X_AB.linear();
    if (now.a_smaller) state.orientation.transposeInPlace();
    entry.limit = motion_bound + std::min(options.reuse_distance, options.reuse_angle * now.radius());
  }

  // The remembered contact at the present poses.
  void carry_along(const Items& items, const PairEntry& entry, const PairCache& pairs,
                   Manifolds& manifolds) const {
    const int held = pairs.near(entry).held;
    const ConvexContact& contact = pairs.held(held).contact;
    const Placement &a = items.placed[entry.a], &b = items.placed[entry.b];
    const double reported = margin_of(items, entry);
    Manifold& manifold = manifolds.add();
    start_manifold(items, entry, held, (contact.normal_of_b ? b : a).R * contact.normal, manifold);
    for (int k = 0; k < contact.count; ++k) {
      const Anchors& anchors = contact.points[static_cast<std::size_t>(k)];
      const Vector3d on_a = a.at(anchors.on_a), on_b = b.at(anchors.on_b);
      const double gap = manifold.normal.dot(on_b - on_a);
      if (gap <= reported)
        manifold.points[static_cast<std::size_t>(manifold.count++)] = {0.5 * (on_a + on_b), gap,
                                                                       anchors.feature};
    }
    if (manifold.count == 0) manifolds.take_back();
  }

  // Half-spaces have closed forms; remembered is how long nothing can happen, and which points touched.
  void touch_plane(const Items& items, PairEntry& entry, PairCache& pairs, Manifolds& manifolds) {
    const bool first = !items.placed[entry.a].hull;
    const int plane_id = first ? entry.a : entry.b, shape_id = first ? entry.b : entry.a;
    const Placement& shape = items.placed[shape_id];
    // The motion bound of a half-space stands still: a moved one makes the pair new.
    const double motion_bound = motion_of(items, entry);
    const Plane plane = items.plane(plane_id);
    const double height = plane.normal.dot(shape.centre) - plane.offset - shape.hull->radius;
    margin = margin_of(items, entry);
    entry.limit = height > margin ? motion_bound + (height - margin) : PairEntry::at_once;
    if (height > margin) return;
    Eigen::Isometry3d X_WC;
    X_WC.linear() = shape.R, X_WC.translation() = shape.p, X_WC.makeAffine();
    NearState& near = pairs.near(entry);
    const KeptPoints kept =
        near.held < 0 ? KeptPoints{.within = options.hysteresis} : kept_points(pairs.held(near.held).contact);
    if (const Cylinder* cylinder = items.item[shape_id].cylinder)
      plane_contact(plane, *cylinder, X_WC, margin, kept, clip);
    else
      plane_contact(plane, *shape.hull, X_WC, margin, kept, clip);
    if (clip.empty()) return pairs.let_go(near);
    ConvexContact& last = pairs.hold(near).contact;
    last.count = static_cast<int>(clip.size());
    for (std::size_t k = 0; k < clip.size(); ++k) last.points[k].feature = clip[k].feature;
    Manifold& manifold = manifolds.add();
    start_manifold(items, entry, near.held, first ? plane.normal : Vector3d(-plane.normal), manifold);
    for (const ClipPoint& p : clip)
      manifold.points[static_cast<std::size_t>(manifold.count++)] = {p.position - 0.5 * p.gap * plane.normal,
                                                                     p.gap, p.feature};
  }

  KeptPoints kept_points(const ConvexContact& last) const {
    KeptPoints kept{.count = last.count, .within = options.hysteresis};
    for (int k = 0; k < last.count; ++k)
      kept.features[static_cast<std::size_t>(k)] = last.points[static_cast<std::size_t>(k)].feature;
    return kept;
  }

  // Some pairs of a block, in their order.
  struct List {
    template <class Belongs>
    void list(int first, int last, const Belongs& belongs) {
      size = 0;
      for (int k = first; k < last; ++k) pairs[size] = k, size += belongs(k);
    }
    int size = 0;
    std::array<int, block_size> pairs;
  };

  ContactFinderOptions options;
  const FclAxes& fcl;
  List moved, touching;
  double margin = 0;  // of the pair at hand
  ConvexContactSearch convex;
  ConvexContact fresh;  // of a pair that did not touch before
  std::vector<ClipPoint> clip;
  int computed = 0, refused = 0;
};

NarrowPhase::NarrowPhase(const ContactFinderOptions& options, int threads, const FclAxes& fcl) {
  for (int k = 0; k < threads; ++k) workers_.push_back(std::make_unique<Worker>(options, fcl));
}

NarrowPhase::~NarrowPhase() = default;

int NarrowPhase::run(const Items& items, PairCache& pairs, std::vector<Manifold>& manifolds,
                     const ThreadPool& pool) {
  for (auto& worker : workers_) worker->computed = worker->refused = 0;
  if (pool.threads() > 1)
    run_in_blocks(items, pairs, manifolds, pool);
  else
    run_alone(items, pairs, manifolds);
  int computed = 0;
  for (const auto& worker : workers_) computed += worker->computed;
  return computed;
}

int NarrowPhase::refused() const {
  int refused = 0;
  for (const auto& worker : workers_) refused += worker->refused;
  return refused;
}

void NarrowPhase::run_alone(const Items& items, PairCache& pairs, std::vector<Manifold>& manifolds) {
  workers_[0]->process(items, pairs, 0, static_cast<int>(pairs.entries().size()), manifolds);
}

void NarrowPhase::run_in_blocks(const Items& items, PairCache& pairs, std::vector<Manifold>& manifolds,
                                const ThreadPool& pool) {
  const int count = static_cast<int>(pairs.entries().size());
  const std::size_t blocks = static_cast<std::size_t>((count + block_size - 1) / block_size);
  if (found_.size() < blocks) found_.resize(blocks);
  pool.blocks_by_thread(count, block_size, [&](int begin, int end, int thread) {
    for (int first = begin; first < end; first += block_size) {
      std::vector<Manifold>& found = found_[static_cast<std::size_t>(first / block_size)];
      workers_[static_cast<std::size_t>(thread)]->process(items, pairs, first,
                                                          std::min(end, first + block_size), found);
    }
  });
  std::size_t total = 0;
  starts_.clear();
  for (std::size_t block = 0; block < blocks; ++block)
    starts_.push_back(total), total += found_[block].size();
  manifolds.resize(total);
  pool.blocks(static_cast<int>(blocks), 1, [&](int begin, int end) {
    for (int block = begin; block < end; ++block)
      std::copy(found_[block].begin(), found_[block].end(),
                manifolds.begin() + static_cast<std::ptrdiff_t>(starts_[block]));
  });
}

}  // namespace drawpoint::engine::detail
