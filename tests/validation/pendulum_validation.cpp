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

const validation::Problem pendulum{
    "pendulum", validation::Group::mechanism, "Simple pendulum (benchmark A01)",
    "A point mass of 1 kg on a hinged arm of 1 m falls from horizontal at rest and swings for 10 s, "
    "in steps of 1 ms (10, 5 and 2.5 ms for the order)."};

constexpr double g = 9.81, h = 1e-3, duration = 10;
const Eigen::Vector3d gravity(0, 0, -g);
// The bob is a sphere of 1 mm: its own inertia, 0.4e-6 kg m², lengthens the pendulum.
constexpr double inertia = 1 + 0.4e-6;
const double k = std::sqrt(0.5), omega = std::sqrt(g / inertia), K = std::comp_ellint_1(k);

struct Swing {
  double angle = 0;                 // from the lowest point, at the end [rad]
  double worst_energy = 0;          // [J]
  double first_zero = 0, zero = 0;  // times of the first and of the 7th passage of the lowest point [s]
};

Swing swing(double step) {
  engine::machine::Machine machine(support::simple_pendulum(1, 1));
  const double energy = machine.energy(gravity);
  Swing result;
  double before = std::numbers::pi / 2;
  int passages = 0;
  const int steps = static_cast<int>(std::lround(duration / step));
  for (int n = 1; n <= steps; ++n) {
    support::step_alone(machine, step, gravity);
    const double now = machine.coordinate(0) + std::numbers::pi / 2;
    result.worst_energy = std::max(result.worst_energy, std::abs(machine.energy(gravity) - energy));
    if (before * now < 0 && ++passages <= 7)
      (passages == 1 ? result.first_zero : result.zero) = step * (n - 1 + before / (before - now));
    before = now;
  }
  result.angle = before;
  return result;
}

}  // namespace

// Seven passages of the lowest point are six half periods apart. A swing that nothing pushes moves by a fourth-order
// rule, (ωh)⁴ = 1e-10 of a period; a passage is found on the straight line between two steps, and there, where the
// acceleration vanishes, by a third of ω²h³ at most.
TEST(Pendulum, Period) {
  const Swing result = swing(h);
  record(pendulum, {.quantity = "period, mean of three",
                    .unit = "s",
                    .expected = 4 * K / omega,
                    .source = "4 K(sin 45°) √(L/g)",
                    .measured = (result.zero - result.first_zero) / 3,
                    .budget = omega * omega * h * h * h,
                    .budget_reason = "Period: ω²h³ for passages found on the line between two steps."});
}

// The rule's error in a step is below x⁵/120 of the energy, x = θ' h at the fastest; in all steps one way at worst.
TEST(Pendulum, Energy) {
  const double most = std::pow(std::sqrt(2 * g) * h, 5) / 120 * g * duration / h;
  record(pendulum,
         {.quantity = "largest change of energy in 10 s",
          .unit = "J",
          .expected = 0,
          .source = "conservation",
          .measured = swing(h).worst_energy,
          .budget = most,
          .budget_reason =
              "Energy: x⁵/120 of it per step of a fourth-order rule, x the fastest turn in a step."});
}

TEST(Pendulum, AngleAtTheEnd) {
  const auto x = validation::extrapolate({swing(10 * h).angle, swing(5 * h).angle, swing(2.5 * h).angle}, 4);
  const double exact = 2 * std::asin(k * support::jacobi(omega * duration + K, k).sn);
  record(pendulum,
         {.quantity = "angle at 10 s, extrapolated to h = 0",
          .unit = "rad",
          .expected = exact,
          .source = "2 asin(k sn(ωt + K))",
          .measured = x.value,
          .budget = x.correction,
          .budget_reason = "Extrapolated values: the last of Richardson's corrections from three steps, "
                           "which is the error before it was made."});
  record(pendulum, {.quantity = "order in h of the angle at 10 s",
                    .expected = 4,
                    .source = "Runge and Kutta",
                    .measured = x.order,
                    .budget = 0.5,
                    .budget_reason = "Order: 0.5 tells fourth order from third and fifth."});
}
