// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/engine/geometry/ray.hpp>

#include <cmath>
#include <limits>

namespace drawpoint::engine {
namespace {

using Eigen::Vector3d;

// The part of a ray inside a convex solid, cut down surface by surface.
class Span {
 public:
  Span(const Ray& ray, double most) : ray_(ray), leave_(most) {}

  // Keeps what lies where normal·x <= offset.
  void cut(const Vector3d& normal, double offset) {
    const double rate = normal.dot(ray_.direction), height = normal.dot(ray_.origin) - offset;
    if (rate == 0) {
      if (height > 0) leave_ = -1;
      return;
    }
    const double at = -height / rate;
    if (rate > 0)
      leave_ = std::min(leave_, at);
    else
      enter(at, normal);
  }

  // Keeps what lies inside the tube of this radius about the y axis.
  void cut_tube(double radius) {
    const Eigen::Vector2d p(ray_.origin.x(), ray_.origin.z()), d(ray_.direction.x(), ray_.direction.z());
    const double a = d.squaredNorm(), b = p.dot(d), c = p.squaredNorm() - radius * radius;
    if (a == 0) {
      if (c > 0) leave_ = -1;
      return;
    }
    const double discriminant = b * b - a * c;
    if (discriminant < 0) {
      leave_ = -1;
      return;
    }
    const double root = std::sqrt(discriminant), at = (-b - root) / a;
    const Eigen::Vector2d rim = (p + at * d) / radius;
    enter(at, Vector3d(rim.x(), 0, rim.y()));
    leave_ = std::min(leave_, (-b + root) / a);
  }

  std::optional<RayEntry> entry() const {
    if (enter_ < 0 || enter_ > leave_) return std::nullopt;
    return RayEntry{enter_, normal_};
  }

 private:
  void enter(double at, const Vector3d& normal) {
    if (at <= enter_) return;
    enter_ = at;
    normal_ = normal;
  }

  const Ray& ray_;
  double enter_ = -std::numeric_limits<double>::infinity(), leave_;
  Vector3d normal_ = Vector3d::Zero();
};

void cut(Span& span, const ConvexPolyhedron& polyhedron) {
  for (std::size_t f = 0; f < polyhedron.faces().size(); ++f) {
    const Vector3d& normal = polyhedron.face_normals()[f];
    span.cut(normal, normal.dot(polyhedron.vertices()[static_cast<std::size_t>(polyhedron.faces()[f][0])]));
  }
}

void cut(Span& span, const Cylinder& cylinder) {
  span.cut(Vector3d::UnitY(), cylinder.half_width);
  span.cut(-Vector3d::UnitY(), cylinder.half_width);
  span.cut_tube(cylinder.radius);
}

void cut(Span& span, const HalfSpace& half_space) { span.cut(half_space.normal, half_space.offset); }

}  // namespace

std::optional<RayEntry> intersect(const Ray& ray, const Shape& shape, const Eigen::Isometry3d& X_WS,
                                  double most) {
  const Eigen::Isometry3d X_SW = X_WS.inverse();
  const Ray local{X_SW * ray.origin, X_SW.linear() * ray.direction};
  Span span(local, most);
  std::visit([&](const auto& solid) { cut(span, solid); }, shape);
  std::optional<RayEntry> found = span.entry();
  if (found) found->normal = X_WS.linear() * found->normal;
  return found;
}

}  // namespace drawpoint::engine
