// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/granular/pile.hpp>
#include <drawpoint/engine/loading/drift.hpp>
#include <drawpoint/engine/loading/lhd_driver.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <drawpoint/tests/support/yard.hpp>
#include <numeric>

using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;
using drawpoint::support::Yard;
using Eigen::Vector3d;

namespace {

constexpr double degree = M_PI / 180, g = 9.81;

/// Raises the boom off the floor, so that a load on the bucket hangs on the arm, and waits for the bounce to die
/// down.
void raise_boom(Yard& yard) {
  yard.stand(1);
  yard.driver.command({0, 0.2, 0});
  yard.stand(1.5);
  yard.driver.command({});
  yard.stand(7);
}

void load_bucket(Yard& yard, double force, int steps) {
  for (int k = 0; k < steps; ++k) {
    yard.machine.add_force(yard.lhd.bucket, {Vector3d::Zero(), Vector3d(0, 0, -force)});
    yard.world.step();
  }
}

bool within(const ConvexPolyhedron& hull, const Vector3d& p) {
  for (std::size_t face = 0; face < hull.faces().size(); ++face) {
    const Vector3d& corner = hull.vertices()[static_cast<std::size_t>(hull.faces()[face].front())];
    if (hull.face_normals()[face].dot(p - corner) > 0) return false;
  }
  return true;
}

/// Of the machine's bucket, by the plates that rock touches.
bool in_a_plate(const Lhd& lhd, const Vector3d& p_M) {
  const Vector3d p = p_M - lhd.spec.bodies[static_cast<std::size_t>(lhd.bucket)].centre;
  return std::any_of(lhd.surfaces.begin(), lhd.surfaces.end(), [&](const LhdSurface& surface) {
    return surface.body == lhd.bucket && surface.touches &&
           within(std::get<ConvexPolyhedron>(surface.shape), p);
  });
}

/// Between the walls of the bucket, counted on a line 1 mm a point, 1 m up in its middle [m].
double counted_clear_width(const Lhd& lhd) {
  int clear = 0;
  for (int k = 0; k < 4000; ++k) clear += !in_a_plate(lhd, {2.6, -2 + 0.001 * (k + 0.5), 1.0});
  return 0.001 * clear - (4 - lhd.bucket_width);
}

/// Of the points of a grid in the bucket's middle plane that lie in the section and in no plate [m²].
double counted_clear_section(const Lhd& lhd, bool heaped) {
  const Vector3d edge = lhd.K, lip(lhd.bucket_profile[1].x(), 0, lhd.bucket_profile[1].y());
  const int n = 1000;
  int clear = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const Vector3d p(2.0 + 2.5 * (i + 0.5) / n, 0, 2.5 * (k + 0.5) / n);
      const bool above = (lip - edge).cross(p - edge).y() > 0;
      clear += in_heaped_bucket(lhd, p) && (heaped || !above) && !in_a_plate(lhd, p);
    }
  return clear * 6.25 / (n * n);
}

/// A rock, thrown from the middle of the standing bucket at 5 m/s, until it leaves by the mouth or for half a second.
void expect_kept_by_the_bucket(double size, const Vector3d& way) {
  Yard yard;
  yard.stand(1);
  const Vector3d centre = yard.lhd.spec.bodies[static_cast<std::size_t>(yard.lhd.bucket)].centre;
  const auto X_WM = [&] { return yard.machine.pose(yard.lhd.bucket) * Eigen::Translation3d(-centre); };
  const int rock = yard.world.add_rock(granular::RockLibrary().body({0, size}),
                                       X_WM() * Eigen::Translation3d(2.7, 0, 0.7), 5 * way);
  for (int step = 0; step < 50; ++step) {
    yard.world.step();
    const Vector3d p =
        X_WM().inverse() * yard.world.rocks()[static_cast<std::size_t>(rock)].pose.translation();
    if (p.x() > 2.95 || p.z() > 1.6) return;
    ASSERT_TRUE(std::abs(p.y()) < clear_width({}) / 2 && p.x() > 2.14 && p.z() > 0.02)
        << "a rock of " << size << " m, thrown along " << way.transpose() << ", is at " << p.transpose();
  }
}

/// Whether a rock that comes from above, left or right to the centre of a part that nothing else touches puts a
/// force on it. It starts 1 m away, and falls by 5 cm on its way.
bool is_touched(Yard& yard, int part) {
  const Vector3d centre = yard.machine.pose(part).translation();
  for (const Vector3d& side : {Vector3d(0, 0, 1), Vector3d(0, 1, 0), Vector3d(0, -1, 0)}) {
    const Eigen::Isometry3d start(Eigen::Translation3d(centre + side));
    const int rock = yard.world.add_rock(granular::RockLibrary().body({0, 0.3}), start, -10 * side);
    double force = 0;
    for (int step = 0; step < 15 && force == 0; ++step) {
      yard.world.step();
      force = yard.world.part_wrench(part).force.norm();
    }
    yard.world.remove_rock(rock);
    if (force > 0) return true;
  }
  return false;
}

}  // namespace

TEST(Lhd, WeighsWhatItsPartsWeigh) {
  const Lhd lhd = sandvik_lh621();
  double mass = 0;
  for (const auto& body : lhd.spec.bodies) mass += body.mass;
  EXPECT_EQ(lhd.spec.bodies.size(), 16u);
  EXPECT_NEAR(mass, 56800, 1e-6);
}

// Beside bucket and tyres, which carry rock and machine in every cycle. Cylinders are only drawn.
TEST(Lhd, RocksTouchItsRearBoomBellCrankAndLink) {
  Yard yard;
  yard.stand(1);
  const Lhd& lhd = yard.lhd;
  for (const int part : {lhd.front, lhd.rear, lhd.boom, lhd.bell_crank, lhd.link}) {
    EXPECT_EQ(yard.world.part_wrench(part).force.norm(), 0);
    EXPECT_TRUE(is_touched(yard, part)) << lhd.spec.bodies[static_cast<std::size_t>(part)].name;
  }
  for (const int part : {lhd.tilt_rod, lhd.lift_rods[0]}) EXPECT_FALSE(is_touched(yard, part));
}

// The bucket's stated volumes, struck and heaped 2:1; plans count in what is heaped.
TEST(Lhd, BucketHoldsWhatIsStated) {
  const Lhd lhd = sandvik_lh621();
  EXPECT_NEAR(struck_volume(lhd.options.bucket), 6.3, 0.01 * 6.3);
  EXPECT_NEAR(heaped_volume(lhd.options.bucket), 7.9, 0.01 * 7.9);
  EXPECT_EQ(lhd.bucket_volume, heaped_volume(lhd.options.bucket));
}

// Rock has these volumes between the plates that it touches. A grid of 2.5 mm counts a section of 7 m girth to
// 7 · 0.0025 / 2 = 0.009 m², 0.44 % of 2.05 m²; the wedge behind the floor's heel, 0.06 m long and 0.08 m high, is
// clear here and out of reach for any rock, 0.12 %.
TEST(Lhd, PlatesLeaveTheBucketItsVolume) {
  for (const BucketOptions& bucket : {BucketOptions{}, BucketOptions{.width = 4, .size = 1.2}}) {
    const Lhd lhd = sandvik_lh621({.bucket = bucket});
    EXPECT_NEAR(counted_clear_width(lhd), clear_width(bucket), 0.0011);
    const double width = clear_width(bucket);
    EXPECT_NEAR(counted_clear_section(lhd, false) * width, struck_volume(bucket),
                0.006 * struck_volume(bucket));
    EXPECT_NEAR(counted_clear_section(lhd, true) * width, heaped_volume(bucket),
                0.006 * heaped_volume(bucket));
  }
}

// The estimated linkage's own table: lift and tilt cylinder lengths against boom elevation, with the bucket
// level and racked by 45 deg. The table is rounded to 1 mm; its points to 1 mm too, which moves a length by
// at most 2 mm.
TEST(Lhd, CylinderLengthsFollowTheLinkageTable) {
  const Lhd lhd = sandvik_lh621();
  machine::Machine machine(lhd.spec);
  struct Row {
    double boom, lift, tilt_level, tilt_racked;
  };
  const double lift0 = 1.7584, tilt0 = std::hypot(1.12 - 0.10, 2.32 - 1.68), boom0 = -26.13;
  for (const Row& row :
       {Row{-28, 1.719, 1.215, 1.742}, Row{-10, 2.090, 1.177, 1.740}, Row{0, 2.285, 1.202, 1.728},
        Row{20, 2.635, 1.299, 1.710}, Row{46, 2.990, 1.449, 1.739}}) {
    machine.place(Eigen::Isometry3d::Identity());
    machine.set_coordinate(lhd.boom, (row.boom - boom0) * degree);
    EXPECT_NEAR(lift0 + machine.coordinate(lhd.lift_rods[0]), row.lift, 2.5e-3) << row.boom;
    // Holding the boom as well: move the bucket, then put the boom back where the projection moved it from.
    const auto tilt_length = [&](double angle) {
      for (int pass = 0; pass < 20; ++pass) {
        machine.set_coordinate(lhd.bucket, (angle - row.boom + boom0) * degree);
        machine.set_coordinate(lhd.boom, (row.boom - boom0) * degree);
      }
      return tilt0 + machine.coordinate(lhd.tilt_rod);
    };
    EXPECT_NEAR(tilt_length(0), row.tilt_level, 3e-3) << row.boom;
    EXPECT_NEAR(tilt_length(45), row.tilt_racked, 3e-3) << row.boom;
    EXPECT_LT(machine.loop_error(), 1e-9);
  }
}

// On its tyres: the axle loads are those of the mass budget, 44/56 %, up to the ~0.2 deg by which the
// softer-loaded end pitches it and the bucket's clearance. Budget: 1.5 m height of the centre times 0.004 rad
// over 4.9 m = 0.12 % of the weight; motions left after 3 s below 1e-3.
TEST(Lhd, StandsOnItsTyresWithThePublishedAxleLoads) {
  Yard yard;
  yard.stand(7);
  double front = 0, rear = 0;
  for (const auto& p : yard.world.problem().points)
    (p.position.x() > -2.45 ? front : rear) += std::abs(p.impulse.z()) / yard.world.options().step;
  const double weight = 56800 * g;
  EXPECT_NEAR(front + rear, weight, 2e-3 * weight);
  EXPECT_NEAR(front / weight, 0.44, 2e-3);
  const MachineReading reading = yard.driver.read();
  EXPECT_GT(reading.tip.z, 0);
  EXPECT_LT(reading.tip.z, 0.06);
  EXPECT_LT(yard.machine.loop_error(), 1e-9);
}

// A load L hung on the bucket changes the hinge force, the link force and the motors as statics says. About
// G: the link, a two-force member along P-H, balances the load's moment; G takes the rest. By virtual work
// each motor gives minus the load's power at unit speed of its own joint. All at the actual pose; what is
// left is unsteadiness after settling: 2e-3 of the load.
TEST(Lhd, StaticBucketLoadAppearsInHingeGAndInTheMotors) {
  Yard yard;
  const Lhd& lhd = yard.lhd;
  raise_boom(yard);
  const auto world_force = [&] {
    return Vector3d(yard.machine.pose(lhd.bucket).linear() * yard.machine.joint_wrench(lhd.bucket).force);
  };
  const Vector3d g_empty = world_force();
  const double lift_empty = yard.driver.lift_force(), tilt_empty = yard.driver.tilt_force();
  const double L = 100e3;
  load_bucket(yard, L, 1400);
  const Vector3d G = yard.machine.point(lhd.bucket, lhd.G), c = yard.machine.pose(lhd.bucket).translation();
  const Vector3d P = yard.machine.point(lhd.link, {1.18, 0, 0.63}),
                 H = yard.machine.point(lhd.link, {1.94, 0, 1.07});
  const Vector3d along = (H - P).normalized(), arm = H - G;
  const double moment = (c - G).cross(Vector3d(0, 0, -L)).y();
  const Vector3d link = along * (-moment / arm.cross(along).y());
  EXPECT_LT((world_force() - g_empty - (Vector3d(0, 0, L) - link)).norm(), 2e-2 * L);

  const std::vector<int> still = {lhd.rear, lhd.wheels[0], lhd.wheels[1], lhd.wheels[2], lhd.wheels[3]};
  const Eigen::MatrixXd S =
      yard.machine.transmission({lhd.lift_rods[0], lhd.tilt_rod}, {lhd.boom, lhd.bucket}, still);
  // Power of the load at unit boom rate (the bucket turns with the boom) and at unit tilt rate.
  const Vector3d F = yard.machine.point(lhd.boom, lhd.F);
  const Eigen::RowVector2d power(-L * (c - F).x(), -L * (c - G).x());
  const Eigen::RowVector2d forces = -power * S.inverse();
  EXPECT_NEAR(yard.driver.lift_force() - lift_empty, forces[0], 2e-2 * std::abs(forces[0]));
  EXPECT_NEAR(yard.driver.tilt_force() - tilt_empty, forces[1], 2e-2 * std::abs(forces[1]));
  // Both lift cylinders share one pressure, so the load in the middle puts nothing sideways on them: equal
  // axial forces.
  const auto axial = [&](int k) { return yard.machine.joint_wrench(lhd.lift_rods[k]).force.norm(); };
  EXPECT_NEAR(axial(0), axial(1), 1e-2 * axial(0));
  // A passive pin carries no moment about its own axis.
  EXPECT_NEAR(yard.machine.joint_wrench(lhd.bucket).moment.y(), 0, 1e-6 * L);
}

// Raised against the ends of their strokes, both lift cylinders hold the boom: the motor goes on pushing with
// what it has, both stops push back alike, and each rod carries half of the boom's load. Boom, bucket and
// linkage weigh some 110 kN at 1.2 to 3.4 m from F, against arms of 0.64 m at this end: some 400 kN in all,
// half of it in each rod. With a stop on one rod only, the other would carry its motor's 713 kN beside that,
// and the first as much less; shared, they differ by what the roll of the machine on its tyres makes of it,
// below a hundredth of the motor's force. The overrun of a millimetre is a step of 10 ms at 0.1 m/s.

TEST(Lhd, BothLiftCylindersShareTheEndOfTheirStrokes) {
  Yard yard;
  const Lhd& lhd = yard.lhd;
  yard.stand(1);
  yard.driver.command({0, 0.2, 0});
  yard.stand(9);
  const auto& stop = lhd.spec.stops.front();
  ASSERT_EQ(stop.bodies.size(), 2u);
  for (int rod : stop.bodies) EXPECT_NEAR(yard.machine.coordinate(rod), stop.upper, 1e-3);
  const auto axial = [&](int k) { return yard.machine.joint_wrench(lhd.lift_rods[k]).force.norm(); };
  EXPECT_GT(yard.driver.lift_force(), 1.9 * 713e3);
  EXPECT_LT(axial(0), 400e3);
  EXPECT_NEAR(axial(0), axial(1), 1e-2 * 713e3);
}

// With the hinge motors of Lindmark (2016) the same load's moment about G is the tilt motor's torque and the
// wrench's axial part.
TEST(Lhd, WithHingeMotorsTheTiltTorqueIsTheLoadsMoment) {
  LhdOptions options;
  options.arm_drive = ArmDrive::hinges;
  Yard yard(options);
  raise_boom(yard);
  const double tilt_empty = yard.driver.tilt_force();
  const double axial_empty = yard.machine.joint_wrench(yard.lhd.bucket).moment.y();
  const double L = 100e3;
  load_bucket(yard, L, 1400);
  const Vector3d G = yard.machine.point(yard.lhd.bucket, yard.lhd.G);
  const double lever = (yard.machine.pose(yard.lhd.bucket).translation() - G).x();
  EXPECT_NEAR(yard.driver.tilt_force() - tilt_empty, L * lever, 2e-2 * L * lever);
  EXPECT_NEAR(yard.machine.joint_wrench(yard.lhd.bucket).moment.y() - axial_empty, -L * lever,
              5e-3 * L * lever);
}

// Driving at a set speed on the level: the wheels roll without slip to within the rolling radius's 2 %.
TEST(Lhd, DrivesAtTheSetSpeed) {
  Yard yard;
  yard.stand(1);
  yard.driver.command({1.0, 0, 0});
  yard.stand(2);
  const double x = yard.driver.read().front_axle.x();
  yard.stand(2);
  EXPECT_NEAR((yard.driver.read().front_axle.x() - x) / 2, 1.0, 0.03);
  EXPECT_NEAR(yard.driver.read().front_axle.y(), 0, 1e-3);
}

TEST(HeapedBucket, HoldsTheProfileAndTheHeapOnly) {
  const Lhd lhd = sandvik_lh621();
  EXPECT_TRUE(in_heaped_bucket(lhd, {2.6, 0, 0.5}));
  EXPECT_TRUE(in_heaped_bucket(lhd, {3.5, 1.5, 0.9}));   // in the heap, just above the opening
  EXPECT_FALSE(in_heaped_bucket(lhd, {4.2, 0, 1.2}));    // beyond it
  EXPECT_FALSE(in_heaped_bucket(lhd, {2.6, 1.7, 0.5}));  // beside the side wall
  EXPECT_FALSE(in_heaped_bucket(lhd, {2.6, 0, -0.1}));   // under the floor
}

// Profile of straight pieces, by the shoelace formula 2.14915 m² with the floor, a wedge 1.45 m long and 8 to 2 cm
// high; the heap is a triangle on the opening √(0.9² + 1.85²) m long, a quarter of that high: 4.2325 / 8 m². Both
// times the 3.04 m between walls of 8 cm; round-off of some sums.
TEST(Bucket, VolumesAreClearAreasTimesTheClearWidth) {
  EXPECT_NEAR(area(bucket_profile({})), 2.14915, 1e-12);
  EXPECT_NEAR(struck_volume({}), 3.04 * (2.14915 - 0.0725), 1e-12);
  EXPECT_NEAR(heaped_volume({}), 3.04 * (2.14915 - 0.0725 + 4.2325 / 8), 1e-12);
}

// Round-off of some sums.
TEST(Bucket, HoldsWhatIsAskedAtAnyWidth) {
  for (const double width : {3.1, 3.2, 4.0}) {
    const Lhd lhd = sandvik_lh621({.bucket = bucket_of(width, 11)});
    EXPECT_EQ(lhd.bucket_width, width);
    EXPECT_NEAR(heaped_volume(lhd.options.bucket), 11, 1e-12);
    EXPECT_EQ(lhd.K.z(), 0);
  }
  EXPECT_NEAR(bucket_of(3.2, heaped_volume({})).size, 1, 1e-15);
}

// Side walls of two sections, and five plates of the girth's length without the open side, each of the bucket's
// width: 3.2 m of width more add as much plate as one girth times 3.2 m, whatever the size.
TEST(Bucket, WeighsAsItsPlates) {
  EXPECT_EQ(bucket_mass({}), 4800);
  const double girth = std::hypot(0.65, 0.17) + std::hypot(0.16, 0.53) + std::hypot(0.02, 0.80) +
                       std::hypot(0.24, 0.35) + 1.45;
  const double plates = girth * 3.2 + 2 * 2.14915;
  EXPECT_NEAR(bucket_mass({.width = 6.4}), 4800 * (1 + girth * 3.2 / plates), 1e-9);
  EXPECT_NEAR(bucket_mass({.size = 2}), 4800 * (2 * girth * 3.2 + 8 * 2.14915) / plates, 1e-9);
}

// The back of the bucket stays where the arm holds it, and the machine its share of weight on each axle: empty, 44 %
// in front.
TEST(Bucket, AnotherOneHangsOnTheSameMachine) {
  const Lhd lhd = sandvik_lh621({.bucket = {.width = 4, .size = 1.2}});
  EXPECT_EQ(lhd.G, sandvik_lh621().G);
  EXPECT_NEAR(lhd.bucket_profile[3].x(), 2.14, 1e-15);
  double mass = 0, moment = 0;
  for (const auto& body : lhd.spec.bodies) {
    mass += body.mass;
    moment += body.mass * body.centre.x();
  }
  EXPECT_NEAR(mass, 56800 - 4800 + bucket_mass({.width = 4, .size = 1.2}), 1e-6);
  EXPECT_NEAR(moment / mass, -0.56 * 4.9, 1e-9);
}

// The drive's limit is 4.5 m/s, and the edge swings at up to 2.2 m/s about the bucket's hinge, but not both at once.
// Rocks of 0.1 and 0.3 m that are let go in the middle of the bucket at 5 m/s stay between its plates.
TEST(Bucket, NoRockPassesAPlate) {
  for (const double size : {0.1, 0.3})
    for (const Vector3d& way : {Vector3d(0, 1, 0), Vector3d(-1, 0, 0), Vector3d(-1, 0, -1),
                                Vector3d(-1, 1, 0.5), Vector3d(0, -1, -1), Vector3d(0, 0, -1)})
      expect_kept_by_the_bucket(size, way.normalized());
}

TEST(Bucket, WhatNoLoaderCarriesIsRefused) {
  const auto message = [](const BucketOptions& bucket) {
    try {
      check(bucket);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(
      message({.width = 2}),
      "loading::BucketOptions: width [m] is 2.000000; allowed: 3.1 m (the wheels run in its track) to 5 m");
  EXPECT_EQ(message({.size = 2}),
            "loading::BucketOptions: size [1] is 2.000000; allowed: 0.7 to 1.3 of the machine's own bucket");
  EXPECT_EQ(message({}), "");
}
