// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/signals.h>

namespace drawpoint::engine::loading {
namespace {

// "bell-crank" -> "bell_crank": names as a script can use them.
std::string identifier(std::string name) {
  for (char& c : name)
    if (c == ' ' || c == '-') c = '_';
  return name;
}

// All but the wrenches of the joints.
std::vector<record::Column> columns_of(bool cylinders) {
  const char *speed = cylinders ? "m/s" : "rad/s", *force = cylinders ? "N" : "N m";
  return {
      {"time", "s", "at the end of the step, from the start of the run"},
      {"cycle", "1", "number of the cycle, from 1"},
      {"stage", "1", "1 drive-in, 2 lift, 3 curl, 4 back out; 0 between cycles"},
      {"progress", "1", "of the stage, 0 to 1"},
      {"tip_x", "m", "middle of the cutting edge, world: into the drift"},
      {"tip_y", "m", "middle of the cutting edge, world: to the left"},
      {"tip_z", "m", "middle of the cutting edge, world: above the floor"},
      {"bucket_angle", "rad", "of the bucket's bottom against the floor, edge up positive"},
      {"axle_x", "m", "front axle, world: into the drift"},
      {"axle_z", "m", "front axle, world: above the floor"},
      {"drive_set", "m/s", "speed of the machine that the executor asked for, forward positive"},
      {"drive_speed", "m/s", "speed of the machine, forward positive"},
      {"boom_set", "rad/s", "rate of the boom that the executor asked for, up positive"},
      {"boom_rate", "rad/s", "rate of the boom, up positive"},
      {"tilt_set", "rad/s", "rate of the bucket against the boom that the executor asked for"},
      {"tilt_rate", "rad/s", "rate of the bucket against the boom"},
      {"lift_speed", speed, "of the lift drive"},
      {"lift_force", force, "of the lift drive"},
      {"tilt_speed", speed, "of the tilt drive"},
      {"tilt_force", force, "of the tilt drive"},
      {"wheel_torque", "N m", "sum over the wheels"},
      {"wheel_power", "W", "sum over the wheels"},
      {"wheel_speed", "m/s", "of the tyres' rims, mean over the wheels, forward positive"},
      {"bucket_force_x", "N", "of rock and floor on the bucket, world: into the drift, mean over the step"},
      {"bucket_force_y", "N", "of rock and floor on the bucket, world: to the left"},
      {"bucket_force_z", "N", "of rock and floor on the bucket, world: up"},
      {"machine_energy", "J", "kinetic and potential energy of the machine"},
      {"rock_energy", "J", "kinetic and potential energy of the rocks"},
      {"contacts", "1", "contact points of the step"},
      {"solver_change", "1", "of the contact solver's last iteration, relative to the normal load"},
      {"overlap", "m", "largest of a contact in the step"}};
}

}  // namespace

SignalRecorder::SignalRecorder(const Lhd& lhd, bool all_joints, record::Table& table) : table_(table) {
  table_.columns = columns_of(lhd.options.arm_drive == ArmDrive::cylinders);
  for (std::size_t b = 0; b < lhd.spec.bodies.size(); ++b) {
    if (lhd.spec.bodies[b].joint == machine::JointKind::free) continue;
    if (!all_joints && static_cast<int>(b) != lhd.bucket) continue;
    joints_.push_back(static_cast<int>(b));
    const std::string joint =
        static_cast<int>(b) == lhd.bucket ? "hinge_G" : identifier(lhd.spec.bodies[b].name) + "_joint";
    const char* wrench = "on the child by its parent, in the child's axes, mean over the step";
    for (const char* part : {"_torque_x", "_torque_y", "_torque_z"})
      table_.columns.push_back({joint + part, "N m", wrench});
    for (const char* part : {"_force_x", "_force_y", "_force_z"})
      table_.columns.push_back({joint + part, "N", wrench});
  }
}

void SignalRecorder::append(const Site& site, int cycle, const Executor& executor, const ActuatorRates& set,
                            const engine::StepReport& report) {
  const MachineReading m = site.driver().read();
  const LhdDriver& d = site.driver();
  const Eigen::Vector3d on_bucket = site.world().part_wrench(site.lhd().bucket).force;
  row_ = {site.world().time(),
          double(cycle),
          double(executor.stage()),
          executor.progress(),
          m.tip.x,
          m.tip_y,
          m.tip.z,
          m.tip.phi,
          m.front_axle.x(),
          m.front_axle.z(),
          set.drive,
          m.actual.drive,
          set.boom,
          m.actual.boom,
          set.tilt,
          m.actual.tilt,
          d.lift_speed(),
          d.lift_force(),
          d.tilt_speed(),
          d.tilt_force(),
          d.wheel_torque(),
          d.wheel_power(),
          d.wheel_speed(),
          on_bucket.x(),
          on_bucket.y(),
          on_bucket.z(),
          site.machine_energy(),
          site.rock_energy(),
          double(report.points),
          report.last_change,
          report.max_overlap};
  for (int body : joints_) {
    const machine::Wrench w = site.machine().joint_wrench(body);
    for (const Eigen::Vector3d& v : {w.moment, w.force}) row_.insert(row_.end(), v.data(), v.data() + 3);
  }
  // Time as it is; the rest in single precision, which a file keeps in half the room.
  for (std::size_t k = 1; k < row_.size(); ++k) row_[k] = static_cast<float>(row_[k]);
  table_.append_row(row_);
}

}  // namespace drawpoint::engine::loading
