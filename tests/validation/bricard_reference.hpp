// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>

/// Bricard's mechanism of six edges of a unit cube, solved without a multibody code.
///
/// A turn by 120 deg about the cube's diagonal maps the linkage on to itself, two edges on, and its motion
/// keeps that symmetry: hinges 0, 2, 4 turn by a and 1, 3, 5 by b from the cube, each about (edge before) ×
/// (edge after). The loop then closes for (1 − sin a)(1 − sin b) = 1 (a trihedral Bricard linkage with
/// right-angle twists; the test checks the closure). Along that curve, d(a, b)/ds = (cos b (1 − sin a), −cos
/// a (1 − sin b)), the rods have the kinetic energy ½ M s'² and the potential V, so s'' = −(V' + ½ M' s'²)/M,
/// integrated by the classical Runge-Kutta rule; M', V' by central differences of fourth order. Edge 5 is the
/// ground.
namespace drawpoint::validation {

using Eigen::Vector3d;

inline std::array<Vector3d, 6> bricard_corners() {
  return {Vector3d(0, 0, 0),  Vector3d(1, 0, 0),  Vector3d(1, -1, 0),
          Vector3d(1, -1, 1), Vector3d(0, -1, 1), Vector3d(0, 0, 1)};
}

inline Vector3d bricard_edge(int k) { return bricard_corners()[(k + 1) % 6] - bricard_corners()[k % 6]; }

inline Vector3d bricard_axis(int k) { return bricard_edge(k + 5).cross(bricard_edge(k)); }

class BricardReference {
 public:
  /// Slender rods of 1 kg with `twist` times the transverse moment about themselves; from rest at the cube.
  BricardReference(const Vector3d& gravity, double twist) : gravity_(gravity), twist_(twist) {}

  void advance(double dt) {
    const State k1 = rate(state_), k2 = rate(state_ + 0.5 * dt * k1), k3 = rate(state_ + 0.5 * dt * k2),
                k4 = rate(state_ + dt * k3);
    state_ += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }

  double energy() const {
    const Mechanics m = mechanics(state_[0], state_[1]);
    return 0.5 * m.mass * state_[2] * state_[2] + m.potential;
  }
  double first_angle() const { return state_[0]; }
  Vector3d corner(int k) const { return mechanics(state_[0], state_[1]).corners[k]; }
  /// Distance by which the open chain misses the ground's hinge.
  double closure() const { return (corner(5) - bricard_corners()[5]).norm(); }

 private:
  using State = Vector3d;  // a, b, s'
  struct Mechanics {
    double mass = 0, potential = 0;
    std::array<Vector3d, 6> corners;
  };

  static Eigen::Vector2d tangent(double a, double b) {
    return {std::cos(b) * (1 - std::sin(a)), -std::cos(a) * (1 - std::sin(b))};
  }

  Mechanics mechanics(double a, double b) const {
    const Eigen::Vector2d t = tangent(a, b);
    Mechanics m;
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Vector3d p = Vector3d::Zero(), v = Vector3d::Zero(), w = Vector3d::Zero();
    m.corners[0] = p;
    for (int k = 0; k < 5; ++k) {
      w += R * bricard_axis(k) * t[k % 2];
      R = R * Eigen::AngleAxisd(k % 2 ? b : a, bricard_axis(k)).toRotationMatrix();
      const Vector3d rod = R * bricard_edge(k), centre_velocity = v + w.cross(rod) / 2;
      m.mass +=
          centre_velocity.squaredNorm() + (w.squaredNorm() - (1 - twist_) * std::pow(w.dot(rod), 2)) / 12;
      m.potential -= gravity_.dot(p + rod / 2);
      p += rod;
      v += w.cross(rod);
      m.corners[k + 1] = p;
    }
    return m;
  }

  State rate(const State& y) const {
    const Eigen::Vector2d t = tangent(y[0], y[1]);
    constexpr double e = 1e-3;
    const auto at = [&](double s) { return mechanics(y[0] + s * t[0], y[1] + s * t[1]); };
    const Mechanics m = at(0), p1 = at(e), n1 = at(-e), p2 = at(2 * e), n2 = at(-2 * e);
    const double mass_slope = (8 * (p1.mass - n1.mass) - (p2.mass - n2.mass)) / (12 * e);
    const double potential_slope =
        (8 * (p1.potential - n1.potential) - (p2.potential - n2.potential)) / (12 * e);
    return {t[0] * y[2], t[1] * y[2], -(potential_slope + 0.5 * mass_slope * y[2] * y[2]) / m.mass};
  }

  Vector3d gravity_;
  double twist_;
  State state_ = State::Zero();
};

}  // namespace drawpoint::validation
