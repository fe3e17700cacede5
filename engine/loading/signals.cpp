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

}  // namespace

SignalRecorder::SignalRecorder(const Lhd& lhd, bool all_joints, record::Table& table) : table_(table) {
  table_.columns = {
      {"time", "s"},         {"cycle", "1"},         {"stage", "1"},        {"progress", "1"},
      {"tip_x", "m"},        {"tip_y", "m"},         {"tip_z", "m"},        {"bucket_angle", "rad"},
      {"axle_x", "m"},       {"axle_z", "m"},        {"drive_set", "m/s"},  {"drive_speed", "m/s"},
      {"boom_set", "rad/s"}, {"boom_rate", "rad/s"}, {"tilt_set", "rad/s"}, {"tilt_rate", "rad/s"}};
  const bool cylinders = lhd.options.arm_drive == ArmDrive::cylinders;
  for (const char* axis : {"lift", "tilt"}) {
    table_.columns.push_back({std::string(axis) + "_speed", cylinders ? "m/s" : "rad/s"});
    table_.columns.push_back({std::string(axis) + "_force", cylinders ? "N" : "N m"});
  }
  table_.columns.push_back({"wheel_torque", "N m"});
  table_.columns.push_back({"wheel_power", "W"});
  table_.columns.push_back({"machine_energy", "J"});
  table_.columns.push_back({"rock_energy", "J"});
  table_.columns.push_back({"contacts", "1"});
  table_.columns.push_back({"solver_change", "1"});
  table_.columns.push_back({"overlap", "m"});
  for (std::size_t b = 0; b < lhd.spec.bodies.size(); ++b) {
    if (lhd.spec.bodies[b].joint == machine::JointKind::free) continue;
    if (!all_joints && static_cast<int>(b) != lhd.bucket) continue;
    joints_.push_back(static_cast<int>(b));
    const std::string joint =
        static_cast<int>(b) == lhd.bucket ? "hinge_G" : identifier(lhd.spec.bodies[b].name) + "_joint";
    for (const char* part : {"_torque_x", "_torque_y", "_torque_z"})
      table_.columns.push_back({joint + part, "N m"});
    for (const char* part : {"_force_x", "_force_y", "_force_z"})
      table_.columns.push_back({joint + part, "N"});
  }
}

void SignalRecorder::append(const Site& site, int cycle, const Executor& executor, const ActuatorRates& set,
                            const engine::StepReport& report) {
  const MachineReading m = site.driver().read();
  const LhdDriver& d = site.driver();
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
