// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/machine_looks.h>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <variant>

namespace drawpoint::engine::loading {
namespace {

using Eigen::Vector3d;
using engine::ConvexPolyhedron;

constexpr const char *paint = "#d9a21b", *dark_paint = "#b07f10", *steel = "#5b5e63", *chrome = "#d8dce2",
                     *black = "#2c3036", *glass = "#8fb4c9", *lamp = "#fff3cf", *red = "#a8322a";
constexpr int round_sides = 20, rim_sides = 32, hub_sides = 6, teeth = 7;

class Artist {
 public:
  explicit Artist(const Lhd& lhd) : lhd_(lhd) {}
  std::vector<DrawnPart> all() {
    for (int wheel : lhd_.wheels) add_wheel(wheel);
    add_front();
    add_joint();
    add_hood();
    add_cab();
    add_arm();
    add_teeth();
    for (const LhdSurface& surface : lhd_.surfaces)
      if (!is_drawn_as_it_is(surface)) add_cylinder(surface);
    return std::move(parts_);
  }

 private:
  // Points of the reference pose.
  void hull(int body, std::vector<Vector3d> points, const char* color) {
    for (Vector3d& p : points) p -= centre(body);
    parts_.push_back({body, ConvexPolyhedron::hull_of(points), color});
  }
  void box(int body, const Vector3d& low, const Vector3d& high, const char* color) {
    const Vector3d middle = 0.5 * (low + high) - centre(body);
    place(body, engine::box(0.5 * (high - low)), Eigen::Isometry3d(Eigen::Translation3d(middle)), color);
  }
  // About an axis through `middle` of the body's frame.
  void round(int body, const Vector3d& middle, const Vector3d& half_axis, double radius, const char* color) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = middle;
    pose.rotate(Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitY(), half_axis));
    place(body, engine::prism(radius, half_axis.norm(), round_sides), pose, color);
  }
  // About a pin along y at a point of the reference pose.
  void pin(int body, const Vector3d& at, double half_width, double radius, const char* color) {
    round(body, at - centre(body), half_width * Vector3d::UnitY(), radius, color);
  }
  void place(int body, const ConvexPolyhedron& shape, const Eigen::Isometry3d& pose, const char* color) {
    parts_.push_back({body, shape.transformed(pose), color});
  }
  const Vector3d& centre(int body) const { return lhd_.spec.bodies[static_cast<std::size_t>(body)].centre; }

  double tyre_half_width(int wheel) const;
  void add_wheel(int wheel);
  void add_fender(int body, int wheel, double forward);
  void add_front();
  void add_joint();
  void add_hood();
  void add_cab();
  void add_arm();
  void add_teeth();
  void add_cylinder(const LhdSurface& surface);

  const Lhd& lhd_;
  std::vector<DrawnPart> parts_;
};

double Artist::tyre_half_width(int wheel) const {
  for (const LhdSurface& s : lhd_.surfaces)
    if (const auto* tyre = std::get_if<engine::Cylinder>(&s.shape); tyre && s.body == wheel)
      return tyre->half_width;
  return 0.3;
}

// Discs, each a little further out than the one around it; the six-sided hub shows how the wheel turns.
void Artist::add_wheel(int wheel) {
  const double half = tyre_half_width(wheel), r = lhd_.tyre_radius;
  const auto disc = [&](double radius, double out, int sides, const char* color) {
    parts_.push_back({wheel, engine::prism(radius * r, half + out, sides), color});
  };
  disc(0.60, 0.010, rim_sides, paint);
  disc(0.50, 0.016, rim_sides, dark_paint);
  disc(0.34, 0.040, hub_sides, paint);
  disc(0.15, 0.080, round_sides, black);
}

// As far forward of the hub.
void Artist::add_fender(int body, int wheel, double forward) {
  const Vector3d hub = centre(wheel);
  const double half = tyre_half_width(wheel), z = hub.z() + lhd_.tyre_radius + 0.06;
  box(body, {hub.x() - 0.75, hub.y() - half, z}, {hub.x() + forward, hub.y() + half, z + 0.05}, paint);
}

void Artist::add_front() {
  for (int k : {0, 1}) add_fender(lhd_.front, lhd_.wheels[static_cast<std::size_t>(k)], 0.75);
  for (double side : {-1.0, 1.0}) {
    const Vector3d at(-0.1, 0.56 * side, 2.04);
    box(lhd_.front, at - Vector3d(0.06, 0.06, 0.09), at + Vector3d(0.06, 0.06, 0.09), black);
    box(lhd_.front, at + Vector3d(0.06, -0.05, -0.05), at + Vector3d(0.075, 0.05, 0.07), lamp);
  }
}

// The upright joint between the halves, with its plates.
void Artist::add_joint() {
  const double x = lhd_.spec.bodies[static_cast<std::size_t>(lhd_.rear)].joint_point.x();
  for (double z : {0.78, 1.68}) {
    box(lhd_.front, {x - 0.18, -0.36, z}, {x + 0.5, 0.36, z + 0.07}, dark_paint);
    box(lhd_.rear, {x - 0.9, -0.36, z - 0.08}, {x + 0.18, 0.36, z - 0.01}, paint);
  }
  round(lhd_.rear, Vector3d(x, 0, 1.25) - centre(lhd_.rear), {0, 0, 0.6}, 0.15, steel);
}

void Artist::add_hood() {
  for (int k : {2, 3}) add_fender(lhd_.rear, lhd_.wheels[static_cast<std::size_t>(k)], 0.2);
  std::vector<Vector3d> hood;
  for (double side : {-1.0, 1.0})
    for (const auto& [x, y, z] :
         {std::array{-8.15, 1.2, 1.9}, {-6.05, 1.2, 1.9}, {-7.95, 0.95, 2.15}, {-6.2, 0.95, 2.15}})
      hood.emplace_back(x, side * y, z);
  hull(lhd_.rear, hood, paint);
  for (double side : {-1.0, 1.0}) {
    for (double z : {1.05, 1.25, 1.45, 1.65})  // louvres
      box(lhd_.rear, {-7.8, side * 1.455 - 0.01, z}, {-6.5, side * 1.455 + 0.01, z + 0.08}, black);
    box(lhd_.rear, {-8.22, side * 1.25 - 0.1, 1.6}, {-8.2, side * 1.25 + 0.1, 1.75}, red);
  }
  box(lhd_.rear, {-8.22, -0.95, 0.95}, {-8.2, 0.95, 1.75}, black);      // radiator
  box(lhd_.rear, {-4.7, -1.35, 1.95}, {-3.3, -0.62, 2.3}, dark_paint);  // oil tank
}

// Panes and a roof on the cab that rocks touch.
void Artist::add_cab() {
  const int b = lhd_.rear;
  for (double y : {0.605, 1.45}) box(b, {-4.42, y, 2.3}, {-3.38, y + 0.015, 2.78}, glass);
  for (double x : {-4.615, -3.2}) box(b, {x, 0.74, 2.3}, {x + 0.015, 1.33, 2.78}, glass);
  box(b, {-4.75, 0.52, 2.9}, {-3.05, 1.55, 2.98}, paint);
  for (double y : {0.7, 1.3}) box(b, {-3.05, y, 2.9}, {-3.0, y + 0.12, 2.98}, lamp);
}

// Cheeks along the boom, and the pins at both its ends.
void Artist::add_arm() {
  const Vector3d along = (lhd_.G - lhd_.F).normalized(), up = along.cross(-Vector3d::UnitY());
  for (double side : {-1.0, 1.0}) {
    std::vector<Vector3d> cheek;
    for (double y : {0.25, 0.32}) {
      const Vector3d out(0, side * y, 0);
      for (double s : {-0.2, 0.2})
        for (const Vector3d& end : {lhd_.F, lhd_.G}) cheek.push_back(end + out + s * up);
      for (double s : {-0.32, 0.32}) cheek.push_back(lhd_.F + 0.45 * (lhd_.G - lhd_.F) + out + s * up);
    }
    hull(lhd_.boom, cheek, "#e0b040");
  }
  pin(lhd_.boom, lhd_.F, 0.6, 0.13, steel);
  pin(lhd_.boom, lhd_.G, 0.45, 0.07, steel);  // thinner than the bucket's back is far
}

// On the cutting edge, whose line they leave by 6 cm.
void Artist::add_teeth() {
  const double reach = lhd_.bucket_width / 2 - 0.15;
  for (int k = 0; k < teeth; ++k) {
    const double y = reach * (2.0 * k / (teeth - 1) - 1);
    std::vector<Vector3d> wedge;
    for (double side : {-1.0, 1.0}) {
      wedge.push_back(lhd_.K + Vector3d(0.06, y + 0.05 * side, 0));
      wedge.push_back(lhd_.K + Vector3d(0.06, y + 0.05 * side, 0.02));
      wedge.push_back(lhd_.K + Vector3d(-0.10, y + 0.07 * side, 0.10));
      wedge.push_back(lhd_.K + Vector3d(-0.30, y + 0.07 * side, 0.08));
      wedge.push_back(lhd_.K + Vector3d(-0.30, y + 0.07 * side, 0));
    }
    hull(lhd_.bucket, wedge, steel);
  }
}

// Barrel or rod along the bar that stands for it; its eye is at the bar's end at the pin.
void Artist::add_cylinder(const LhdSurface& surface) {
  const auto& bar = std::get<ConvexPolyhedron>(surface.shape);
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& v : bar.vertices()) middle += v / static_cast<double>(bar.vertices().size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3d& v : bar.vertices()) spread += (v - middle) * (v - middle).transpose();
  const Vector3d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  double half = 0, breadth = 0;
  for (const Vector3d& v : bar.vertices()) {
    half = std::max(half, std::abs(axis.dot(v - middle)));
    breadth = std::max(breadth, std::abs(v.y() - middle.y()));
  }
  const bool barrel = breadth > 0.1;
  round(surface.body, middle, half * axis, breadth, barrel ? "#4a4e55" : chrome);
  const Vector3d forward = axis.x() > 0 ? axis : Vector3d(-axis);
  const Vector3d eye = middle + (barrel ? -half : half) * forward;
  round(surface.body, eye, {0, breadth + 0.04, 0}, barrel ? 0.13 : 0.11, steel);
  if (barrel) round(surface.body, middle + (half - 0.05) * forward, 0.06 * forward, 1.18 * breadth, black);
}

}  // namespace

std::vector<DrawnPart> machine_looks(const Lhd& lhd) { return Artist(lhd).all(); }

bool is_drawn_as_it_is(const LhdSurface& surface) {
  return surface.touches || !std::holds_alternative<ConvexPolyhedron>(surface.shape);
}

}  // namespace drawpoint::engine::loading
