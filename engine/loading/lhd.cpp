// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/engine/loading/arm_linkage.hpp>
#include <drawpoint/engine/loading/lhd.hpp>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using engine::ConvexPolyhedron;
using machine::BodySpec;
using machine::JointKind;

const Vector3d nose_up = -Vector3d::UnitY();  // positive angles raise the nose
constexpr double wheelbase = 4.9, half_track = 1.1, tyre_half_width = 0.445;
constexpr double lift_side = 0.45;        // lateral place of the lift cylinders [m]
constexpr double rear_axle_share = 0.56;  // of the empty weight

Vector3d at(double x, double z, double y = 0) { return {x, y, z}; }
Vector3d at(const Vector2d& p) { return at(p.x(), p.y()); }
const ArmLinkage pins;
const Vector3d F = at(pins.F), G = at(pins.G), H = at(pins.H), E = at(pins.E), Q = at(pins.Q), P = at(pins.P),
               T = at(pins.T);
const Vector3d B = at(-0.65, 0.60), D = at(1.108, 0.628);  // of the lift cylinders, on frame and boom

// Solid box with its length along `along` (in the x-z plane), width along y.
Matrix3d box_inertia(double mass, double length, double width, double height,
                     const Vector3d& along = Vector3d::UnitX()) {
  Matrix3d R;
  R.col(0) = along.normalized();
  R.col(1) = Vector3d::UnitY();
  R.col(2) = R.col(0).cross(R.col(1));
  const Vector3d I(width * width + height * height, length * length + height * height,
                   length * length + width * width);
  return R * (mass / 12 * I).asDiagonal() * R.transpose();
}

Matrix3d wheel_inertia(double mass, double radius, double width) {
  const double across = mass * (3 * radius * radius + width * width) / 12;
  return Vector3d(across, mass * radius * radius / 2, across).asDiagonal();
}

BodySpec hinged(const std::string& name, int parent, const Vector3d& point, const Vector3d& axis, double mass,
                const Vector3d& centre, const Matrix3d& inertia) {
  return {name, parent, JointKind::hinge, point, axis, mass, centre, inertia};
}

class Builder {
 public:
  explicit Builder(const LhdOptions& options) {
    lhd_.options = options;
    lhd_.F = F;
    lhd_.G = G;
    lhd_.bucket_profile = bucket_profile(options.bucket);
    lhd_.K = at(lhd_.bucket_profile.front().x(), lhd_.bucket_profile.front().y());
    lhd_.loaded_radius = loaded_tyre_radius;
    lhd_.tyre_radius = 1.01;
    lhd_.bucket_width = options.bucket.width;
    lhd_.payload = 21e3;
    lhd_.pin_spacing = 1.2;
    lhd_.bucket_volume = heaped_volume(options.bucket);
  }

  Lhd build() {
    add_chassis();
    add_arm();
    balance_axles();
    add_motors();
    add_stops();
    add_chassis_surfaces();
    add_bucket_surfaces();
    add_arm_surfaces();
    return lhd_;
  }

 private:
  int add(const BodySpec& body) {
    lhd_.spec.bodies.push_back(body);
    return static_cast<int>(lhd_.spec.bodies.size()) - 1;
  }

  void add_chassis();
  void add_arm();
  std::array<int, 2> add_cylinder(const std::string& name, const Vector3d& from, const Vector3d& to,
                                  int driven);
  void balance_axles();
  void add_motors();
  void add_stops();
  void draw(int body, const std::vector<Vector3d>& points, SurfaceKind kind, bool touches,
            const std::string& color);
  void draw_bar(int body, const Vector3d& from, const Vector3d& to, double width, double height, bool touches,
                const std::string& color);
  void draw_box(int body, const Vector3d& low, const Vector3d& high, bool touches, const std::string& color);
  void add_chassis_surfaces();
  void add_bucket_surfaces();
  void add_arm_surfaces();

  Lhd lhd_;
};

void Builder::add_chassis() {
  const double r = lhd_.loaded_radius;
  BodySpec front;
  front.name = "front unit";
  front.mass = 13300;
  front.centre = at(-0.5, 1.1);
  front.inertia = box_inertia(front.mass, 2.6, 2.2, 1.4);
  lhd_.front = add(front);
  lhd_.rear = add(hinged("rear unit", lhd_.front, at(-wheelbase / 2, 0.95), Vector3d::UnitX(), 25200,
                         at(-5.9, 1.2), box_inertia(25200, 5.5, 2.6, 1.8)));
  const char* names[] = {"front left wheel", "front right wheel", "rear left wheel", "rear right wheel"};
  for (int k = 0; k < 4; ++k) {
    const Vector3d hub = at(k < 2 ? 0 : -wheelbase, r, k % 2 == 0 ? half_track : -half_track);
    lhd_.wheels[k] = add(hinged(names[k], k < 2 ? lhd_.front : lhd_.rear, hub, Vector3d::UnitY(), 1800, hub,
                                wheel_inertia(1800, lhd_.tyre_radius, 2 * tyre_half_width)));
  }
}

// Barrel and rod of a cylinder from its frame pin to its rod pin on `driven`; the rod pin closes a loop.
std::array<int, 2> Builder::add_cylinder(const std::string& name, const Vector3d& from, const Vector3d& to,
                                         int driven) {
  const Vector3d along = (to - from).normalized();
  const double length = (to - from).norm();
  const Vector3d barrel_centre = from + 0.35 * length * along, rod_centre = from + 0.75 * length * along;
  const int barrel = add(hinged(name + " barrel", lhd_.front, from, nose_up, 350, barrel_centre,
                                box_inertia(350, 0.7 * length, 0.26, 0.26, along)));
  BodySpec rod{name + " rod", barrel, JointKind::slider, to,
               along,         200,    rod_centre,        box_inertia(200, 0.5 * length, 0.14, 0.14, along)};
  const int rod_index = add(rod);
  lhd_.spec.loops.push_back({name + " rod pin", driven, rod_index, to, Vector3d::UnitY()});
  return {barrel, rod_index};
}

void Builder::add_arm() {
  lhd_.boom = add(
      hinged("boom", lhd_.front, F, nose_up, 3600, at(0.78, 1.17), box_inertia(3600, 2.9, 1.3, 0.6, G - F)));
  const BucketOptions& bucket = lhd_.options.bucket;
  const double mass = bucket_mass(bucket), side = 1.5 * bucket.size;
  const Vector2d centre = bucket_centre(bucket);
  lhd_.bucket = add(hinged("bucket", lhd_.boom, G, nose_up, mass, at(centre.x(), centre.y()),
                           box_inertia(mass, side, bucket.width, side)));
  lhd_.bell_crank = add(hinged("bell-crank", lhd_.boom, E, nose_up, 700, at(1.20, 1.46),
                               box_inertia(700, 1.7, 0.35, 0.3, Q - P)));
  lhd_.link = add(hinged("link", lhd_.bell_crank, P, nose_up, 350, 0.5 * (P + H),
                         box_inertia(350, 0.95, 0.3, 0.2, H - P)));
  lhd_.spec.loops.push_back({"link pin", lhd_.bucket, lhd_.link, H, Vector3d::UnitY()});
  const auto tilt = add_cylinder("tilt cylinder", T, Q, lhd_.bell_crank);
  lhd_.tilt_barrel = tilt[0];
  lhd_.tilt_rod = tilt[1];
  for (int k = 0; k < 2; ++k) {
    const Vector3d side(0, k == 0 ? lift_side : -lift_side, 0);
    const auto lift =
        add_cylinder(k == 0 ? "left lift cylinder" : "right lift cylinder", B + side, D + side, lhd_.boom);
    lhd_.lift_barrels[k] = lift[0];
    lhd_.lift_rods[k] = lift[1];
  }
}

// Puts the rear unit's centre where the empty axle loads come out as published.
void Builder::balance_axles() {
  double mass = 0, moment = 0;
  for (const BodySpec& body : lhd_.spec.bodies) {
    mass += body.mass;
    moment += body.mass * body.centre.x();
  }
  BodySpec& rear = lhd_.spec.bodies[lhd_.rear];
  rear.centre.x() += (-wheelbase * rear_axle_share * mass - moment) / rear.mass;
}

void Builder::add_motors() {
  auto& motors = lhd_.spec.motors;
  const LhdOptions& o = lhd_.options;
  const auto motor = [&](const std::vector<int>& bodies, double limit) {
    motors.push_back({lhd_.spec.bodies[bodies.front()].name + " motor", bodies, limit});
    return static_cast<int>(motors.size()) - 1;
  };
  const auto cylinders = [&](const std::vector<int>& rods, const Cylinder& cylinder) {
    const int index = motor(rods, pushing_force(cylinder, o.hydraulics.pressure));
    motors.back().max_reverse_force = pulling_force(cylinder, o.hydraulics.pressure);
    return index;
  };
  for (int k = 0; k < 4; ++k) lhd_.wheel_motors[k] = motor({lhd_.wheels[k]}, o.wheel_torque);
  if (o.arm_drive == ArmDrive::hinges) {
    lhd_.lift_motor = motor({lhd_.boom}, o.lift_torque);
    lhd_.tilt_motor = motor({lhd_.bucket}, o.tilt_torque);
    return;
  }
  lhd_.lift_motor = cylinders({lhd_.lift_rods[0], lhd_.lift_rods[1]}, o.hydraulics.lift);
  lhd_.tilt_motor = cylinders({lhd_.tilt_rod}, o.hydraulics.tilt);
}

// Strokes relative to the reference pose, and the oscillation of the rear unit.
void Builder::add_stops() {
  const double lift = (D - B).norm(), tilt = (Q - T).norm(), roll = 8 * M_PI / 180;
  lhd_.spec.stops = {
      {"lift cylinder strokes", {lhd_.lift_rods[0], lhd_.lift_rods[1]}, 1.719 - lift, 2.990 - lift},
      {"tilt cylinder stroke", {lhd_.tilt_rod}, 1.144 - tilt, 1.744 - tilt},
      {"oscillation", {lhd_.rear}, -roll, roll}};
}

void Builder::draw(int body, const std::vector<Vector3d>& points, SurfaceKind kind, bool touches,
                   const std::string& color) {
  std::vector<Vector3d> local;
  for (const Vector3d& p : points) local.push_back(p - lhd_.spec.bodies[body].centre);
  lhd_.surfaces.push_back({body, ConvexPolyhedron::hull_of(local), kind, touches, color});
}

void Builder::draw_bar(int body, const Vector3d& from, const Vector3d& to, double width, double height,
                       bool touches, const std::string& color) {
  const Vector3d up = (to - from).normalized().cross(-Vector3d::UnitY()) * (height / 2);
  std::vector<Vector3d> points;
  for (const Vector3d& end : {from, to})
    for (double y : {-width / 2, width / 2})
      for (double s : {-1.0, 1.0}) points.push_back(end + Vector3d(0, y, 0) + s * up);
  draw(body, points, SurfaceKind::steel, touches, color);
}

void Builder::draw_box(int body, const Vector3d& low, const Vector3d& high, bool touches,
                       const std::string& color) {
  std::vector<Vector3d> points;
  for (int corner = 0; corner < 8; ++corner)
    points.emplace_back(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                        corner & 4 ? high.z() : low.z());
  draw(body, points, SurfaceKind::steel, touches, color);
}

void Builder::add_chassis_surfaces() {
  draw_box(lhd_.front, {-2.1, -0.62, 0.55}, {0.55, 0.62, 1.95}, true, "#d9a21b");
  draw_box(lhd_.rear, {-8.2, -1.45, 0.75}, {-6.0, 1.45, 1.9}, true, "#d9a21b");
  draw_box(lhd_.rear, {-6.0, -0.62, 0.6}, {-2.6, 0.62, 1.9}, true, "#d9a21b");
  draw_box(lhd_.rear, {-4.6, 0.62, 1.95}, {-3.2, 1.45, 2.9}, true, "#3a3f47");
  for (int wheel : lhd_.wheels)
    lhd_.surfaces.push_back(
        {wheel, engine::Cylinder{lhd_.tyre_radius, tyre_half_width}, SurfaceKind::tyre, true, "#2a2a2c"});
}

// Plates of the shell, outside the profile but for the floor, whose front edge is a wedge. Two side
// walls, inside the width, close it.
void Builder::add_bucket_surfaces() {
  const double half = lhd_.bucket_width / 2, thickness = plate_thickness;
  const auto& profile = lhd_.bucket_profile;
  const std::size_t n = profile.size();
  for (std::size_t k = 1; k < n; ++k) {
    const Vector2d a = profile[k], b = profile[(k + 1) % n];
    const Vector2d along = (b - a).normalized(), outward(along.y(), -along.x());
    const bool floor = k + 1 == n;
    // The floor lies inside the profile so that its underside is the flat z = 0, and thins to the cutting
    // edge.
    const Vector2d offset = floor ? Vector2d(-outward * thickness) : Vector2d(outward * thickness);
    const bool heel =
        k + 2 == n;  // the plate that ends at the floor thickens backward only, nothing hangs below z = 0
    const Vector2d end_offset = floor ? Vector2d(offset * 0.25) : heel ? Vector2d(-thickness, 0) : offset;
    std::vector<Vector3d> points;
    for (double y : {-half, half}) {
      for (const Vector2d& p : {a, b, Vector2d(a + offset), Vector2d(b + end_offset)})
        points.emplace_back(p.x(), y, p.y());
    }
    draw(lhd_.bucket, points, SurfaceKind::steel, true, "#8d8f94");
  }
  for (double side : {-1.0, 1.0}) {
    std::vector<Vector3d> points;
    for (const Vector2d& p : profile)
      for (double y : {half - thickness, half}) points.emplace_back(p.x(), side * y, p.y());
    draw(lhd_.bucket, points, SurfaceKind::steel, true, "#8d8f94");
  }
}

void Builder::add_arm_surfaces() {
  draw_bar(lhd_.boom, F, G, 0.5, 0.45, true, "#e0b040");
  draw_bar(lhd_.bell_crank, P, Q, 0.3, 0.28, true, "#c58f12");
  draw_bar(lhd_.link, P, H, 0.25, 0.18, true, "#b07f10");
  const auto cylinder = [&](int barrel, int rod, const Vector3d& from, const Vector3d& to) {
    const Vector3d middle = from + 0.62 * (to - from);
    draw_bar(barrel, from, middle, 0.24, 0.24, false, "#4a4e55");
    draw_bar(rod, from + 0.3 * (to - from), to, 0.12, 0.12, false, "#d8dce2");
  };
  cylinder(lhd_.tilt_barrel, lhd_.tilt_rod, T, Q);
  for (int k = 0; k < 2; ++k) {
    const Vector3d side(0, k == 0 ? lift_side : -lift_side, 0);
    cylinder(lhd_.lift_barrels[k], lhd_.lift_rods[k], B + side, D + side);
  }
}

bool inside_polygon(const std::vector<Vector2d>& polygon, const Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      inside = !inside;
  }
  return inside;
}

}  // namespace

ArmDrive arm_drive_named(const std::string& name) {
  if (name == "cylinders") return ArmDrive::cylinders;
  if (name == "hinges") return ArmDrive::hinges;
  throw std::invalid_argument("loading::arm_drive_named: there is no drive of the arm \"" + name +
                              "\"; choose cylinders or hinges");
}

Lhd sandvik_lh621(const LhdOptions& options) { return Builder(options).build(); }

std::vector<Vector2d> heaped_profile(const Lhd& lhd) { return heaped(lhd.bucket_profile); }

bool in_heaped_bucket(const Lhd& lhd, const Vector3d& p_M) {
  return std::abs(p_M.y()) <= lhd.bucket_width / 2 && inside_polygon(heaped_profile(lhd), {p_M.x(), p_M.z()});
}

}  // namespace drawpoint::engine::loading
