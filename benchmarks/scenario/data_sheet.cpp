// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdio>
#include <drawpoint/engine/loading/lhd.hpp>
#include <drawpoint/engine/loading/scenario.hpp>
#include <drawpoint/engine/machine/machine.hpp>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"

/// The machine of the loading case as a data sheet would have it, beside what is published. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using namespace drawpoint::engine::loading;
using Eigen::Vector3d;

namespace {

constexpr double gravity = 9.81;  // [m/s²]

constexpr const char* about =
    "Prints masses, axle loads, bucket, breakout, traction and times of the model, computed from its bodies, "
    "pins, "
    "cylinders\nand drive line, beside what is published of such machines, as a table (CSV).\n\n"
    "  data_sheet > docs/measurements/data/machine.csv";

struct Line {
  std::string quantity, unit;
  double ours;
  std::string published;
};

struct AxleLoads {
  double front, rear;  // [t]
};

class DataSheet {
 public:
  DataSheet() : options_(as_in_the_mine()), lhd_(sandvik_lh621(options_)), machine_(lhd_.spec) {}

  std::vector<Line> lines() {
    const AxleLoads empty = axle_loads(0), loaded = axle_loads(lhd_.payload);
    const Hydraulics& h = options_.hydraulics;
    return {
        {"operating mass", "t", 1e-3 * mass(), "57 (LH621: K+S)"},
        {"front axle, empty, bucket on the floor", "t", empty.front, "44 % (Epiroc ST14: 18.4 of 42.0 t)"},
        {"rear axle, empty", "t", empty.rear, "56 %"},
        {"front axle, with the payload, bucket on the floor", "t", loaded.front, "some 57 of 78 t"},
        {"rear axle, with the payload", "t", loaded.rear, "some 21 t"},
        {"payload", "t", 1e-3 * lhd_.payload, "21 (LH621)"},
        {"bucket, struck", "m3", struck_volume(options_.bucket), ""},
        {"bucket, heaped 2:1", "m3", lhd_.bucket_volume,
         "8.0 for 21 t at the 2.63 t/m3 of Kiruna's LH625iE (25 t, 9.5 m3); 10.7 listed for lighter rock"},
        {"density at which the heaped bucket holds the payload", "t/m3",
         1e-3 * lhd_.payload / lhd_.bucket_volume, "2.63 (LH625iE)"},
        {"width over the edge", "m", lhd_.bucket_width, "3.1 (LH621: width of the machine)"},
        {"mouth, from edge to lip", "m", (lhd_.bucket_profile[1] - lhd_.bucket_profile[0]).norm(), ""},
        {"breakout at the edge, lift", "kN", 1e-3 * breakout(lhd_.lift_rods, lhd_.tilt_rod),
         "330 (ST14: 22.3 t, by payload); the relief valve of the tilt opens at the breakout by tilt"},
        {"breakout at the edge, tilt", "kN",
         1e-3 * breakout({lhd_.tilt_rod, lhd_.tilt_rod}, lhd_.lift_rods[0]), "330"},
        {"thrust at standstill", "kN", 1e-3 * thrust(0), "350 to 450 by the converter (estimate)"},
        {"thrust at 0.7 m/s", "kN", 1e-3 * thrust(0.7), ""},
        {"thrust at 1.4 m/s", "kN", 1e-3 * thrust(1.4), "200 of 382 kW (first gear)"},
        {"grip on a rock floor", "kN", 1e-3 * calibrated_materials().tyre_terrain.friction * mass() * gravity,
         "446 at a friction of 0.8"},
        {"lift, full stroke", "s", stroke(lhd_.lift_rods[0]) / speed(h.lift, 2, 1), "7.6 (ST14)"},
        {"lower, full stroke", "s", stroke(lhd_.lift_rods[0]) / speed(h.lift, 2, -1), "4.0 (ST14)"},
        {"tilt back, full stroke", "s", stroke(lhd_.tilt_rod) / speed(h.tilt, 1, 1), ""},
        {"dump, full stroke", "s", stroke(lhd_.tilt_rod) / speed(h.tilt, 1, -1), "3.0 (ST14)"}};
  }

 private:
  static LhdOptions as_in_the_mine() { return with_speeds(lh621_in_a_drift(), "machine").machine; }

  double mass() const {
    double sum = 0;
    for (const auto& body : lhd_.spec.bodies) sum += body.mass;
    return sum;
  }

  // Moments about the rear axle, in the reference pose; the payload at the middle of the heaped profile.
  AxleLoads axle_loads(double payload) const {
    const double rear_axle = lhd_.spec.bodies[static_cast<std::size_t>(lhd_.wheels[2])].centre.x();
    double moment = payload * (centre_of(heaped_profile(lhd_)).x() - rear_axle);
    for (const auto& body : lhd_.spec.bodies) moment += body.mass * (body.centre.x() - rear_axle);
    const double front = moment / -rear_axle;
    return {1e-3 * front, 1e-3 * (mass() + payload - front)};
  }

  static Eigen::Vector2d centre_of(const std::vector<Eigen::Vector2d>& profile) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < profile.size(); ++k) {
      const Eigen::Vector2d &p = profile[k], &q = profile[(k + 1) % profile.size()];
      sum += (p + q) / 6 * (p.x() * q.y() - q.x() * p.y());
    }
    return sum / area(profile);
  }

  // By virtual work: the cylinders push `pushing`, the others stand still, and the edge moves up against the breakout
  // while the arm's own weight is lifted.
  double breakout(const std::array<int, 2>& pushing, int standing) {
    machine_.place(Eigen::Isometry3d::Identity());
    const std::vector<int> arm{
        lhd_.boom,     lhd_.bucket,          lhd_.bell_crank,      lhd_.link,         lhd_.tilt_barrel,
        lhd_.tilt_rod, lhd_.lift_barrels[0], lhd_.lift_barrels[1], lhd_.lift_rods[0], lhd_.lift_rods[1]};
    std::vector<int> held(lhd_.wheels.begin(), lhd_.wheels.end());
    held.push_back(lhd_.rear);
    const Eigen::MatrixXd rates = machine_.transmission(arm, {pushing[0], standing}, held);
    std::vector<std::pair<int, double>> speeds;
    for (std::size_t k = 0; k < arm.size(); ++k)
      speeds.push_back({arm[k], rates(static_cast<Eigen::Index>(k), 0)});
    machine_.set_velocity(Vector3d::Zero(), speeds);
    double power = 0;
    for (const auto& motor : lhd_.spec.motors)
      for (const int body : motor.bodies)
        if (body == pushing[0] || body == pushing[1]) power += motor.max_force;
    for (const int body : arm) {
      const auto& part = lhd_.spec.bodies[static_cast<std::size_t>(body)];
      power -= part.mass * gravity * machine_.point_velocity(body, part.centre).z();
    }
    return power / machine_.point_velocity(lhd_.bucket, lhd_.K).z();
  }

  double thrust(double speed) const {
    const double turning = 4 * speed / lhd_.loaded_radius;
    return 4 * wheel_torque_limit(options_.drive_line, options_.wheel_torque, turning, 0) /
           lhd_.loaded_radius;
  }

  // At which the rods move when the pump gives them its whole flow [m/s].
  double speed(const Cylinder& cylinder, int cylinders, double way) const {
    return options_.hydraulics.pump_flow / (cylinders * flow(cylinder, way));
  }

  double stroke(int rod) const {
    for (const auto& stop : lhd_.spec.stops)
      for (const int body : stop.bodies)
        if (body == rod) return stop.upper - stop.lower;
    return std::nan("");
  }

  LhdOptions options_;
  Lhd lhd_;
  engine::machine::Machine machine_;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(about, "data_sheet");
  return run_command(app, argc, argv, [] {
    std::printf(
        "# data_sheet; the model beside published machines of its class\nquantity,unit,model,published\n");
    for (const Line& line : DataSheet().lines())
      std::printf("\"%s\",%s,%.4g,\"%s\"\n", line.quantity.c_str(), line.unit.c_str(), line.ours,
                  line.published.c_str());
    return 0;
  });
}
