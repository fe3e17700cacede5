// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What is only drawn follows the machine's measures and hides nothing that rocks touch.
#include <drawpoint/engine/loading/machine_looks.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

// Highest |y| of a body's drawn parts in its frame.
double reach(const std::vector<DrawnPart>& parts, int body) {
  double y = 0;
  for (const DrawnPart& part : parts)
    for (const Eigen::Vector3d& v : part.shape.vertices())
      if (part.body == body) y = std::max(y, std::abs(v.y()));
  return y;
}

TEST(MachineLooks, EverythingThatTouchesIsDrawnAsItIs) {
  for (const LhdSurface& surface : sandvik_lh621().surfaces)
    EXPECT_TRUE(is_drawn_as_it_is(surface) || !surface.touches);
}

TEST(MachineLooks, EachPartIsABodyOfTheMachine) {
  const Lhd lhd = sandvik_lh621();
  const auto parts = machine_looks(lhd);
  for (const DrawnPart& part : parts) {
    ASSERT_GE(part.body, 0);
    ASSERT_LT(static_cast<std::size_t>(part.body), lhd.spec.bodies.size());
    EXPECT_GT(part.shape.volume(), 0);
    EXPECT_EQ(part.color.size(), 7u);
  }
  const auto is_drawn = [&](int body) {
    return std::any_of(parts.begin(), parts.end(), [&](const DrawnPart& p) { return p.body == body; });
  };
  for (const LhdSurface& surface : lhd.surfaces)
    EXPECT_TRUE(is_drawn_as_it_is(surface) || is_drawn(surface.body)) << "a cylinder is gone";
}

TEST(MachineLooks, RimsLieOnTheTyres) {
  const Lhd lhd = sandvik_lh621();
  const auto parts = machine_looks(lhd);
  for (const LhdSurface& surface : lhd.surfaces) {
    const auto* tyre = std::get_if<engine::Cylinder>(&surface.shape);
    if (!tyre) continue;
    EXPECT_GT(reach(parts, surface.body), tyre->half_width);
    EXPECT_LT(reach(parts, surface.body), tyre->half_width + 0.1);
  }
}

TEST(MachineLooks, TeethStandOnAnyCuttingEdge) {
  LhdOptions options;
  for (const double width : {2.4, 3.2}) {
    options.bucket.width = width;
    const Lhd lhd = sandvik_lh621(options);
    const auto parts = machine_looks(lhd);
    const double y = reach(parts, lhd.bucket);
    EXPECT_LT(y, lhd.bucket_width / 2);
    EXPECT_GT(y, lhd.bucket_width / 2 - 0.2);
    const Eigen::Vector3d edge = lhd.K - lhd.spec.bodies[static_cast<std::size_t>(lhd.bucket)].centre;
    for (const DrawnPart& part : parts) {
      if (part.body != lhd.bucket) continue;
      for (const Eigen::Vector3d& v : part.shape.vertices()) EXPECT_LT(v.x() - edge.x(), 0.0601);
    }
  }
}

}  // namespace
