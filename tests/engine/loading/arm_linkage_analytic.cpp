// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The tilt cylinder's lever against the machine's own constraints, and against the force that its link puts on the
// bucket.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/arm_linkage.hpp>
#include <drawpoint/engine/loading/lhd_driver.hpp>
#include <drawpoint/engine/loading/log/hinge_torque.hpp>
#include <drawpoint/engine/loading/log/responses.hpp>

using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

struct Arm {
  Lhd lhd = sandvik_lh621();
  machine::Machine machine{lhd.spec};

  double boom_elevation() const {
    const Eigen::Vector3d d = machine.point(lhd.boom, lhd.G) - machine.point(lhd.boom, lhd.F);
    return std::atan2(d.z(), d.x());
  }
  double bucket_angle() const {
    const Eigen::Vector3d d = machine.point(lhd.bucket, lhd.K) - machine.point(lhd.bucket, lhd.G);
    const Eigen::Vector3d from = lhd.K - lhd.G;
    return std::atan2(d.z(), d.x()) - std::atan2(from.z(), from.x());
  }
  double lever() const {
    const std::vector<int> outside = {lhd.rear, lhd.wheels[0], lhd.wheels[1], lhd.wheels[2], lhd.wheels[3]};
    return machine.transmission({lhd.tilt_rod}, {lhd.boom, lhd.bucket}, outside)(0, 1);
  }
};

}  // namespace

// d(phi)/d(tilt length) is 1.306 rad/m in the reference pose.
TEST(ArmLinkage, LeverInTheReferencePose) {
  const ArmLinkage pins;
  const double a = std::atan2(pins.G.y() - pins.F.y(), pins.G.x() - pins.F.x());
  EXPECT_NEAR(tilt_lever(pins, a, 0), 1 / 1.306, 5e-4);
}

// All over the arm's reach the closed form is the constraints' own factor: loops are closed to 1e-9 m, levers are a
// metre.
TEST(ArmLinkage, LeverIsThatOfTheMachinesConstraints) {
  Arm arm;
  arm.machine.place(Eigen::Isometry3d::Identity());
  for (const double boom : {0.0, 0.3, 0.8, 1.2})
    for (const double tilt : {0.0, 0.3, 0.6}) {
      arm.machine.set_coordinate(arm.lhd.boom, boom);
      arm.machine.set_coordinate(arm.lhd.bucket, tilt);
      const double a = arm.boom_elevation(), phi = arm.bucket_angle();
      EXPECT_NEAR(tilt_lever({}, a, phi), arm.lever(), 1e-7) << boom << " " << tilt;
    }
}

// Angles of the arm come back from points in the world, however the frame stands and pitches.
TEST(ArmLinkage, AnglesComeFromWorldPoints) {
  Arm arm;
  for (const double pitch : {-0.1, 0.0, 0.07})
    for (const double boom : {0.0, 0.5, 1.2}) {
      const Eigen::Isometry3d X =
          Eigen::Translation3d(4, 0, 0.1) * Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitY());
      arm.machine.place(X);
      arm.machine.set_coordinate(arm.lhd.boom, boom);
      const Eigen::Vector3d G = arm.machine.point(arm.lhd.bucket, arm.lhd.G),
                            axle = arm.machine.point(arm.lhd.front, {0, 0, arm.lhd.loaded_radius});
      const ArmAngles angles =
          arm_angles({}, {G.x(), G.z()}, {axle.x(), axle.z()}, arm.lhd.loaded_radius, arm.bucket_angle());
      EXPECT_NEAR(angles.a, arm.boom_elevation() - pitch, 1e-9);
      EXPECT_NEAR(angles.phi, arm.bucket_angle() - pitch, 1e-9);
    }
}

// A bucket that hangs still, 21 t pulling down 0.9 m ahead of G: the tilt drive holds 185 kN m and the bucket's own
// weight. The link's moment about G, from the machine's reactions, is the drive's but for weight and inertia of
// bell-crank, link and the halves of the cylinder, 1.6 t at levers below 1 m: 16 kN m.
TEST(ArmLinkage, TheHingeTakesTheTiltDrivesMoment) {
  Arm arm;
  World world({}, material_table(calibrated_materials()));
  LhdDriver driver(arm.lhd, arm.machine);
  driver.settle_alone(world.options(), calibrated_materials());
  world.add_static(std::make_shared<const Shape>(HalfSpace{Eigen::Vector3d::UnitZ(), 0}),
                   Eigen::Isometry3d::Identity(), static_cast<int>(SurfaceKind::terrain));
  add_machine(world, arm.lhd, arm.machine);
  driver.place_standing(0, 0);
  LoadingLog log;
  log.signals.columns = {{"time", "s"},
                         {"hinge_G_torque_x", "N m"},
                         {"hinge_G_torque_y", "N m"},
                         {"hinge_G_torque_z", "N m"},
                         {"tip_x", "m"},
                         {"tip_z", "m"},
                         {"bucket_angle", "rad"},
                         {"axle_x", "m"},
                         {"axle_z", "m"},
                         {"tilt_force", "N"}};
  const double weight = 21e3 * 9.81, ahead = 0.9;
  for (int k = 0; k < 200; ++k) {
    driver.command({.boom = k < 100 ? 0.3 : 0.0});
    if (k >= 100) arm.machine.add_force(arm.lhd.bucket, {.moment = {0, weight * ahead, 0}});
    world.step();
  }
  const MachineReading m = driver.read();
  const Wrench w = arm.machine.joint_wrench(arm.lhd.bucket);
  log.signals.append_row(std::vector<double>{world.time(), w.moment.x(), w.moment.y(), w.moment.z(), m.tip.x,
                                             m.tip.z, m.tip.phi, m.front_axle.x(), m.front_axle.z(),
                                             driver.tilt_force()});
  int pin = -1;
  for (std::size_t k = 0; k < arm.lhd.spec.loops.size(); ++k)
    if (arm.lhd.spec.loops[k].name == "link pin") pin = static_cast<int>(k);
  ASSERT_GE(pin, 0);
  const ArmLinkage pins;
  const Eigen::Vector3d H = arm.machine.point(arm.lhd.bucket, {pins.H.x(), 0, pins.H.y()}),
                        G = arm.machine.point(arm.lhd.bucket, arm.lhd.G);
  const double by_link = (H - G).cross(arm.machine.loop_force(pin)).y();
  const double torque = HingeTorque(log).at(0).y();
  EXPECT_NEAR(std::abs(torque), std::abs(by_link), 16e3);
  EXPECT_GT(std::abs(torque), weight * ahead - 16e3);
  EXPECT_LT(std::abs(w.moment.y()), 1.0) << "the pin alone bears no moment";
}
