// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/rocks.hpp>
#include <drawpoint/tests/validation/extrapolation.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <drawpoint/tests/validation/settings.hpp>

using namespace drawpoint;
using Eigen::Vector3d;
using validation::record;

namespace {

const validation::Problem free_rotation{
    "free_rotation", validation::Group::single_body, "Torque-free rotation of a rock",
    "A block of 0.2 m x 0.4 m x 0.7 m spins freely at about 5 rad/s, mostly about its middle axis, "
    "for 10 s in steps of 5 ms (2.5 and 1.25 ms for the order)."};

constexpr double h = 0.005, duration = 10;
const Vector3d start(0.3, 5, 0.4);  // [rad/s], in the block's axes, which are the world's at the start

engine::RockBody block() { return support::box_body({0.1, 0.2, 0.35}, 4500); }

struct Spin {
  Vector3d rate;  // at the end, in the body's axes
  double worst_momentum = 0, worst_energy = 0;
};

Spin spin(double step) {
  engine::WorldOptions options = validation::reference_settings(step);
  options.gravity = Vector3d::Zero();
  engine::World world(options, support::one_material({.friction = 0}));
  world.add_rock(block(), Eigen::Isometry3d::Identity(), Vector3d::Zero(), start);
  const Vector3d inertia = block().inertia;
  const auto momentum = [&] {
    const auto& rock = world.rocks()[0];
    const Eigen::Matrix3d R = rock.pose.linear();
    return Vector3d(R * inertia.cwiseProduct(R.transpose() * rock.angular_velocity));
  };
  const Vector3d L = momentum();
  const double energy = world.kinetic_energy();
  Spin result;
  for (int n = 0; n < static_cast<int>(std::lround(duration / step)); ++n) {
    world.step();
    result.worst_momentum = std::max(result.worst_momentum, (momentum() - L).norm() / L.norm());
    result.worst_energy = std::max(result.worst_energy, std::abs(world.kinetic_energy() / energy - 1));
  }
  const auto& rock = world.rocks()[0];
  result.rate = rock.pose.linear().transpose() * rock.angular_velocity;
  return result;
}

// Euler's equations in the body's axes, I ω' = I ω × ω, by the classical Runge-Kutta rule.
Vector3d euler(double dt) {
  const Vector3d inertia = block().inertia;
  const auto slope = [&](const Vector3d& w) {
    return Vector3d(inertia.cwiseProduct(w).cross(w).cwiseQuotient(inertia));
  };
  Vector3d w = start;
  for (int n = 0; n < static_cast<int>(std::lround(duration / dt)); ++n) {
    const Vector3d k1 = slope(w), k2 = slope(w + dt / 2 * k1), k3 = slope(w + dt / 2 * k2),
                   k4 = slope(w + dt * k3);
    w += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return w;
}

const std::vector<Spin>& spins() {
  static const std::vector<Spin> all{spin(h), spin(h / 2), spin(h / 4)};
  return all;
}

}  // namespace

TEST(FreeRotation, KeepsMomentumAndEnergy) {
  record(free_rotation,
         {.quantity = "largest relative change of angular momentum",
          .expected = 0,
          .source = "conservation",
          .measured = spins()[0].worst_momentum,
          .budget = duration / h * 20 * 1.1e-16,
          .budget_reason =
              "Momentum: the turn keeps it but for some twenty roundings of 1.1e-16 in each of 2000 steps."});
  record(
      free_rotation,
      {.quantity = "largest relative change of energy",
       .expected = 0,
       .source = "conservation",
       .measured = spins()[0].worst_energy,
       .budget = std::pow(h * start.norm(), 2) / 8,
       .budget_reason =
           "Energy: Strang's rule of two flows A and B changes it by h²(B²A/12 − A²B/24) in nested brackets, "
           "A and B turning at rates below ω: by less than (hω)²/8; it swings by that and does not drift."});
  const auto energy = validation::extrapolate(
      {spins()[0].worst_energy, spins()[1].worst_energy, spins()[2].worst_energy}, 2, 2);
  record(free_rotation, {.quantity = "order in h of the change of energy",
                         .expected = 2,
                         .source = "Strang's rule",
                         .measured = energy.order,
                         .budget = 0.2,
                         .budget_reason = "Order: 0.2 tells second order from first and third."});
}

TEST(FreeRotation, FollowsEulersEquations) {
  const Vector3d exact = euler(5e-4), reference_error = exact - euler(1e-3);
  std::vector<validation::Extrapolated> found;
  double correction = reference_error.norm();
  for (int k = 0; k < 3; ++k) {
    found.push_back(
        validation::extrapolate({spins()[0].rate[k], spins()[1].rate[k], spins()[2].rate[k]}, 2, 2));
    correction = std::max(correction, found.back().correction);
  }
  const std::array<const char*, 3> names{
      "rate about the largest moment's axis at 10 s, extrapolated to h = 0",
      "rate about the middle axis, extrapolated to h = 0",
      "rate about the smallest moment's axis, extrapolated to h = 0"};
  for (int k = 0; k < 3; ++k)
    record(free_rotation,
           {.quantity = names[k],
            .unit = "rad/s",
            .expected = exact[k],
            .source = "Euler's equations, Runge-Kutta",
            .measured = found[k].value,
            .budget = correction,
            .budget_reason = "Rates: the last of Richardson's corrections (even powers of h) from three "
                             "steps, the largest of the three axes."});
}
