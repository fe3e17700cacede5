// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/geometry/mass_properties.hpp>
#include <drawpoint/engine/granular/rock_shapes.hpp>

using drawpoint::engine::ConvexPolyhedron;
using drawpoint::engine::mass_properties;
using drawpoint::engine::granular::rock_shapes;

TEST(RockShapes, StandInTheirPrincipalFrameWithUnitLength) {
  for (const ConvexPolyhedron& rock : rock_shapes()) {
    const auto m = mass_properties(rock, 1000);
    // Round-off of a rotation, a shift and a scaling of coordinates below 1.
    EXPECT_NEAR(rock.length(), 1, 1e-14);
    EXPECT_LT(m.centre.norm(), 1e-14);
    const Eigen::Matrix3d off = m.inertia - Eigen::Matrix3d(m.inertia.diagonal().asDiagonal());
    EXPECT_LT(off.norm(), 1e-13 * m.inertia.norm());
    EXPECT_LT(m.inertia(0, 0), m.inertia(1, 1));
    EXPECT_LT(m.inertia(1, 1), m.inertia(2, 2));
  }
}

// Piles that are stored name their shapes by number. Those of other shapes say so with this checksum, which the
// ones from before do not: whoever changes a shape changes the number here, and old piles are refused.
TEST(RockShapes, AreThoseThatStoredPilesHave) {
  EXPECT_EQ(drawpoint::engine::granular::rock_shapes_checksum(), 0x19b8448b9a203462u);
}

TEST(RockShapes, HaveTheProportionsOfBlastedRock) {
  for (const ConvexPolyhedron& rock : rock_shapes()) {
    Eigen::AlignedBox3d bounds;
    for (const auto& p : rock.vertices()) bounds.extend(p);
    const Eigen::Vector3d extent = bounds.sizes();
    EXPECT_GE(extent.y() / extent.x(), 0.6);
    EXPECT_LE(extent.y() / extent.x(), 0.9);
    EXPECT_GE(extent.z() / extent.x(), 0.5);
    EXPECT_LE(extent.z() / extent.x(), 0.85);
    EXPECT_GE(rock.vertices().size(), 12u);
    EXPECT_LE(rock.vertices().size(), 20u);
    EXPECT_GT(rock.volume(), 0.15);
  }
}

TEST(RockShapes, AreSixDifferentOnes) {
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i + 1; j < 6; ++j)
      EXPECT_GT(std::abs(rock_shapes()[i].volume() - rock_shapes()[j].volume()), 1e-3);
}
