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

const validation::Problem pendulum{"pendulum", validation::Group::mechanism,
                                   "Simple pendulum (benchmark A01)",
                                   "A point mass of 1 kg on a hinged arm of 1 m falls from horizontal at "
                                   "rest and swings for 10 s, in steps of "
                                   "1 ms (and 0.5 and 0.25 ms for the order)."};

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

// Seven passages of the lowest point are six half periods apart. Semi-implicit Euler is Störmer-Verlet with
// its speeds half a step late: its period is off by O((ωh)²) only. For small swings (ωh)²/24 = 4e-7; at 90
// deg the stretched shape (K/(π/2) = 1.18) and higher harmonics stay within a factor 4; the interpolation of
// a passage adds h² α/(8 v) with α = 0 at the lowest point.
TEST(Pendulum, Period) {
  const Swing result = swing(h);
  record(pendulum,
         {.quantity = "period, mean of three",
          .unit = "s",
          .expected = 4 * K / omega,
          .source = "4 K(sin 45°) √(L/g)",
          .measured = (result.zero - result.first_zero) / 3,
          .budget = 4 * K / omega * 4 * std::pow(omega * h, 2) / 24,
          .budget_reason =
              "Period: (ωh)²/24 of it for small swings with the Störmer-Verlet rule that the stepper "
              "is in disguise; four times that for a swing of 90°."});
}

// Kick, then drift, keeps H − (h/2) θ' V'(θ) + O(h²): the energy swings by (h/2) max |θ' V'|, with θ' =
// √(2 g sin s), V' = g cos s (s from horizontal), largest where sin² s = 1/3.
TEST(Pendulum, Energy) {
  const double s = std::asin(std::sqrt(1.0 / 3));
  const double swing_of_energy = 0.5 * h * std::sqrt(2 * g * std::sin(s)) * g * std::cos(s);
  record(pendulum,
         {.quantity = "largest change of energy in 10 s",
          .unit = "J",
          .expected = 0,
          .source = "conservation",
          .measured = swing(h).worst_energy,
          .budget = swing_of_energy * (1 + 2 * omega * h),
          .budget_reason =
              "Energy: the rule keeps H − (h/2) θ' V' exactly but for O(h²), so the energy swings by "
              "(h/2) max |θ' V'| and drifts no further; 2ωh of that for the next order."});
}

TEST(Pendulum, AngleAtTheEnd) {
  const auto x = validation::extrapolate({swing(h).angle, swing(h / 2).angle, swing(h / 4).angle});
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
  record(pendulum, {.quantity = "order in h of that angle",
                    .expected = 1,
                    .source = "semi-implicit Euler",
                    .measured = x.order,
                    .budget = 0.2,
                    .budget_reason = "Order: 0.2 tells first order from half and second."});
}
