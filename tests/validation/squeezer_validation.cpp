// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/machine_steps.hpp>
#include <drawpoint/tests/validation/extrapolation.hpp>
#include <drawpoint/tests/validation/record.hpp>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::machine::BodySpec;
using engine::machine::Machine;
using validation::record;

namespace {

const validation::Problem squeezer{
    "squeezer", validation::Group::mechanism, "Andrews' squeezing mechanism (benchmark A03)",
    "Seven links with three loops through one point are driven by 0.033 N m against a spring, up to "
    "1200 rad/s within 30 ms, in steps of 8, 4, 2 and 1 µs that are extrapolated to zero."};

const std::string published = "IVP test set, Andrews, t = 0.03 s";
constexpr double torque = 0.033, stiffness = 4530, rest_length = 0.07785, duration = 0.03;

// The plane of the mechanism is x-z; angles count from x towards z, that is about −y.
Vector3d in_plane(double x, double y) { return {x, 0, y}; }
Vector3d direction(double angle) { return in_plane(std::cos(angle), std::sin(angle)); }
Vector3d across(double angle) { return in_plane(std::sin(angle), -std::cos(angle)); }

// Where everything is at t = 0: β, Θ, γ, φ, δ, Ω, ε of the test set.
constexpr double beta = -0.0617138900142764496, theta = 0, gamma0 = 0.455279819163070380;
constexpr double phi = 0.222668390165885885, delta = 0.487364979543842550, omega = -0.222668390165885885,
                 epsilon = 1.23054744454982120;
const Vector3d O = Vector3d::Zero(), A = in_plane(-0.06934, -0.00227), B = in_plane(-0.03635, 0.03273),
               C = in_plane(0.014, 0.072);
const Vector3d F = O + 0.007 * direction(beta), E = F - 0.028 * direction(beta + theta);
const Vector3d G = A + 0.04 * direction(delta), H = A + 0.04 * across(epsilon);
const Vector3d D = B + 0.02 * direction(gamma0) + 0.018 * across(gamma0);

BodySpec link(const std::string& name, int parent, const Vector3d& joint, double mass, const Vector3d& centre,
              double inertia) {
  BodySpec body;
  body.name = name;
  body.parent = parent;
  body.joint = engine::machine::JointKind::hinge;
  body.joint_point = joint;
  body.joint_axis = -Vector3d::UnitY();
  body.mass = mass;
  body.centre = centre;
  body.inertia = inertia * Eigen::Matrix3d::Identity();
  return body;
}

enum Link { crank, rod, triangle, lever_G, rod_G, lever_H, rod_H };

engine::machine::MachineSpec mechanism() {
  engine::machine::MachineSpec spec;
  spec.bodies = {
      link("OF", -1, O, 0.04325, 0.00092 * direction(beta), 2.194e-6),
      link("FE", crank, F, 0.00365, F - 0.0115 * direction(beta + theta), 4.410e-7),
      link("BDE", -1, B, 0.02373, B + 0.01043 * direction(gamma0) + 0.01874 * across(gamma0), 5.255e-6),
      link("AG", -1, A, 0.07050, A + 0.02308 * direction(delta) - 0.00916 * across(delta), 1.169e-5),
      link("GE", lever_G, G, 0.00706, G + (0.02 - 0.01421) * across(phi + delta), 5.667e-7),
      link("AH", -1, A, 0.05498, A - 0.00449 * direction(epsilon) + 0.01228 * across(epsilon), 1.912e-5),
      link("HE", lever_H, H, 0.00706, H + (0.02 - 0.01421) * direction(omega + epsilon), 5.667e-7)};
  for (const int other : {triangle, rod_G, rod_H})
    spec.loops.push_back({"E of " + spec.bodies[other].name, rod, other, E, Vector3d::UnitY()});
  return spec;
}

using Angles = Eigen::Matrix<double, 7, 1>;

Angles run(double step) {
  Machine machine(mechanism());
  const int steps = static_cast<int>(std::lround(duration / step));
  for (int n = 0; n < steps; ++n) {
    const Vector3d at = machine.point(triangle, D), span = at - C;
    const Vector3d pull = -stiffness * (span.norm() - rest_length) * span.normalized();
    const Vector3d arm = at - machine.pose(triangle).translation();
    machine.add_force(triangle, {arm.cross(pull), pull});
    machine.add_force(crank, {-torque * Vector3d::UnitY(), Vector3d::Zero()});
    support::step_alone(machine, step, Vector3d::Zero());
  }
  Angles angles;
  angles << beta + machine.coordinate(crank), theta + machine.coordinate(rod),
      gamma0 + machine.coordinate(triangle), phi + machine.coordinate(rod_G),
      delta + machine.coordinate(lever_G), omega + machine.coordinate(rod_H),
      epsilon + machine.coordinate(lever_H);
  return angles;
}

}  // namespace

TEST(Squeezer, AnglesAtTheEnd) {
  const std::array<const char*, 7> names{"crank, β",    "rod on the crank, Θ", "triangle, γ", "rod GE, φ",
                                         "lever AG, δ", "rod HE, Ω",           "lever AH, ε"};
  const std::array<double, 7> exact{15.81077119629904,   -15.75637105984298, 0.04082224013073101,
                                    -0.5347301163226948, 0.5244099658805304, 0.5347301163226948,
                                    1.048080741042263};
  const std::vector<Angles> runs{run(8e-6), run(4e-6), run(2e-6), run(1e-6)};
  std::vector<validation::Extrapolated> found;
  double correction = 0;
  for (int k = 0; k < 7; ++k) {
    std::vector<double> x;
    for (const Angles& angles : runs) x.push_back(angles[k]);
    found.push_back(validation::extrapolate(x));
    correction = std::max(correction, found.back().correction);
  }
  for (int k = 0; k < 7; ++k)
    record(squeezer,
           {.quantity = names[k],
            .unit = "rad",
            .expected = exact[k],
            .source = published,
            .measured = found[k].value,
            .budget = correction,
            .budget_reason = "Angles: the last of Richardson's corrections from four steps, the largest of "
                             "the seven, which is the error before it was made."});
  record(squeezer, {.quantity = "order in h of the crank's angle",
                    .expected = 1,
                    .source = "semi-implicit Euler",
                    .measured = found[0].order,
                    .budget = 0.2,
                    .budget_reason = "Order: 0.2 tells first order from half and second."});
}
