// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/jacobi.hpp>
#include <drawpoint/tests/support/machine_steps.hpp>
#include <drawpoint/tests/support/machines.hpp>
#include <drawpoint/tests/validation/extrapolation.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <numbers>

using namespace drawpoint;
using validation::record;

namespace {

const validation::Problem four_bar_chain{
    "four_bar_chain", validation::Group::mechanism, "Chain of two four-bars (benchmark A02)",
    "Three standing links and two couplers of 1 m and 1 kg turn for 10 s, from upright with 1 m/s, "
    "through positions where the loops lose a rank, in steps of 4, 2 and 1 ms."};

constexpr double g = 9.81, h = 1e-3, duration = 10;
const Eigen::Vector3d gravity(0, 0, -g);

// Standing links on the ground at x = 0, 1, 2, couplers from the first to the second and from the second to
// the third.
engine::machine::MachineSpec chain() {
  engine::machine::MachineSpec spec;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d foot(k, 0, 0), head(k, 0, 1);
    spec.bodies.push_back(support::rod("link " + std::to_string(k), -1, foot, head, 1));
  }
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d from(k, 0, 1), to(k + 1, 0, 1);
    spec.bodies.push_back(support::rod("coupler " + std::to_string(k), k, from, to, 1));
    spec.loops.push_back({"head " + std::to_string(k + 1), 3 + k, k + 1, to, Eigen::Vector3d::UnitY()});
  }
  return spec;
}

struct Turning {
  double x = 0, z = 0;  // of the first head at the end [m]
  double worst_energy = 0, worst_loop = 0, worst_fold = 0;
};

Turning turn(double step) {
  engine::machine::Machine machine(chain());
  support::set_turning(machine, 0, Eigen::Vector3d::UnitY(), 1);
  const double energy = machine.energy(gravity);
  Turning result;
  const int steps = static_cast<int>(std::lround(duration / step));
  for (int n = 1; n <= steps; ++n) {
    support::step_alone(machine, step, gravity);
    result.worst_energy = std::max(result.worst_energy, std::abs(machine.energy(gravity) - energy));
    result.worst_loop = std::max(result.worst_loop, machine.loop_error());
    for (int k = 1; k < 3; ++k)
      result.worst_fold =
          std::max(result.worst_fold, std::abs(machine.coordinate(k) - machine.coordinate(0)));
  }
  const Eigen::Vector3d head = machine.point(0, {0, 0, 1});
  result.x = head.x();
  result.z = head.z();
  return result;
}

// As a parallelogram it is one pendulum: 3 links of 1/3 kg m² and 2 couplers of 1 kg m² give 3 kg m², and the
// potential is (3/2 + 2) g cos s, s the angle from upright. So s'² = 1 + 2a sin²(s/2), a = 7 g/3, and with
// m = 2a/(1 + 2a) the half angle is s/2 = am(K + √(1 + 2a) t/2 − ...): measured from the lowest point,
// sin((s − π)/2) = −cos(s/2) = sn(√(1 + 2a) t/2 − K, √m).
constexpr double a = 7 * g / 3;
const double fastest = std::sqrt(1 + 2 * a), modulus = std::sqrt(2 * a) / fastest;

Eigen::Vector2d exact_head() {
  const auto j = support::jacobi(0.5 * fastest * duration - std::comp_ellint_1(modulus), modulus);
  // cos(s/2) = −sn, sin(s/2) = cn: x = sin s, z = cos s.
  return {-2 * j.sn * j.cn, 2 * j.sn * j.sn - 1};
}

}  // namespace

TEST(FourBarChain, HeadAtTheEnd) {
  const Turning coarse = turn(4 * h), middle = turn(2 * h), fine = turn(h);
  const auto x = validation::extrapolate({coarse.x, middle.x, fine.x}, 4);
  const auto z = validation::extrapolate({coarse.z, middle.z, fine.z}, 4);
  const std::string reason = "Extrapolated values: the last of Richardson's corrections from three steps.";
  record(four_bar_chain, {.quantity = "head of the first link at 10 s, x, extrapolated to h = 0",
                          .unit = "m",
                          .expected = exact_head().x(),
                          .source = "equivalent pendulum, elliptic functions",
                          .measured = x.value,
                          .budget = x.correction,
                          .budget_reason = reason});
  record(four_bar_chain, {.quantity = "the head's z at 10 s, extrapolated to h = 0",
                          .unit = "m",
                          .expected = exact_head().y(),
                          .source = "equivalent pendulum, elliptic functions",
                          .measured = z.value,
                          .budget = z.correction,
                          .budget_reason = reason});
  record(four_bar_chain,
         {.quantity = "distance of the head from the exact place with h = 1 ms",
          .unit = "m",
          .expected = 0,
          .source = "benchmark A02",
          .measured = std::hypot(fine.x - exact_head().x(), fine.z - exact_head().y()),
          .budget = 1e-3,
          .budget_reason = "Place of the head: what the benchmark allows for high precision, 1e-3."});
}

// A step of the fourth-order rule errs by x⁵/120 of the energy, 7 g from upright to hanging, x the fastest turn in it;
// in all steps one way at worst.
TEST(FourBarChain, EnergyThroughTheSingularPositions) {
  const double most = std::pow(fastest * h, 5) / 120 * 7 * g * duration / h;
  const Turning result = turn(h);
  record(four_bar_chain,
         {.quantity = "largest change of energy in 10 s",
          .unit = "J",
          .expected = 0,
          .source = "conservation",
          .measured = result.worst_energy,
          .budget = most,
          .budget_reason =
              "Energy: x⁵/120 of it per step of a fourth-order rule, x the fastest turn in a step."});
  record(four_bar_chain,
         {.quantity = "largest difference of the links' angles",
          .unit = "rad",
          .expected = 0,
          .source = "parallelogram",
          .measured = result.worst_fold,
          .budget = std::sqrt(2 * 1e-9),
          .budget_reason =
              "Angles: in the horizontal a difference δ opens a loop by δ²/2 only, so the promised loop "
              "error of 1e-9 m lets √2e-9 pass."});
  record(four_bar_chain, {.quantity = "largest loop error",
                          .unit = "m",
                          .expected = 0,
                          .source = "exact joints",
                          .measured = result.worst_loop,
                          .budget = 1e-9,
                          .budget_reason = "Loops: the engine's promise of 1e-9 m after every step."});
}
