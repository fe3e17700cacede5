// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <drawpoint/tests/validation/settings.hpp>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;
using validation::record;

namespace {

const validation::Problem bouncing{
    "bouncing", validation::Group::impact, "Bouncing block",
    "A cube of 0.4 m falls flat on the floor from 1 m and bounces twice, with restitution 0.5 and "
    "0.9, at 1e12 N/m, in steps of 1 ms by the reference settings."};

constexpr double g = 9.81, h = 1e-3, side = 0.4;

World with_restitution(double e) {
  engine::Material material{0.5, 0, 1e12, 0};
  material.restitution = e;
  return World(validation::reference_settings(h), support::one_material(material));
}

// The highest points after the first and second bounce.
std::array<double, 2> bounces(double e, double height) {
  World world = with_restitution(e);
  support::add_floor(world);
  world.add_rock(support::box_body(Vector3d::Constant(side / 2)), support::at(0, 0, side / 2 + height));
  std::array<double, 2> tops{};
  int bounce = -1;
  double before = 0;
  while (world.time() < 3) {
    world.step();
    const auto& rock = world.rocks()[0];
    const double v = rock.velocity.z();
    if (before < 0 && v > 0) ++bounce;
    before = v;
    if (bounce >= 0 && bounce < 2)
      tops[bounce] = std::max(tops[bounce], rock.pose.translation().z() - side / 2);
  }
  return tops;
}

}  // namespace

// The impact falls up to a step early, at the height d ≤ v h. Between impacts the stepper keeps v²/2 + g z −
// g h v/2 exactly: v²/2 = g (H − d) − g h |v|/2 on the way down, and the top is d + e² v²/(2g) − h e |v|/2.
// Together e² H + d (1 − e²) − (e² + e) h |v|/2, with |v| ≤ √(2 g H), seen at a step: g h²/8 lower. An error
// of one top is passed on to the next times e².
TEST(Bouncing, Heights) {
  for (const double e : {0.5, 0.9}) {
    const auto tops = bounces(e, 1);
    double exact = 1, error = 0;
    for (int k = 0; k < 2; ++k) {
      const double fall = std::sqrt(2 * g * (exact + error));
      error = e * e * error + h * fall * ((1 - e * e) + (e * e + e) / 2) + g * h * h / 8;
      exact *= e * e;
      record(
          bouncing,
          {.quantity =
               std::string(k == 0 ? "height of the first bounce, e = " : "height of the second, e = ") +
               (e < 0.6 ? "0.5" : "0.9"),
           .unit = "m",
           .expected = exact,
           .source = "e² H a bounce",
           .measured = tops[k],
           .budget = error,
           .budget_reason =
               "Heights: the impact falls up to v h above the floor and the stepper's energy is off by g h "
               "v/2 before and after: h v (1 − e²) + h v (e² + e)/2 per bounce, passed on times e²."});
    }
  }
}
