// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/machine_steps.hpp>
#include <drawpoint/tests/support/machines.hpp>
#include <drawpoint/tests/validation/bricard_reference.hpp>
#include <drawpoint/tests/validation/extrapolation.hpp>
#include <drawpoint/tests/validation/record.hpp>

using namespace drawpoint;
using Eigen::Vector3d;
using validation::record;

namespace {

const validation::Problem bricard{
    "bricard", validation::Group::mechanism, "Bricard's mechanism (benchmark A04)",
    "Five rods of 1 m and 1 kg along the edges of a cube fall for 10 s in steps of 4, 2, 1 and 0.5 "
    "ms, joined by six hinges that leave one freedom; two pins close the sixth."};

// The corner is compared at 9.5 s; at 10 s the rods happen to stand nearly still again.
constexpr double g = 9.81, duration = 10, seen = 9.5;
const Vector3d gravity(0, -g, 0);

// Rods 0, 1, 2 hang on the ground at corner 0, rods 4, 3 at corner 5; they close at corner 3.
engine::machine::MachineSpec mechanism() {
  const auto at = validation::bricard_corners();
  engine::machine::MachineSpec spec;
  const auto add = [&](int parent, int from, int to, int hinge) {
    spec.bodies.push_back(support::rod("rod to corner " + std::to_string(to), parent, at[from], at[to], 1));
    spec.bodies.back().joint_axis = validation::bricard_axis(hinge);
  };
  add(-1, 0, 1, 0);
  add(0, 1, 2, 1);
  add(1, 2, 3, 2);
  add(-1, 5, 4, 5);
  add(3, 4, 3, 4);
  const Vector3d axis = validation::bricard_axis(3);
  spec.loops = {{"corner 3", 2, 4, at[3], axis}, {"1 m along the axis", 2, 4, at[3] + axis, axis}};
  return spec;
}

struct Fall {
  Vector3d corner;  // 3, when seen
  double worst_energy = 0, worst_loop = 0, worst_slide = 0;
};

Fall fall(double step) {
  engine::machine::Machine machine(mechanism());
  const Vector3d corner = validation::bricard_corners()[3];
  const double energy = machine.energy(gravity);
  Fall result;
  const auto steps_to = [&](double t) { return static_cast<int>(std::lround(t / step)); };
  for (int n = 1; n <= steps_to(duration); ++n) {
    support::step_alone(machine, step, gravity);
    if (n == steps_to(seen)) result.corner = machine.point(2, corner);
    result.worst_energy = std::max(result.worst_energy, std::abs(machine.energy(gravity) - energy));
    result.worst_loop = std::max(result.worst_loop, machine.loop_error());
    result.worst_slide =
        std::max(result.worst_slide, (machine.point(2, corner) - machine.point(4, corner)).norm());
  }
  return result;
}

validation::BricardReference reference(double dt) {
  validation::BricardReference exact(gravity, 1e-6);
  for (int n = 0; n < static_cast<int>(std::lround(seen / dt)); ++n) exact.advance(dt);
  return exact;
}

const std::vector<Fall>& falls() {
  static const std::vector<Fall> all{fall(4e-3), fall(2e-3), fall(1e-3), fall(0.5e-3)};
  return all;
}

}  // namespace

TEST(Bricard, Corner) {
  const auto exact = reference(1e-3);
  const double exact_error = (reference(2e-3).corner(3) - exact.corner(3)).norm();
  const double start = validation::BricardReference(gravity, 1e-6).energy();
  EXPECT_LT(exact.closure(), 1e-8);
  EXPECT_LT(std::abs(exact.energy() - start), 1e-7);
  std::vector<validation::Extrapolated> found;
  double correction = 0;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> x;
    for (const Fall& f : falls()) x.push_back(f.corner[k]);
    found.push_back(validation::extrapolate(x));
    correction = std::max(correction, found.back().correction);
  }
  const std::array<const char*, 3> names{
      "x of the corner opposite the ground at 9.5 s, extrapolated to h = 0",
      "the corner's y, extrapolated to h = 0", "the corner's z, extrapolated to h = 0"};
  for (int k = 0; k < 3; ++k)
    record(bricard,
           {.quantity = names[k],
            .unit = "m",
            .expected = exact.corner(3)[k],
            .source = "closure (1 − sin a)(1 − sin b) = 1 and Lagrange's equation of one freedom",
            .measured = found[k].value,
            .budget = correction + exact_error,
            .budget_reason = "Corner: the last of Richardson's corrections from four steps, the largest of "
                             "the three, and what halving the reference's own step changes."});
}

TEST(Bricard, EnergyAndClosure) {
  std::vector<double> changes;
  for (const Fall& f : falls()) changes.push_back(f.worst_energy);
  const auto energy = validation::extrapolate(changes);
  record(bricard, {.quantity = "largest change of energy in 10 s, extrapolated to h = 0",
                   .unit = "J",
                   .expected = 0,
                   .source = "conservation",
                   .measured = energy.value,
                   .budget = energy.correction,
                   .budget_reason =
                       "Energy: it swings in proportion to h (0.3 J at 4 ms) and must vanish with it, to the "
                       "last of Richardson's corrections."});
  record(bricard, {.quantity = "order in h of the change of energy",
                   .expected = 1,
                   .source = "semi-implicit Euler",
                   .measured = energy.order,
                   .budget = 0.2,
                   .budget_reason = "Order: 0.2 tells first order from half and second."});
  record(bricard,
         {.quantity = "largest slide along the closing axis",
          .unit = "m",
          .expected = 0,
          .source = "overconstrained closure",
          .measured = falls().back().worst_slide,
          .budget = 1e-9,
          .budget_reason = "Loops: the engine's promise of 1e-9 m after every step, in the direction that no "
                           "equation holds as well."});
}
