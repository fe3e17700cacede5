// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/contact/contact_finder.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <drawpoint/engine/contact/finder_items.hpp>
#include <drawpoint/engine/contact/pair_cache.hpp>
#include <drawpoint/engine/contact/plane_contact.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::contact {
namespace {

using detail::Item;
using detail::PairState;
using Eigen::Isometry3d;
using Eigen::Vector3d;

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("contact::ContactFinder: " + what);
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

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Manifold between(const Item& a, const Item& b, int id_a, int id_b) {
  Manifold manifold;
  manifold.collider_a = id_a, manifold.collider_b = id_b;
  manifold.body_a = a.collider.body, manifold.body_b = b.collider.body;
  manifold.radius = 1 / (1 / a.equivalent_radius + 1 / b.equivalent_radius);
  manifold.count = 0;
  return manifold;
}

}  // namespace

class ContactFinder::Impl {
 public:
  explicit Impl(const ContactFinderOptions& options)
      : options_(options), search_margin_(options.margin + options.reuse_distance) {
    check(options);
  }

  int add(const Collider& collider) {
    const int id = static_cast<int>(items_.size());
    items_.push_back(hulls_.make_item(collider));
    Item& item = items_.back();
    item.place(Isometry3d::Identity());
    if (item.hull) boxes_.add(id, fat_box(item), collider.moves);
    return id;
  }

  void remove(int id) {
    if (at(id).hull) boxes_.remove(id);
    at(id) = Item{};
  }

  Item& at(int id) {
    if (id < 0 || static_cast<std::size_t>(id) >= items_.size() ||
        !items_[static_cast<std::size_t>(id)].alive())
      refuse("there is no collider " + std::to_string(id) +
             "; use a number that add() gave and remove() has not taken");
    return items_[static_cast<std::size_t>(id)];
  }

  void set_pose(int id, const Isometry3d& X_WB) {
    if (!X_WB.matrix().allFinite()) refuse("the pose of collider " + std::to_string(id) + " is not finite");
    at(id).place(X_WB);
  }

  void set_moves(int id, bool moves) {
    Item& item = at(id);
    if (item.collider.moves == moves) return;
    item.collider.moves = moves;
    if (item.hull) boxes_.set_moves(id, moves);
  }

  const std::vector<Manifold>& find() {
    times_ = {};
    const auto start = std::chrono::steady_clock::now();
    broad_phase();
    times_.broad = seconds_since(start);
    const auto middle = std::chrono::steady_clock::now();
    find_planes();
    find_pairs();
    times_.narrow = seconds_since(middle);
    return manifolds_;
  }

  void forget() {
    pairs_.forget();
    for (std::size_t id = 0; id < items_.size(); ++id) {
      if (!items_[id].hull) continue;
      items_[id].travelled = 0;
      boxes_.set_box(static_cast<int>(id), fat_box(items_[id]));
    }
  }

  const FinderTimes& times() const { return times_; }

 private:
  Item& item(int id) { return items_[static_cast<std::size_t>(id)]; }

  Eigen::AlignedBox3d fat_box(Item& item) const {
    Eigen::AlignedBox3d box = item.box();
    const Vector3d growth = Vector3d::Constant(0.5 * search_margin_ + options_.slack);
    box.min() -= growth, box.max() += growth;
    item.boxed_at = item.travelled;
    return box;
  }

  static bool may_touch(const Item& a, const Item& b) {
    return a.collider.body != b.collider.body && (a.collider.moves || b.collider.moves) &&
           (a.collider.family <= 0 || a.collider.family != b.collider.family);
  }

  void broad_phase() {
    for (std::size_t id = 0; id < items_.size(); ++id)
      if (items_[id].hull && items_[id].travelled - items_[id].boxed_at > options_.slack)
        boxes_.set_box(static_cast<int>(id), fat_box(items_[id]));
    const auto changes = boxes_.update();
    times_.fcl_calls = changes.look_ups;
    if (changes.any)
      pairs_.update(boxes_, changes, [this](int a, int b) { return may_touch(item(a), item(b)); });
    times_.pairs = static_cast<int>(pairs_.entries().size());
  }

  // Contacts with half-spaces, ordered like the pairs so that find_pairs() can interleave them.
  void find_planes() {
    plane_manifolds_.clear();
    for (std::size_t p = 0; p < items_.size(); ++p) {
      if (!items_[p].plane) continue;
      const detail::Plane plane = items_[p].plane_in_world();
      for (std::size_t s = 0; s < items_.size(); ++s)
        if (items_[s].hull && may_touch(items_[p], items_[s]))
          touch_plane(plane, static_cast<int>(p), static_cast<int>(s));
    }
    std::sort(plane_manifolds_.begin(), plane_manifolds_.end(), [](const Manifold& x, const Manifold& y) {
      return std::pair(x.collider_a, x.collider_b) < std::pair(y.collider_a, y.collider_b);
    });
  }

  void touch_plane(const detail::Plane& plane, int plane_id, int shape_id) {
    const Item &ground = item(plane_id), &shape = item(shape_id);
    if (plane.normal.dot(shape.centre) - plane.offset > shape.hull->radius + options_.margin) return;
    if (shape.cylinder)
      detail::plane_contact(plane, *shape.cylinder, shape.X_WC, options_.margin, clip_);
    else
      detail::plane_contact(plane, *shape.hull, shape.X_WC, options_.margin, clip_);
    if (clip_.empty()) return;
    const bool first = plane_id < shape_id;
    Manifold manifold =
        first ? between(ground, shape, plane_id, shape_id) : between(shape, ground, shape_id, plane_id);
    manifold.normal = first ? plane.normal : Vector3d(-plane.normal);
    for (const detail::ClipPoint& p : clip_)
      manifold.points[static_cast<std::size_t>(manifold.count++)] = {p.position - 0.5 * p.gap * plane.normal,
                                                                     p.gap, p.feature};
    plane_manifolds_.push_back(manifold);
  }

  void find_pairs() {
    manifolds_.clear();
    auto plane = plane_manifolds_.begin();
    for (const auto& entry : pairs_.entries()) {
      const Item &a = item(entry.a), &b = item(entry.b);
      PairState& state = pairs_.state(entry);
      if (!still_good(a, b, state)) compute(a, b, state);
      if (state.contact.count == 0) continue;
      for (; plane != plane_manifolds_.end() &&
             std::pair(plane->collider_a, plane->collider_b) < std::pair(entry.a, entry.b);
           ++plane)
        manifolds_.push_back(*plane);
      carry_along(a, b, entry, state.contact);
    }
    manifolds_.insert(manifolds_.end(), plane, plane_manifolds_.end());
  }

  // Whether the shapes have moved so little against each other that the remembered contact serves. First by
  // how far both have travelled, which costs nothing; then by where they stand against each other.
  bool still_good(const Item& a, const Item& b, const PairState& state) const {
    if (!state.known) return false;
    const Item &small = a.hull->radius < b.hull->radius ? a : b, &large = &small == &a ? b : a;
    const bool touching = state.contact.count > 0;
    const double travelled = a.travelled + b.travelled - state.travelled, r = small.hull->radius;
    const double free = state.contact.separation - options_.margin;
    if (travelled <= (touching ? std::min(options_.reuse_distance, options_.reuse_angle * r) : free))
      return true;
    const Eigen::Matrix3d R_WL = large.X_WC.linear();
    const double distance =
        (R_WL.transpose() * (small.centre - large.X_WC.translation()) - state.centre).norm();
    if (distance > (touching ? options_.reuse_distance : free)) return false;
    // ‖ΔR‖_F/√2 is the largest displacement of a unit vector, 2 sin(θ/2).
    const double turn =
        (R_WL.transpose() * small.X_WC.linear() - state.orientation).norm() / std::numbers::sqrt2;
    return touching ? turn <= options_.reuse_angle : distance + turn * r <= free;
  }

  void compute(const Item& a, const Item& b, PairState& state) {
    ++times_.computed;
    const Item &small = a.hull->radius < b.hull->radius ? a : b, &large = &small == &a ? b : a;
    const Eigen::Matrix3d R_WL = large.X_WC.linear();
    state.known = true;
    state.travelled = a.travelled + b.travelled;
    state.centre = R_WL.transpose() * (small.centre - large.X_WC.translation());
    state.orientation = R_WL.transpose() * small.X_WC.linear();
    const double apart = (a.centre - b.centre).norm() - a.hull->radius - b.hull->radius;
    if (apart > search_margin_) {
      state.contact.count = 0;
      state.contact.separation = apart;
      return;
    }
    state.contact = convex_.find({*a.hull, *b.hull, a.X_WC.inverse() * b.X_WC},
                                 {search_margin_, options_.hysteresis, state.contact.feature});
  }

  // The remembered contact at the present poses.
  void carry_along(const Item& a, const Item& b, const detail::PairCache::Entry& entry,
                   const detail::ConvexContact& contact) {
    Manifold& manifold = manifolds_.emplace_back(between(a, b, entry.a, entry.b));
    manifold.normal = (contact.normal_of_b ? b : a).X_WC.linear() * contact.normal;
    for (int k = 0; k < contact.count; ++k) {
      const detail::Anchors& anchors = contact.points[static_cast<std::size_t>(k)];
      const Vector3d on_a = a.X_WC * anchors.on_a, on_b = b.X_WC * anchors.on_b;
      const double gap = manifold.normal.dot(on_b - on_a);
      if (gap <= options_.margin)
        manifold.points[static_cast<std::size_t>(manifold.count++)] = {0.5 * (on_a + on_b), gap,
                                                                       anchors.feature};
    }
    if (manifold.count == 0) manifolds_.pop_back();
  }

  ContactFinderOptions options_;
  double search_margin_;
  std::vector<Item> items_;
  detail::HullLibrary hulls_;
  detail::BroadPhase boxes_;
  detail::PairCache pairs_;
  detail::ConvexContactSearch convex_;
  std::vector<detail::ClipPoint> clip_;
  std::vector<Manifold> manifolds_, plane_manifolds_;
  FinderTimes times_;
};

ContactFinder::ContactFinder(const ContactFinderOptions& options) : impl_(std::make_unique<Impl>(options)) {}
ContactFinder::~ContactFinder() = default;
ContactFinder::ContactFinder(ContactFinder&&) noexcept = default;
ContactFinder& ContactFinder::operator=(ContactFinder&&) noexcept = default;

int ContactFinder::add(const Collider& collider) { return impl_->add(collider); }
void ContactFinder::remove(int collider) { impl_->remove(collider); }
const Collider& ContactFinder::collider(int collider) const { return impl_->at(collider).collider; }
void ContactFinder::set_pose(int collider, const Isometry3d& X_WB) { impl_->set_pose(collider, X_WB); }
void ContactFinder::set_moves(int collider, bool moves) { impl_->set_moves(collider, moves); }
const std::vector<Manifold>& ContactFinder::find() { return impl_->find(); }
const FinderTimes& ContactFinder::times() const { return impl_->times(); }
void ContactFinder::forget() { impl_->forget(); }

}  // namespace drawpoint::engine::contact
