// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/arm_linkage.hpp>

namespace drawpoint::engine::loading {
namespace {

using Eigen::Vector2d;

Vector2d turned(const Vector2d& v, double angle) { return Eigen::Rotation2Dd(angle) * v; }
Vector2d across(const Vector2d& v) { return {-v.y(), v.x()}; }
double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
double elevation_of(const Vector2d& v) { return std::atan2(v.y(), v.x()); }

// Where rods of these lengths from A and B meet, on the side of AB that `side` tells by its sign.
Vector2d meeting(const Vector2d& A, double from_A, const Vector2d& B, double from_B, double side) {
  const double apart = (B - A).norm(),
               along = (from_A * from_A - from_B * from_B + apart * apart) / (2 * apart);
  const Vector2d u = (B - A) / apart;
  return A + along * u + std::copysign(std::sqrt(from_A * from_A - along * along), side) * across(u);
}

}  // namespace

double tilt_lever(const ArmLinkage& l, double a, double phi) {
  const double boom = a - elevation_of(l.G - l.F);
  const Vector2d G = l.F + turned(l.G - l.F, boom), E = l.F + turned(l.E - l.F, boom),
                 H = G + turned(l.H - l.G, phi);
  const Vector2d P = meeting(E, (l.P - l.E).norm(), H, (l.P - l.H).norm(), cross(l.H - l.E, l.P - l.E));
  const Vector2d Q = E + turned(l.Q - l.E, elevation_of(P - E) - elevation_of(l.P - l.E));
  const double crank = across(H - G).dot(P - H) / across(P - E).dot(P - H);
  return crank * across(Q - E).dot((Q - l.T).normalized());
}

// |G − axle| is a function of the boom's angle alone, and falls with it all the way between the lift's stops.
ArmAngles arm_angles(const ArmLinkage& l, const Vector2d& G, const Vector2d& axle, double axle_height,
                     double bucket_angle) {
  const Vector2d f = l.F - Vector2d(0, axle_height), d = G - axle;
  const double boom = (l.G - l.F).norm();
  const double cosine = (d.squaredNorm() - f.squaredNorm() - boom * boom) / (2 * boom * f.norm());
  ArmAngles angles;
  angles.a = elevation_of(f) - std::acos(std::clamp(cosine, -1.0, 1.0));
  const double pitch =
      elevation_of(d) - elevation_of(f + boom * Vector2d(std::cos(angles.a), std::sin(angles.a)));
  angles.phi = bucket_angle - pitch;
  return angles;
}

}  // namespace drawpoint::engine::loading
