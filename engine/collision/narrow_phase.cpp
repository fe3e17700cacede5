// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/base/prefetch.h>
#include <drawpoint/engine/collision/narrow_phase.h>
#include <drawpoint/engine/geometry/hull_extremes.h>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Pairs a block: some 20 µs of work, large against the hand-over of a block and small against a step.
constexpr int block_size = 128;

Eigen::Isometry3d pose_against(const Placement& a, const Placement& b) {
  Eigen::Isometry3d X_AB;
  X_AB.linear() = a.R.transpose() * b.R;
  X_AB.translation() = a.R.transpose() * (b.p - a.p);
  X_AB.makeAffine();
  return X_AB;
}

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

// How the smaller shape stands in the frame of the larger.
struct Stand {
  Stand(const Placement& a, const Placement& b) {
    const bool a_smaller = a.hull->radius < b.hull->radius;
    const Placement &small = a_smaller ? a : b, &large = a_smaller ? b : a;
    centre = large.R.transpose() * (small.centre - large.p);
    orientation = large.R.transpose() * small.R;
    radius = small.hull->radius;
  }
  Vector3d centre;
  Matrix3d orientation;
  double radius;
};

void start_manifold(const Items& items, const PairEntry& entry, const Vector3d& normal, Manifold& manifold) {
  const Traits &a = items.traits[entry.a], &b = items.traits[entry.b];
  manifold.collider_a = entry.a, manifold.collider_b = entry.b;
  manifold.body_a = a.body, manifold.body_b = b.body;
  manifold.slot = entry.slot;
  manifold.normal = normal;
  manifold.radius = 1 / (a.inverse_radius + b.inverse_radius);
  manifold.count = 0;
}

}  // namespace

// One thread's part: buffers only, nothing that one pair leaves behind for another.
struct NarrowPhase::Worker {
  explicit Worker(const ContactFinderOptions& o) : options(o) {}

  // Brings the pairs [first, last) up to date and replaces `found` by their manifolds.
  void process(const Items& items, PairCache& pairs, int first, int last, std::vector<Manifold>& found) {
    Manifolds manifolds(found);
    for (int k = first; k < last; ++k) {
      prefetch_ahead(items, pairs, k, last);
      process(items, pairs.entries()[k], pairs.state(pairs.entries()[k]), manifolds);
    }
  }

  // What the pairs after this one need: where they are and their contacts, then the hulls of those that have
  // moved. Each of the three reads what the one before it has brought.
  [[gnu::always_inline]] static void prefetch_ahead(const Items& items, const PairCache& pairs, int k,
                                                    int last) {
    const std::vector<PairEntry>& entries = pairs.entries();
    constexpr int first = 6, second = 3, third = 1;  // pairs ahead
    if (k + first < last) {
      const PairEntry& soon = entries[k + first];
      prefetch(&items.placed[soon.b], sizeof(Placement));
      if (soon.count > 0) prefetch(&pairs.state(soon).contact, sizeof(ConvexContact) / 2);
    }
    if (k + second < last && moved(items, entries[k + second])) {
      prefetch(items.placed[entries[k + second].b].hull, sizeof(CollisionHull));
      prefetch(&pairs.state(entries[k + second]), sizeof(PairState));
    }
    if (k + third < last && moved(items, entries[k + third])) {
      const CollisionHull& hull = *items.placed[entries[k + third].b].hull;
      for (const auto* numbers : {&hull.x, &hull.y, &hull.z})
        prefetch(numbers->data(), static_cast<std::size_t>(numbers->size()) * sizeof(double));
      prefetch(hull.face_planes.data(), static_cast<std::size_t>(hull.face_planes.size()) * sizeof(float));
    }
  }

  // Whether a pair of two hulls has to be looked at again.
  static bool moved(const Items& items, const PairEntry& entry) {
    return items.placed[entry.a].hull && items.placed[entry.b].hull &&
           items.motion_bound[entry.a] + items.motion_bound[entry.b] > entry.limit;
  }

  // Brings a pair up to date and appends its manifold, if there is one.
  void process(const Items& items, PairEntry& entry, PairState& state, Manifolds& manifolds) {
    const double motion_bound = items.motion_bound[entry.a] + items.motion_bound[entry.b];
    const bool with_plane = !items.placed[entry.a].hull || !items.placed[entry.b].hull;
    if (with_plane) {
      touch_plane(items, entry, motion_bound, manifolds);
      return;
    }
    if (motion_bound > entry.limit) {
      margin = margin_of(items, entry);
      refresh(items.placed[entry.a], items.placed[entry.b], motion_bound, entry, state);
    }
    if (entry.count > 0) carry_along(items, entry, state.contact, manifolds);
  }

  // How near the shapes of a pair must come to be reported.
  double margin_of(const Items& items, const PairEntry& entry) const {
    return options.margin + items.speculative_margin[entry.a] + items.speculative_margin[entry.b];
  }

  void refresh(const Placement& a, const Placement& b, double motion_bound, PairEntry& entry,
               PairState& state) {
    const bool known = entry.limit != PairEntry::at_once;
    if (known && entry.count > 0 && still_stands(a, b, motion_bound, entry, state)) return;
    if (known && entry.count == 0 && still_apart(a, b, motion_bound, entry, state.contact)) return;
    compute(a, b, motion_bound, entry, state);
  }

  // The plane on A that separated the shapes last time.
  bool still_apart(const Placement& a, const Placement& b, double motion_bound, PairEntry& entry,
                   const ConvexContact& contact) const {
    const Vector3d normal = a.R * contact.normal;
    const double least = lowest(*b.hull, b.R.transpose() * normal).height + normal.dot(b.p - a.p);
    const double separation = least - contact.support;
    if (!(separation > margin + options.reuse_distance)) return false;
    entry.limit = motion_bound + (separation - margin);
    return true;
  }

  bool still_stands(const Placement& a, const Placement& b, double motion_bound, PairEntry& entry,
                    const PairState& state) const {
    if (margin > state.margin) return false;
    const Stand now(a, b);
    const double distance = (now.centre - state.centre).norm();
    if (distance > options.reuse_distance) return false;
    // ‖ΔR‖_F/√2 is the largest displacement of a unit vector, 2 sin(θ/2).
    const double turn = (now.orientation - state.orientation).norm() / std::numbers::sqrt2;
    if (turn > options.reuse_angle) return false;
    entry.limit =
        motion_bound + std::min(options.reuse_distance - distance, (options.reuse_angle - turn) * now.radius);
    return true;
  }

  void compute(const Placement& a, const Placement& b, double motion_bound, PairEntry& entry,
               PairState& state) {
    ++computed;
    convex.find({*a.hull, *b.hull, pose_against(a, b)},
                {margin + options.reuse_distance, options.hysteresis, state.contact.feature, margin},
                state.contact);
    entry.count = state.contact.count;
    if (entry.count == 0) {
      entry.limit = motion_bound + (state.contact.separation - margin);
      return;
    }
    const Stand now(a, b);
    state.centre = now.centre, state.orientation = now.orientation, state.margin = margin;
    entry.limit = motion_bound + std::min(options.reuse_distance, options.reuse_angle * now.radius);
  }

  // The remembered contact at the present poses.
  void carry_along(const Items& items, const PairEntry& entry, const ConvexContact& contact,
                   Manifolds& manifolds) const {
    const Placement &a = items.placed[entry.a], &b = items.placed[entry.b];
    const double reported = margin_of(items, entry);
    Manifold& manifold = manifolds.add();
    start_manifold(items, entry, (contact.normal_of_b ? b : a).R * contact.normal, manifold);
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

  // Half-spaces have closed forms; only how long nothing can happen is remembered.
  void touch_plane(const Items& items, PairEntry& entry, double motion_bound, Manifolds& manifolds) {
    const bool first = !items.placed[entry.a].hull;
    const int plane_id = first ? entry.a : entry.b, shape_id = first ? entry.b : entry.a;
    const Placement& shape = items.placed[shape_id];
    // The motion bound of a half-space stands still: a moved one makes the pair new.
    if (motion_bound <= entry.limit) return;
    const Plane plane = items.plane(plane_id);
    const double height = plane.normal.dot(shape.centre) - plane.offset - shape.hull->radius;
    margin = margin_of(items, entry);
    entry.limit = height > margin ? motion_bound + (height - margin) : PairEntry::at_once;
    if (height > margin) return;
    Eigen::Isometry3d X_WC;
    X_WC.linear() = shape.R, X_WC.translation() = shape.p, X_WC.makeAffine();
    if (const Cylinder* cylinder = items.item[shape_id].cylinder)
      plane_contact(plane, *cylinder, X_WC, margin, clip);
    else
      plane_contact(plane, *shape.hull, X_WC, margin, clip);
    if (clip.empty()) return;
    Manifold& manifold = manifolds.add();
    start_manifold(items, entry, first ? plane.normal : Vector3d(-plane.normal), manifold);
    for (const ClipPoint& p : clip)
      manifold.points[static_cast<std::size_t>(manifold.count++)] = {p.position - 0.5 * p.gap * plane.normal,
                                                                     p.gap, p.feature};
  }

  ContactFinderOptions options;
  double margin = 0;  // of the pair at hand
  ConvexContactSearch convex;
  std::vector<ClipPoint> clip;
  int computed = 0;
};

NarrowPhase::NarrowPhase(const ContactFinderOptions& options, int threads) {
  for (int k = 0; k < threads; ++k) workers_.push_back(std::make_unique<Worker>(options));
}

NarrowPhase::~NarrowPhase() = default;

int NarrowPhase::run(const Items& items, PairCache& pairs, std::vector<Manifold>& manifolds,
                     const ThreadPool& pool) {
  for (auto& worker : workers_) worker->computed = 0;
  if (pool.threads() > 1)
    run_in_blocks(items, pairs, manifolds, pool);
  else
    run_alone(items, pairs, manifolds);
  int computed = 0;
  for (const auto& worker : workers_) computed += worker->computed;
  return computed;
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
