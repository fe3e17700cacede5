// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <drawpoint/tests/support/exact_contact.hpp>
#include <random>
#include <vector>

/// Pairs of polyhedra that meet feature on feature: a face, an edge or a corner of one on a face, an edge or
/// a corner of the other, squarely or tilted by anything from a millionth to a third of a radian, at gaps
/// that crowd around touching and around the margin of the search.
namespace drawpoint::support {

/// A feature seen from its shape: a point of it, and a direction in which no point of the shape is higher.
struct Feature {
  Vector3d point, direction;
};

class FeaturePairs {
 public:
  FeaturePairs(unsigned seed, double margin) : rng_(seed), margin_(margin) {}

  /// A face, an edge or a corner, a third each.
  Feature feature(const ConvexPolyhedron& shape) {
    const auto& faces = shape.faces();
    const std::size_t f = rng_() % faces.size(), corner = rng_() % faces[f].size();
    const int from = faces[f][corner], to = faces[f][(corner + 1) % faces[f].size()];
    std::vector<int> vertices;
    switch (rng_() % 3) {
      case 0:
        vertices = faces[f];
        break;
      case 1:
        vertices = {from, to};
        break;
      default:
        vertices = {from};
    }
    Feature result{Vector3d::Zero(), Vector3d::Zero()};
    double sum = 0;
    for (int v : vertices) {
      const double share = uniform(0.05, 1);
      result.point += share * shape.vertices()[v], sum += share;
    }
    result.point /= sum;
    for (std::size_t g = 0; g < faces.size(); ++g) {
      std::size_t shared = 0;
      for (int v : vertices) shared += std::count(faces[g].begin(), faces[g].end(), v);
      if (shared == vertices.size()) result.direction += uniform(0.01, 1) * shape.face_normals()[g];
    }
    result.direction.normalize();
    return result;
  }

  double gap() {
    switch (rng_() % 5) {
      case 0:
        return uniform(-1e-4, 1e-4);
      case 1:
        return margin_ + uniform(-1e-4, 1e-4);
      case 2:
        return uniform(0, 1.2 * margin_);
      default:
        return uniform(-0.06, 0);
    }
  }

  double tilt() {
    switch (rng_() % 4) {
      case 0:
        return 0;
      case 1:
        return uniform(0, 1e-6);
      case 2:
        return uniform(0, 1e-3);
      default:
        return uniform(0, 0.3);
    }
  }

  /// Where B stands for A at X_WA.
  Eigen::Isometry3d place(const ConvexPolyhedron& a, const Eigen::Isometry3d& X_WA,
                          const ConvexPolyhedron& b) {
    const Feature on_a = feature(a), on_b = feature(b);
    const Vector3d n = X_WA.linear() * on_a.direction;
    Eigen::Quaterniond facing = Eigen::Quaterniond::FromTwoVectors(on_b.direction, -n);
    facing = Eigen::AngleAxisd(uniform(0, 6.28), n) * facing;
    facing = Eigen::AngleAxisd(tilt(), random_rotation(rng_) * Vector3d::UnitX()) * facing;
    Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
    X_WB.linear() = facing.normalized().toRotationMatrix();
    X_WB.translation() = X_WA * on_a.point + gap() * n - X_WB.linear() * on_b.point;
    return X_WB;
  }

  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(rng_);
  }
  std::mt19937& rng() { return rng_; }

 private:
  std::mt19937 rng_;
  double margin_;
};

}  // namespace drawpoint::support
