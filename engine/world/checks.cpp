// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/world/checks.h>
#include <cmath>
#include <drawpoint/engine/base/checks.hpp>
#include <drawpoint/engine/base/constants.hpp>
#include <drawpoint/engine/geometry/mass_properties.hpp>
#include <limits>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument("engine::" + what); }

// `name` is "place: quantity".
void check_range(const std::string& name, double value, const Range& allowed) {
  require("engine::" + name, value, allowed);
}

void check(const Material& m, const std::string& name) {
  if (std::isnan(m.friction))
    refuse(name +
           "the friction is not given; set Material::friction (0 for none, 0.5 to 0.9 for rock on rock)");
  check_range(name + "friction", m.friction, {0, 100, "[1]"});
  check_range(name + "rolling resistance", m.rolling, {0, 100, "[1]"});
  check_range(name + "spinning resistance", m.spinning, {0, 100, "[1]"});
  check_range(name + "stiffness", m.stiffness, {1e-3, 1e18, "N/m (or Pa)"});
  check_range(name + "damping time", m.damping_time, {0, 1e6, "s"});
  check_range(name + "restitution", m.restitution, {0, 1, "[1]"});
}

// Refuses a polyhedron whose centre of mass, its density uniform, is not at its origin; a cylinder is always centred.
void check_centred(const Shape& shape) {
  constexpr double allowed = 1e-6;  // of the size: the hull's own tolerance on its vertices, with a margin
  const auto* hull = std::get_if<ConvexPolyhedron>(&shape);
  if (!hull) return;
  const Vector3d centre = mass_properties(*hull, 1.0).centre;
  if (centre.norm() <= allowed * hull->length()) return;
  refuse("World::add_rock: the shape's centre of mass is at " + text(centre) +
         " m in its own frame; allowed: within " + text(allowed * hull->length()) +
         " m of the origin; make the body by RockBody::from_hull()");
}

}  // namespace

void check(const WorldOptions& o) {
  check_step("World", o.step);
  check_range("World: size of gravity", o.gravity.norm(), {0, 1e3, "m/s^2"});
  check_range("World: warm_start", o.warm_start, {0, 1, "[1]"});
  check_range("World: threads", o.threads, {1, 256, "[1]"});
  check_range("World: margin of contacts", o.contacts.margin, {0, 10, "m"});
  check_range("World: slack of contacts", o.contacts.slack, {0, 10, "m"});
  check_range("World: reuse_distance of contacts", o.contacts.reuse_distance, {0, 10, "m"});
  check_range("World: reuse_angle of contacts", o.contacts.reuse_angle, {0, 10, "rad"});
  check_range("World: hysteresis of contacts", o.contacts.hysteresis, {0, 10, "m"});
}

void check_step(const char* place, double h) {
  if (!(h >= constants::shortest_step) || h > constants::longest_step)
    refuse(std::string(place) + ": step is " + text(h) + " s; allowed: " + text(constants::shortest_step) +
           " to " + text(constants::longest_step) + " s; rocks of 0.3 m need about 0.005 s");
}

void check(const MaterialTable& materials) {
  for (int a = 0; a < materials.kinds(); ++a)
    for (int b = a; b < materials.kinds(); ++b)
      if (materials.given(a, b))
        check(materials.of(a, b),
              "MaterialTable: kinds " + std::to_string(a) + " and " + std::to_string(b) + ": ");
}

void check(const RockBody& body, int materials) {
  if (!body.shape) refuse("World::add_rock: the body has no shape; set RockBody::shape");
  if (std::holds_alternative<HalfSpace>(*body.shape))
    refuse("World::add_rock: a half-space has no end and cannot be a rock; give it to add_static()");
  check_range("World::add_rock: mass", body.mass, {1e-9, 1e15, "kg"});
  for (double moment : body.inertia)
    check_range("World::add_rock: a moment of inertia", moment, {1e-20, 1e25, "kg m^2"});
  const double largest = body.inertia.maxCoeff();
  if (largest > (body.inertia.sum() - largest) * (1 + 1e-6))
    refuse("World::add_rock: no rigid body has the principal moments " + text(body.inertia) +
           " kg m^2: the largest exceeds the sum of the others");
  check_material("World::add_rock", body.material, materials);
  check_centred(*body.shape);
}

void check_material(const char* place, int material, int materials) {
  if (material < 0 || material >= materials)
    refuse(std::string(place) + ": there is no material " + std::to_string(material) + "; allowed: 0 to " +
           std::to_string(materials - 1));
}

void check_pose(const char* place, const Eigen::Isometry3d& pose) {
  const Vector3d p = pose.translation();
  for (double x : p) check_range(std::string(place) + ": a coordinate of the position", x, {-1e5, 1e5, "m"});
  const Matrix3d R = pose.linear();
  if (!is_rotation(R))
    refuse(std::string(place) + ": the orientation is no rotation matrix (RᵀR − 1 has norm " +
           text(off_orthonormal(R)) + ", allowed: below " + orthonormal.text + "); normalise it");
}

void check_velocity(const char* place, const Vector3d& velocity, const Vector3d& angular_velocity) {
  check_range(std::string(place) + ": speed of " + text(velocity), velocity.norm(),
              {0, constants::fastest_input, "m/s"});
  check_range(std::string(place) + ": angular speed of " + text(angular_velocity), angular_velocity.norm(),
              {0, constants::fastest_spin, "rad/s"});
}

double radius_about_origin(const Shape& shape) {
  if (const auto* polyhedron = std::get_if<ConvexPolyhedron>(&shape)) return polyhedron->radius();
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return std::hypot(cylinder->radius, cylinder->half_width);
  return std::numeric_limits<double>::infinity();
}

}  // namespace drawpoint::engine::detail
