// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/world/inner_edges.h>

#include <algorithm>
#include <drawpoint/engine/base/constants.hpp>
#include <tuple>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

// A shape that stands in the world.
struct Solid {
  const Shape& shape;
  Eigen::Isometry3d X_WS;
};

// What of a shape's surface is next to a point inside.
struct Depth {
  double depth;  // [m], less than 0 outside
  Vector3d normal;
};

// How deep the shape holds the point, which may lie outside by constants::seam_step, under the face that looks along
// `beside` most. Nothing of cylinders.
std::optional<Depth> holds(const Solid& solid, const Vector3d& point, const Vector3d& beside) {
  const Vector3d p = solid.X_WS.inverse() * point, along = solid.X_WS.linear().transpose() * beside;
  if (const auto* plane = std::get_if<HalfSpace>(&solid.shape)) {
    const double depth = plane->offset - plane->normal.dot(p);
    if (depth < -constants::seam_step) return std::nullopt;
    return Depth{depth, solid.X_WS.linear() * plane->normal};
  }
  const auto* shape = std::get_if<ConvexPolyhedron>(&solid.shape);
  if (!shape) return std::nullopt;
  std::size_t top = 0;
  for (std::size_t face = 0; face < shape->faces().size(); ++face) {
    if (shape->height_over(face, p) > constants::seam_step) return std::nullopt;
    if (shape->face_normals()[face].dot(along) > shape->face_normals()[top].dot(along)) top = face;
  }
  return Depth{-shape->height_over(top, p), solid.X_WS.linear() * shape->face_normals()[top]};
}

// Or holds but for less than a step, as a wall does that leans back.
bool contains(const ConvexPolyhedron& shape, const Vector3d& p) {
  return shape.depth(p) >= -0.5 * constants::seam_step;
}

bool is_face_normal(const ConvexPolyhedron& shape, const Vector3d& n) {
  return std::any_of(shape.face_normals().begin(), shape.face_normals().end(),
                     [&](const Vector3d& face) { return (face - n).norm() < constants::same_face; });
}

}  // namespace

void InnerEdges::leave_out(const Scene& scene, int manifolds, JoiningPoints& joining) {
  if (!scene.has_inner_edges()) return;
  list(scene, manifolds, joining);
  for (auto first = contacts_.begin(); first != contacts_.end();) {
    const auto last =
        std::find_if(first, contacts_.end(), [&](const Contact& c) { return !c.same_body(*first); });
    for (auto contact = first; contact != last; ++contact)
      for (auto by = first; by != last; ++by)
        if (by != contact) joining.leave_out(contact->manifold, covered(scene, joining, *contact, *by));
    first = last;
  }
}

// Grouped by what touches which body.
void InnerEdges::list(const Scene& scene, int manifolds, const JoiningPoints& joining) {
  contacts_.clear();
  for (int k = 0; k < manifolds; ++k) {
    if (joining.points(k) == 0) continue;
    const Manifold& m = joining.manifold(k);
    const Surface &a = scene.surface(m.collider_a), &b = scene.surface(m.collider_b);
    if (a.owner == Owner::rock && b.owner == Owner::rock) continue;
    for (const bool on_a : {true, false}) {
      const Surface& surface = on_a ? a : b;
      if (surface.owner == Owner::rock) continue;
      contacts_.push_back(
          {on_a ? m.collider_b : m.collider_a, surface.owner == Owner::part ? surface.index : -1, k, on_a});
    }
  }
  std::sort(contacts_.begin(), contacts_.end(), [](const Contact& a, const Contact& b) {
    return std::tie(a.other, a.part, a.manifold) < std::tie(b.other, b.part, b.manifold);
  });
}

// The points of a contact with a surface that the surface of `by` goes on into.
unsigned InnerEdges::covered(const Scene& scene, const JoiningPoints& joining, const Contact& contact,
                             const Contact& by) const {
  const Manifold &m = joining.manifold(contact.manifold), &other = joining.manifold(by.manifold);
  const int own = contact.on_a ? m.collider_a : m.collider_b,
            covering = by.on_a ? other.collider_a : other.collider_b;
  const auto* shape = std::get_if<ConvexPolyhedron>(scene.finder().collider(own).shape.get());
  if (!shape) return 0;
  const Vector3d outward = contact.on_a ? m.normal : Vector3d(-m.normal),
                 beside = by.on_a ? other.normal : Vector3d(-other.normal);
  const Eigen::Isometry3d X_WS = scene.shape_pose(own);
  Vector3d back = outward;
  if (!is_face_normal(*shape, X_WS.linear().transpose() * outward)) {
    back -= outward.dot(beside) * beside;
    if (back.norm() < constants::same_face) return 0;
    back.normalize();
  }
  const Solid solid{*scene.finder().collider(covering).shape, scene.shape_pose(covering)};
  const FirstTouch* const touch = joining.touch(contact.manifold);
  unsigned covered = 0;
  for (int k = 0; k < m.count; ++k) {
    const auto place = static_cast<std::size_t>(k);
    const double to_surface = (contact.on_a ? -0.5 : 0.5) * m.points[place].gap;
    const Vector3d p = touch ? (contact.on_a ? touch->on_a : touch->on_b)[place]
                             : Vector3d(m.points[place].position + to_surface * m.normal);
    const std::optional<Depth> held = holds(solid, p + constants::seam_width * back, beside);
    if (!held) continue;
    const Vector3d above = p + (std::max(0.0, held->depth) + 1.5 * constants::seam_step) * held->normal;
    if (!contains(*shape, X_WS.inverse() * above)) covered |= 1u << k;
  }
  return covered;
}

}  // namespace drawpoint::engine::detail
