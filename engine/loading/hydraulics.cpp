// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/hydraulics.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::loading {
namespace {

constexpr double lift_cylinders = 2;

double area(double diameter) { return M_PI / 4 * diameter * diameter; }
double ring_area(const Cylinder& cylinder) { return area(cylinder.bore) - area(cylinder.rod); }

void require_circuit(bool good, const std::string& name, double value, const char* allowed) {
  if (!good)
    throw std::invalid_argument("loading::Hydraulics: " + name + " is " + std::to_string(value) + "; give " +
                                allowed);
}

void check_cylinder(const Cylinder& cylinder, const std::string& name) {
  require_circuit(cylinder.bore > 0 && cylinder.bore <= 1, name + " bore [m]", cylinder.bore,
                  "a diameter above 0, up to 1 m");
  require_circuit(cylinder.rod >= 0 && cylinder.rod < cylinder.bore, name + " rod [m]", cylinder.rod,
                  "a diameter below the bore; 0: it pulls as hard as it pushes");
}

}  // namespace

Hydraulics lh621_hydraulics() {
  return {
      .pump_flow = 485e-3 / 60, .lift = {.bore = 0.180, .rod = 0.100}, .tilt = {.bore = 0.200, .rod = 0.110}};
}

double pushing_force(const Cylinder& cylinder, double pressure) { return pressure * area(cylinder.bore); }
double pulling_force(const Cylinder& cylinder, double pressure) { return pressure * ring_area(cylinder); }

double flow(const Cylinder& cylinder, double speed) {
  return std::abs(speed) * (speed > 0 ? area(cylinder.bore) : ring_area(cylinder));
}

double flow_share(const Hydraulics& hydraulics, double lift_speed, double tilt_speed) {
  const double asked = lift_cylinders * flow(hydraulics.lift, lift_speed) + flow(hydraulics.tilt, tilt_speed);
  return asked > hydraulics.pump_flow ? hydraulics.pump_flow / asked : 1.0;
}

void check(const Hydraulics& hydraulics) {
  require_circuit(hydraulics.pressure > 0 && std::isfinite(hydraulics.pressure), "pressure [Pa]",
                  hydraulics.pressure, "a value above 0");
  require_circuit(hydraulics.pump_flow > 0, "pump_flow [m3/s]", hydraulics.pump_flow,
                  "a value above 0; infinity for no limit");
  check_cylinder(hydraulics.lift, "lift");
  check_cylinder(hydraulics.tilt, "tilt");
}

}  // namespace drawpoint::engine::loading
