// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "force_windows.hpp"

#include <chrono>
#include <stdexcept>

#include "estimate.hpp"
#include "pile_run.hpp"

namespace drawpoint::benchmarks {
namespace {

constexpr double force_mean = 0.01;  // [s]

void nudge(engine::World& world, double speed) {
  for (std::size_t k = 1; speed != 0 && k < world.rocks().size(); k += 2) {
    const engine::Rock& rock = world.rocks()[k];
    if (!rock.present) continue;
    world.set_rock_velocity(static_cast<int>(k), rock.velocity + speed * Eigen::Vector3d::UnitZ(),
                            rock.angular_velocity);
  }
}

WindowMeans window_of(engine::World& world, int bucket, const WindowChoice& choice, double length) {
  nudge(world, choice.nudge);
  world.set_solver(choice.solver);
  const int steps = steps_in(length, choice.step), per_mean = std::max(1, steps_in(force_mean, choice.step));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::vector<double> forces;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 1; k <= steps; ++k) {
    world.step(choice.step);
    sum += world.part_wrench(bucket).force / per_mean;
    if (k % per_mean != 0) continue;
    forces.push_back(sum.norm());
    sum.setZero();
  }
  const double ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return {mean_of(forces), ms / steps};
}

}  // namespace

std::vector<std::vector<WindowMeans>> force_windows(engine::loading::Scenario scenario,
                                                    const engine::loading::SettledPile& pile,
                                                    const std::vector<WindowChoice>& choices,
                                                    const WindowOptions& options) {
  scenario.cycles = 1;
  const int bucket = engine::loading::sandvik_lh621(scenario.machine).bucket;
  std::vector<std::vector<WindowMeans>> means(choices.size());
  double next = 0;
  engine::loading::SimulationHooks hooks;
  hooks.look_ahead = [&](engine::World& world) {
    if (world.time() < next || world.part_wrench(bucket).force.norm() < options.force_of_dig) return;
    next = world.time() + options.interval;
    const std::vector<std::byte> state = world.save();
    for (std::size_t k = 0; k < choices.size(); ++k) {
      means[k].push_back(window_of(world, bucket, choices[k], options.length));
      world.set_solver(scenario.world.solver);
      world.restore(state);
    }
  };
  const engine::loading::LoadingLog log = simulate(scenario, pile, hooks);
  if (!log.completed) throw std::runtime_error(log.message);
  return means;
}

}  // namespace drawpoint::benchmarks
