// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/lhd.hpp>
#include <drawpoint/engine/loading/strategy/kinematics.hpp>
#include <drawpoint/engine/machine/machine.hpp>
#include <drawpoint/engine/world/world.hpp>

/// Reads a machine as the executor sees it and turns its commands into motor speeds.
///
/// The bucket angle is the world elevation of G to K less that of the reference pose; positive = nose up.
/// Rates are those of the joints (the chassis's own pitching is left out). The actual drive speed is the
/// body's, not the wheels': a machine that spins its wheels on the spot does not move.
///
/// With cylinder drive, hinge rates become cylinder speeds through the linkage's own velocity constraints at
/// the present pose. Both kinds of drive are velocity motors with force limits. Each wheel is set by its own
/// rolling radius, the mean of the tyre's free radius and its hub's height over the floor, so that axles
/// under different load do not fight each other as wheels on one rigid shaft would.
namespace drawpoint::engine::loading {

struct MachineReading {
  TipPose tip;           ///< middle of the cutting edge, world, and bucket angle
  double tip_y = 0;      ///< [m]
  ActuatorRates actual;  ///< forward speed of the front unit, rates of hinges F and G
  Eigen::Vector3d front_axle = Eigen::Vector3d::Zero();  ///< world [m]
};

/// Attaches the machine to a world, with all its surfaces that touch.
void add_machine(engine::World& world, const Lhd& lhd, machine::Machine& machine);

class LhdDriver {
 public:
  /// For the tyres to take the weight after place(), and the bucket to come down by lower_to_floor() [s].
  static constexpr double stand_time = 1.0;

  LhdDriver(const Lhd& lhd, machine::Machine& machine);

  /// Stands the machine at rest in its reference pose with the front axle line at (x, y), heading +x, on its
  /// tyres.
  void place(double x, double y);
  /// Finds how the machine stands on a level floor by itself, bucket down, from a world of its own with these options
  /// and materials; place_standing() needs it. Call before the machine is attached to another world.
  void settle_alone(const engine::WorldOptions& options, const MineMaterials& materials);
  /// Puts the machine as it stands by itself, its tyres loaded and its bucket flat on the floor, with the middle of the
  /// cutting edge at (tip_x, y), driving forward at `speed` [m/s].
  void place_standing(double tip_x, double y, double speed = 0);
  MachineReading read() const;
  /// Set speeds for the next step, and what the engine has for the wheels: by their turning now and what the
  /// arm took in the last step, so call it before each.
  /// `drive_share` of that torque, 0 to 1.
  void command(const ActuatorRates& rates, double drive_share = 1);
  /// Commands boom and tilt so that the bucket comes to lie flat with its edge on the floor z = 0, nearer by
  /// a factor of e in 0.15 s; the drive stands. Call before each step.
  void lower_to_floor();

  double lift_force() const;    ///< sum of the lift motors in the last step [N] or [N m]
  double tilt_force() const;    ///< [N] or [N m]
  double wheel_torque() const;  ///< sum over the wheels [N m]
  double wheel_power() const;   ///< what their motors give, turning or spinning [W]
  double wheel_speed() const;   ///< of the tyres' rims, mean over the wheels, forward positive [m/s]
  double moving_mass()
      const;                  ///< the machine's, with what turning wheels add at the speed of their rims [kg]
  double lift_speed() const;  ///< of the first lift motor's joint [m/s] or [rad/s]
  double tilt_speed() const;

  const ArmGeometry& arm() const { return arm_; }

  /// World point in the reference-pose coordinates of the bucket.
  Eigen::Vector3d in_bucket_frame(const Eigen::Vector3d& p_W) const;

 private:
  double rolling_radius(int wheel) const;
  double most_wheel_torque() const;

  const Lhd& lhd_;
  machine::Machine& machine_;
  ArmGeometry arm_;
  std::vector<double> standing_;  // Machine::state()
};

}  // namespace drawpoint::engine::loading
