// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/lhd_driver.hpp>
#include <memory>

namespace drawpoint::engine::loading {
namespace {

double elevation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d d = to - from;
  return std::atan2(d.z(), d.x());
}

}  // namespace

void add_machine(engine::World& world, const Lhd& lhd, machine::Machine& machine) {
  world.attach(&machine);
  for (const LhdSurface& s : lhd.surfaces)
    if (s.touches)
      world.add_part_shape(s.body, std::make_shared<const engine::Shape>(s.shape),
                           Eigen::Isometry3d::Identity(), static_cast<int>(s.kind));
}

LhdDriver::LhdDriver(const Lhd& lhd, machine::Machine& machine)
    : lhd_(lhd), machine_(machine), arm_(arm_geometry(lhd.F, lhd.G, lhd.K)) {}

void LhdDriver::place(double x, double y) {
  // Axles 2 cm above their reference height: the tyres sink to about it under the weight, and the bucket
  // clears the floor.
  machine_.place(Eigen::Isometry3d(Eigen::Translation3d(x, y, 0.02)));
  command({});
}

void LhdDriver::settle_alone(const engine::WorldOptions& options, const MineMaterials& materials) {
  engine::World world(options, material_table(materials));
  world.add_static(std::make_shared<const engine::Shape>(engine::HalfSpace{Eigen::Vector3d::UnitZ(), 0}),
                   Eigen::Isometry3d::Identity(), static_cast<int>(SurfaceKind::terrain));
  add_machine(world, lhd_, machine_);
  place(0, 0);
  while (world.time() < stand_time) {
    lower_to_floor();
    world.step();
  }
  standing_ = machine_.state();
}

void LhdDriver::place_standing(double tip_x, double y, double speed) {
  machine_.set_state(standing_);
  const Eigen::Vector3d tip = machine_.point(lhd_.bucket, lhd_.K);
  machine_.translate({tip_x - tip.x(), y - tip.y(), 0});
  std::vector<std::pair<int, double>> turning;
  for (int wheel : lhd_.wheels) turning.emplace_back(wheel, speed / rolling_radius(wheel));
  machine_.set_velocity({speed, 0, 0}, turning);
  command({.drive = speed});
}

MachineReading LhdDriver::read() const {
  MachineReading r;
  const Eigen::Vector3d g = machine_.point(lhd_.bucket, lhd_.G), k = machine_.point(lhd_.bucket, lhd_.K);
  r.tip = {k.x(), k.z(), elevation(g, k) - arm_.psi_b};
  r.tip_y = k.y();
  const Eigen::Vector3d axle(0, 0, lhd_.loaded_radius);
  r.front_axle = machine_.point(lhd_.front, axle);
  r.actual = {machine_.point_velocity(lhd_.front, axle).x(), machine_.speed(lhd_.boom),
              machine_.speed(lhd_.bucket)};
  return r;
}

double LhdDriver::rolling_radius(int wheel) const {
  return 0.5 * (lhd_.tyre_radius + machine_.pose(wheel).translation().z());
}

double LhdDriver::most_wheel_torque() const {
  double turning = 0;
  for (int wheel : lhd_.wheels) turning += std::abs(machine_.speed(wheel));
  const double arm_power =
      std::max(lift_force() * lift_speed(), 0.0) + std::max(tilt_force() * tilt_speed(), 0.0);
  return wheel_torque_limit(lhd_.options.drive_line, lhd_.options.wheel_torque, turning, arm_power);
}

void LhdDriver::command(const ActuatorRates& rates, double drive_share) {
  const double most_torque = drive_share * most_wheel_torque();
  for (int k = 0; k < 4; ++k) {
    machine_.set_motor(lhd_.wheel_motors[k], rates.drive / rolling_radius(lhd_.wheels[k]));
    machine_.limit_motor(lhd_.wheel_motors[k], most_torque);
  }
  Eigen::VectorXd speeds = Eigen::Vector2d(rates.boom, rates.tilt);
  if (lhd_.options.arm_drive == ArmDrive::cylinders) {
    const std::vector<int> outside = {lhd_.rear, lhd_.wheels[0], lhd_.wheels[1], lhd_.wheels[2],
                                      lhd_.wheels[3]};
    speeds =
        machine_.transmission({lhd_.lift_rods[0], lhd_.tilt_rod}, {lhd_.boom, lhd_.bucket}, outside) * speeds;
    speeds *= flow_share(lhd_.options.hydraulics, speeds[0], speeds[1]);
  }
  machine_.set_motor(lhd_.lift_motor, speeds[0]);
  machine_.set_motor(lhd_.tilt_motor, speeds[1]);
}

void LhdDriver::lower_to_floor() {
  constexpr double time = 0.15;
  const TipPose tip = read().tip;
  ActuatorRates rates = within_limits(
      actuator_rates(arm_, arm_pose(arm_, tip), {.v_z = -tip.z / time, .omega = -tip.phi / time}), {});
  rates.drive = 0;
  command(rates);
}

double LhdDriver::lift_force() const {
  const auto cylinders = lhd_.spec.motors[lhd_.lift_motor].bodies.size();
  return static_cast<double>(cylinders) * machine_.motor_force(lhd_.lift_motor);
}

double LhdDriver::tilt_force() const { return machine_.motor_force(lhd_.tilt_motor); }

double LhdDriver::wheel_torque() const {
  double sum = 0;
  for (int motor : lhd_.wheel_motors) sum += machine_.motor_force(motor);
  return sum;
}

double LhdDriver::wheel_power() const {
  double sum = 0;
  for (int k = 0; k < 4; ++k)
    sum += machine_.motor_force(lhd_.wheel_motors[k]) * machine_.speed(lhd_.wheels[k]);
  return sum;
}

double LhdDriver::wheel_speed() const {
  double sum = 0;
  for (int wheel : lhd_.wheels) sum += machine_.speed(wheel) * rolling_radius(wheel);
  return sum / static_cast<double>(lhd_.wheels.size());
}

double LhdDriver::moving_mass() const {
  double mass = 0;
  for (const machine::BodySpec& body : lhd_.spec.bodies) mass += body.mass;
  for (int wheel : lhd_.wheels)
    mass +=
        lhd_.spec.bodies[static_cast<std::size_t>(wheel)].inertia(1, 1) / std::pow(rolling_radius(wheel), 2);
  return mass;
}

double LhdDriver::lift_speed() const {
  return machine_.speed(lhd_.spec.motors[lhd_.lift_motor].bodies.front());
}
double LhdDriver::tilt_speed() const {
  return machine_.speed(lhd_.spec.motors[lhd_.tilt_motor].bodies.front());
}

Eigen::Vector3d LhdDriver::in_bucket_frame(const Eigen::Vector3d& p_W) const {
  return machine_.pose(lhd_.bucket).inverse() * p_W + lhd_.spec.bodies[lhd_.bucket].centre;
}

}  // namespace drawpoint::engine::loading
