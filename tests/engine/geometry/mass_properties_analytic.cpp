// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/geometry/mass_properties.hpp>
#include <numbers>
#include <random>

using drawpoint::engine::box;
using drawpoint::engine::ConvexPolyhedron;
using drawpoint::engine::mass_properties;
using drawpoint::engine::prism;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Sums of some ten to two hundred products of round-off 1e-16 each: relative errors below 200 x 1e-16 =
// 2e-14.
constexpr double round_off = 2e-14;

TEST(MassProperties, OfABox) {
  const auto m = mass_properties(box({0.5, 1, 1.5}), 2000);  // sides 1, 2, 3
  EXPECT_NEAR(m.mass, 12000, 12000 * round_off);
  EXPECT_LT(m.centre.norm(), round_off);
  const Matrix3d exact = Vector3d(4 + 9, 1 + 9, 1 + 4).asDiagonal() * 1000.0;  // m (b² + c²)/12
  EXPECT_LT((m.inertia - exact).norm(), exact.norm() * round_off);
}

TEST(MassProperties, OfATetrahedron) {
  // Legs of 1 along the axes: V = 1/6, centre (1,1,1)/4, ∫x² = 1/60, ∫xy = 1/120 about the corner.
  const std::vector<Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto m = mass_properties(ConvexPolyhedron::hull_of(corners), 6);
  EXPECT_NEAR(m.mass, 1, round_off);
  EXPECT_LT((m.centre - Vector3d::Constant(0.25)).norm(), round_off);
  const double square = 6.0 / 60 - 1.0 / 16, product = 6.0 / 120 - 1.0 / 16;  // about the centre
  const Matrix3d exact = (2 * square + product) * Matrix3d::Identity() - product * Matrix3d::Ones();
  EXPECT_LT((m.inertia - exact).norm(), round_off);
}

TEST(MassProperties, OfAPrism) {
  // Regular n-gon of circumradius R: A = n R² sin(2π/n)/2, polar second moment A R² (2 + cos(2π/n))/6.
  for (int n : {3, 6, 48}) {
    const double R = 0.9, half = 0.35, angle = 2 * std::numbers::pi / n;
    const double area = 0.5 * n * R * R * std::sin(angle), polar = area * R * R * (2 + std::cos(angle)) / 6;
    const auto m = mass_properties(prism(R, half, n), 1000);
    const double axial = 1000 * 2 * half * polar, across = axial / 2 + m.mass * half * half / 3;
    EXPECT_NEAR(m.mass, 2000 * half * area, m.mass * round_off);
    EXPECT_LT((m.inertia - Matrix3d(Vector3d(across, axial, across).asDiagonal())).norm(),
              10 * axial * round_off);
  }
}

TEST(MassProperties, MoveWithTheShape) {
  const std::vector<Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0.3, 0.2, 1}, {1, 1.5, 0.8}};
  const auto shape = ConvexPolyhedron::hull_of(corners);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(1.1, Vector3d(3, -1, 2).normalized()).toRotationMatrix();
  pose.translation() << 100, -50, 20;
  const auto before = mass_properties(shape, 4500), after = mass_properties(shape.transformed(pose), 4500);
  // Coordinates near 100 carry errors of 1e-14, relative to a size of 1.
  EXPECT_NEAR(after.mass, before.mass, before.mass * 1e-12);
  EXPECT_LT((after.centre - pose * before.centre).norm(), 1e-12);
  EXPECT_LT((after.inertia - pose.linear() * before.inertia * pose.linear().transpose()).norm(),
            before.inertia.norm() * 1e-12);
}

TEST(MassProperties, RefuseADensityThatIsNone) {
  EXPECT_THROW(mass_properties(box({1, 1, 1}), 0), std::invalid_argument);
  EXPECT_THROW(mass_properties(box({1, 1, 1}), std::nan("")), std::invalid_argument);
}

// The axes of hulls of twenty random points go by rising moment and are right-handed, the largest component of
// the first two is positive, and there are no products of inertia but for the round-off of an eigenvalue
// problem, some 1e-15 of the moments.
TEST(MassProperties, PrincipalAxesAreThoseOfTheText) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Vector3d> points(20);
    for (Vector3d& p : points) p = {coordinate(random), 0.6 * coordinate(random), 0.3 * coordinate(random)};
    const auto m = mass_properties(ConvexPolyhedron::hull_of(points), 2500);
    const Eigen::Isometry3d frame = drawpoint::engine::principal_frame(m);
    const Matrix3d R = frame.linear(), along = R.transpose() * m.inertia * R;
    EXPECT_EQ(frame.translation(), m.centre);
    EXPECT_LT((along - Matrix3d(along.diagonal().asDiagonal())).norm(), 1e-14 * along.norm());
    EXPECT_LE(along(0, 0), along(1, 1));
    EXPECT_LE(along(1, 1), along(2, 2));
    EXPECT_NEAR(R.determinant(), 1, 1e-14);
    for (int k : {0, 1}) {
      const Vector3d axis = R.col(k);
      Eigen::Index largest;
      axis.cwiseAbs().maxCoeff(&largest);
      EXPECT_GT(axis[largest], 0) << "trial " << trial << ", axis " << k;
    }
  }
}
