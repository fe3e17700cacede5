// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <drawpoint/tests/support/rocks.hpp>

using namespace drawpoint;
using engine::World;

namespace {

// A hundred rocks fallen together for a second: all velocities.
std::vector<Eigen::Vector3d> falls_together() {
  World world({}, support::one_material({0.9, 0.5, 1e9, 0, 0.5}));
  support::add_floor(world);
  for (int k = 0; k < 100; ++k)
    world.add_rock(support::rock_body(k % 6, 0.4),
                   support::at(0.4 * (k % 5), 0.4 * (k / 5 % 5), 0.3 + 0.5 * (k / 25)));
  for (int step = 0; step < 100; ++step) world.step();
  std::vector<Eigen::Vector3d> velocities;
  for (const auto& rock : world.rocks()) velocities.push_back(rock.velocity);
  return velocities;
}

std::vector<Eigen::Vector3d> with_target(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  const auto velocities = falls_together();
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return velocities;
}

}  // namespace

// Every instruction set that this machine has gives the same bits: kernels use the same sixteen logical
// lanes and no fused multiply-add, and division and square root are correctly rounded everywhere.
TEST(Simd, EveryInstructionSetGivesTheSameBits) {
  const std::vector<Eigen::Vector3d> expected = falls_together();
  std::int64_t left = hwy::SupportedTargets();
  int sets = 0;
  for (; left != 0; left &= left - 1, ++sets) {
    const std::int64_t target = left & -left;
    EXPECT_EQ(with_target(target), expected) << hwy::TargetName(target);
  }
  EXPECT_GE(sets, 1);
}
