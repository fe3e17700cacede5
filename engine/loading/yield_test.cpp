// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/engine/loading/lhd_driver.hpp>
#include <drawpoint/engine/loading/log/cycle_samples.hpp>
#include <drawpoint/engine/loading/log/hinge_torque.hpp>
#include <drawpoint/engine/loading/yield_test.hpp>
#include <memory>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::loading {
namespace {

using Eigen::Vector3d;

void require_crash(bool good, const char* name, double value, const std::string& allowed) {
  if (!good)
    throw std::invalid_argument("loading::YieldTestOptions: " + std::string(name) + " is " +
                                std::to_string(value) + "; give " + allowed);
}

void check(const YieldTestOptions& o, const Lhd& lhd) {
  const double half = lhd.bucket_width / 2;
  require_crash(o.rock_size >= 0.3 && o.rock_size <= 3, "rock_size [m]", o.rock_size, "0.3 to 3 m");
  require_crash(std::abs(o.offset) <= half, "offset [m]", o.offset,
                "-" + std::to_string(half) + " to " + std::to_string(half) + " m, the bucket's edge");
  require_crash(o.lowpass_hz >= 0, "lowpass_hz [Hz]", o.lowpass_hz, "0 (none) or more");
  require_crash(o.run_up >= 0.5 && o.run_up <= 50, "run_up [m]", o.run_up, "0.5 to 50 m");
  require_crash(o.after_touch > 0 && o.after_touch <= 60, "after_touch [s]", o.after_touch,
                "above 0, up to 60 s");
}

// The yard with the machine and the rock in its way.
class Crash {
 public:
  Crash(const Scenario& scenario, const YieldTestOptions& options)
      : lhd_(sandvik_lh621(scenario.machine)),
        machine_(lhd_.spec),
        world_(scenario.world, material_table(scenario.materials)),
        driver_(lhd_, machine_) {
    check(options, lhd_);
    world_.add_static(std::make_shared<const Shape>(HalfSpace{Vector3d::UnitZ(), 0}),
                      Eigen::Isometry3d::Identity(), static_cast<int>(SurfaceKind::terrain));
    driver_.place(0, 0);
    add_machine(world_, lhd_, machine_);
    add_rock(options);
    const char* force = scenario.machine.arm_drive == ArmDrive::cylinders ? "N" : "N m";
    log_.signals.columns = {{"time", "s"},
                            {"hinge_G_torque_x", "N m"},
                            {"hinge_G_torque_y", "N m"},
                            {"hinge_G_torque_z", "N m"},
                            {"tip_x", "m"},
                            {"tip_z", "m"},
                            {"bucket_angle", "rad"},
                            {"axle_x", "m"},
                            {"axle_z", "m"},
                            {"tilt_force", force}};
  }

  void stand() {
    while (world_.time() < LhdDriver::stand_time) {
      driver_.lower_to_floor();
      world_.step();
    }
  }

  /// From rest, faster by at most `acceleration` [m/s²], until it touches the rock; its speed then [m/s].
  double drive_in(double speed, double acceleration, double longest) {
    const double start = world_.time(), h = world_.options().step;
    while (world_.time() < start + longest) {
      const double before = driver_.read().actual.drive;
      step(std::min(speed, acceleration * (world_.time() - start + h)));
      if (!touches()) continue;
      touch_ = log_.signals.rows() - 1;
      return before;
    }
    throw std::runtime_error("loading::yield_test: the machine has not come to the rock after " +
                             std::to_string(longest) +
                             " s; give it a higher drive-in speed or more wheel torque");
  }

  void go_on(double speed, double seconds) {
    for (const double end = world_.time() + seconds; world_.time() < end;) step(speed);
  }

  /// Whole torque in hinge G from the touch on, low-passed from the start of the approach on, as a cycle's is.
  std::vector<Eigen::Vector3d> torque(double lowpass_hz) const {
    const CycleSamples samples(log_);
    const HingeTorque whole(log_);
    LowPassedVector filter([&](std::size_t row) { return whole.at(row); }, lowpass_hz);
    std::vector<Vector3d> values;
    for (std::size_t row = 0; row < samples.rows(); ++row) {
      const Vector3d value = filter.next(samples);
      if (row >= touch_) values.push_back(value);
    }
    return values;
  }
  std::vector<double> time() const {
    std::vector<double> times;
    for (std::size_t row = touch_; row < log_.signals.rows(); ++row)
      times.push_back(log_.signals.at(row, 0) - log_.signals.at(touch_, 0));
    return times;
  }

 private:
  // On the floor, its longest side along the drift.
  void add_rock(const YieldTestOptions& options) {
    const ConvexPolyhedron rock = granular::rock_shapes()[0].scaled(options.rock_size);
    Vector3d low = rock.vertices().front();
    for (const Vector3d& v : rock.vertices()) low = low.cwiseMin(v);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Vector3d(lhd_.K.x() + options.run_up - low.x(), options.offset, -low.z());
    rock_ = {Owner::fixed, world_.add_static(std::make_shared<const Shape>(rock), pose,
                                             static_cast<int>(SurfaceKind::rock))};
  }

  void step(double speed) {
    driver_.command({.drive = speed});
    world_.step();
    const Vector3d torque = machine_.joint_wrench(lhd_.bucket).moment;
    const MachineReading m = driver_.read();
    log_.signals.append_row(std::vector<double>{world_.time(), torque.x(), torque.y(), torque.z(), m.tip.x,
                                                m.tip.z, m.tip.phi, m.front_axle.x(), m.front_axle.z(),
                                                driver_.tilt_force()});
  }

  bool touches() const {
    const std::vector<PairForce> forces = world_.pair_forces();
    return std::any_of(forces.begin(), forces.end(), [&](const PairForce& pair) {
      return (pair.a == rock_ || pair.b == rock_) && pair.force.squaredNorm() > 0;
    });
  }

  Lhd lhd_;
  machine::Machine machine_;
  World world_;
  LhdDriver driver_;
  SurfaceOwner rock_;
  LoadingLog log_;
  std::size_t touch_ = 0;  // row of the log
};

double largest(const std::vector<Vector3d>& torques) {
  double norm = 0;
  for (const Vector3d& torque : torques) norm = std::max(norm, torque.norm());
  return norm;
}

}  // namespace

YieldTest yield_test(const Scenario& scenario, const YieldTestOptions& options) {
  const double speed = scenario.executor.speeds.drive_in;
  require_crash(speed > 0 && std::isfinite(speed), "the scenario's speeds.drive_in [m/s]", speed,
                "a finite value above 0");
  const double acceleration = scenario.executor.speeds.limits.drive_acceleration;
  require_crash(acceleration > 0, "the scenario's drive_acceleration [m/s2]", acceleration,
                "a value above 0");
  Crash crash(scenario, options);
  crash.stand();
  YieldTest test;
  test.touch_speed = crash.drive_in(speed, acceleration, 10 + 10 * options.run_up / speed);
  crash.go_on(speed, options.after_touch);
  test.time = crash.time();
  const std::vector<Vector3d> torques = crash.torque(options.lowpass_hz);
  for (const Vector3d& torque : torques) {
    test.torque.push_back(torque.norm());
    test.twisting.push_back(std::hypot(torque.x(), torque.z()));
    test.peak_twisting = std::max(test.peak_twisting, test.twisting.back());
  }
  test.peak = largest(torques);
  test.unfiltered_peak = largest(crash.torque(0));
  return test;
}

}  // namespace drawpoint::engine::loading
