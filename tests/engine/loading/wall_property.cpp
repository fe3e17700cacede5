// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The loader driven into a wall with all it has: wheels, lift and tilt at their limits against something that
// does not give.
#include <gtest/gtest.h>

#include <drawpoint/engine/loading/drift.hpp>
#include <drawpoint/engine/loading/lhd_driver.hpp>

using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;
using Eigen::Vector3d;

namespace {

// 56.8 t at 1.4 m/s meets the wall 0.3 m ahead of the cutting edge and keeps driving, lifting and curling for
// 3 s. Overlap: a rigid stop of the approach within the step by the impact law; then all thrust, at most the
// wheels' grip mu m g = 0.6 * 557 kN = 334 kN, and the cylinders' share against the wall, together below 1
// MN, on one point of 1e8 N/m: 10 mm. Loops, limits and finiteness as everywhere.
TEST(Wall, StopsTheLoaderAtFullForce) {
  Lhd lhd = sandvik_lh621({});
  machine::Machine machine(lhd.spec);
  World world({}, material_table(calibrated_materials()));
  LhdDriver driver(lhd, machine);
  const auto terrain = static_cast<int>(SurfaceKind::terrain);
  world.add_static(std::make_shared<const Shape>(HalfSpace{Vector3d::UnitZ(), 0}),
                   Eigen::Isometry3d::Identity(), terrain);
  driver.place(0, 0);
  const double face = lhd.K.x() + 1.0;
  world.add_static(std::make_shared<const Shape>(box({0.05, 5, 5})),
                   Eigen::Isometry3d(Eigen::Translation3d(face + 0.05, 0, 0)), terrain);
  world.attach(&machine);
  for (const LhdSurface& s : lhd.surfaces)
    if (s.touches)
      world.add_part_shape(s.body, std::make_shared<const Shape>(s.shape), Eigen::Isometry3d::Identity(),
                           static_cast<int>(s.kind));
  const auto stand = [&](double seconds) {
    for (double t = 0; t < seconds; t += world.options().step) world.step();
  };
  stand(0.5);
  double deepest = 0, fastest = 0, touched = 0;
  for (double t = 0; t < 4; t += world.options().step) {
    driver.command({1.4, t > 1.5 ? 0.2 : 0.0, t > 1.5 ? 0.4 : 0.0});
    world.step();
    for (const auto& pair : world.problem().pairs)
      for (int k = pair.first; k < pair.first + pair.count; ++k) {
        const auto& p = world.problem().points[static_cast<std::size_t>(k)];
        if (std::abs(p.normal.x()) < 0.9 || p.gap > 0) continue;
        deepest = std::max(deepest, -p.gap);
        touched = std::max(touched, std::abs(p.impulse.x()) / world.options().step);
      }
    const MachineReading reading = driver.read();
    ASSERT_TRUE(reading.front_axle.allFinite());
    ASSERT_LT(reading.tip.x, face + 0.02) << "at t = " << world.time();
    ASSERT_LT(machine.loop_error(), 1e-9);
    fastest = std::max(fastest, machine.point_velocity(lhd.bucket, lhd.K).norm());
    ASSERT_TRUE(std::isfinite(driver.lift_force()) && std::isfinite(driver.tilt_force()));
    ASSERT_TRUE(machine.joint_wrench(lhd.bucket).force.allFinite());
  }
  EXPECT_GT(touched, 50e3) << "the bucket must press on the wall";
  EXPECT_LT(deepest, 0.01);
  // All kinetic energy of the 57 t machine at 1.4 m/s in the bucket's 4.8 t.
  EXPECT_LT(fastest, 1.4 * std::sqrt(57.0 / 4.8));
  EXPECT_NEAR(driver.read().front_axle.y(), 0, 0.05);
}

}  // namespace
