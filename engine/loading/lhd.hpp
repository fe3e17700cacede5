// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/geometry/shape.hpp>
#include <drawpoint/engine/loading/bucket.hpp>
#include <drawpoint/engine/loading/drive_line.hpp>
#include <drawpoint/engine/loading/hydraulics.hpp>
#include <drawpoint/engine/loading/mine_materials.hpp>
#include <drawpoint/engine/machine/machine_spec.hpp>
#include <string>
#include <string_view>
#include <vector>

/// The load-haul-dump machine of Lindmark (2016), Sandvik LH621 class, as a machine specification with
/// surfaces.
///
/// 16 bodies: front and rear unit, four wheels, boom, bucket, bell-crank, link, and barrel and rod of one
/// tilt and two lift cylinders. Arm: 11 hinges (7 in the tree, 4 loop pins) and 3 prismatics, two freedoms.
/// The rear unit oscillates about the long axis; steering is locked straight, as the attack is. 57 t, axle
/// loads empty 44/56 %.
///
/// Frame and reference pose: x forward from the front axle line, y left, z up from the floor, bucket flat on
/// the floor. Hinge points are an estimated, consistent Z-bar linkage: no manufacturer publishes them. Masses
/// and inertias are estimates too (solid boxes and cylinders); published are payload 21 t, weight, power and
/// tyre size.
///
/// All parts touch rocks but the cylinders, which lie between the arm's plates and are only drawn.
/// Both lift cylinders are one motor and share one stop.
namespace drawpoint::engine::loading {

/// What moves the arm.
enum class ArmDrive {
  cylinders,  ///< velocity motors on the three cylinders, limited by their hydraulics; the machine's (default)
  hinges      ///< velocity motors on the boom and bucket hinges, as Lindmark (2016) has it
};

/// By name. Throws std::invalid_argument with the names.
ArmDrive arm_drive_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> arm_drive_names = {"cylinders", "hinges"};

struct LhdOptions {
  ArmDrive arm_drive = ArmDrive::cylinders;
  Hydraulics hydraulics = {};  ///< of ArmDrive::cylinders; by default any flow: the source's motors know none
  double lift_torque = 1696e3;  ///< [N m] at F, used with ArmDrive::hinges
  double tilt_torque = 673e3;   ///< [N m] at G, used with ArmDrive::hinges
  double wheel_torque = 81e3;   ///< each of four [N m]: 350 kN at the tyres, the torque converter near stall
  DriveLine drive_line = {};    ///< by default no engine: the source's wheel motors know none
  BucketOptions bucket;  ///< with another the rear unit is ballasted anew, to the same share of each axle
};

/// A convex piece of one body, for contact and for pictures; in the body's frame.
struct LhdSurface {
  int body = -1;
  engine::Shape shape;
  SurfaceKind kind;
  bool touches = false;  ///< takes part in contacts; the others are only drawn
  std::string color;     ///< `#rrggbb`
};

struct Lhd {
  machine::MachineSpec spec;
  LhdOptions options;
  int front = -1, rear = -1, boom = -1, bucket = -1, bell_crank = -1, link = -1, tilt_barrel = -1,
      tilt_rod = -1;
  std::array<int, 4> wheels;  ///< front left, front right, rear left, rear right
  std::array<int, 2> lift_barrels, lift_rods;
  std::array<int, 4> wheel_motors;
  int lift_motor = -1, tilt_motor = -1;
  Eigen::Vector3d F, G, K;  ///< boom hinge, bucket hinge, cutting edge (middle), reference pose [m]
  double tyre_radius;       ///< free radius [m]
  double loaded_radius;     ///< axle height under the machine's own weight [m]
  double bucket_width;      ///< [m]
  double bucket_volume;     ///< heaped_volume() of its bucket, in which plans count [m³]
  double pin_spacing;       ///< between the two pins that hold the bucket, an estimate [m]
  double payload;           ///< rated [kg]
  std::vector<Eigen::Vector2d>
      bucket_profile;  ///< loading::bucket_profile() of its bucket (x, z), from K round to K's neighbour [m]
  std::vector<LhdSurface> surfaces;
};

Lhd sandvik_lh621(const LhdOptions& options = {});

/// The bucket's profile with a 2:1 heap on the plane between the cutting edge and the top lip.
std::vector<Eigen::Vector2d> heaped_profile(const Lhd& lhd);

/// Whether a point, given in the reference pose's coordinates of the bucket, lies within the heaped bucket, over
/// its walls too: a rock that rests on one goes along.
bool in_heaped_bucket(const Lhd& lhd, const Eigen::Vector3d& p_M);

}  // namespace drawpoint::engine::loading
