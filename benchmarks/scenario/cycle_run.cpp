// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "cycle_run.hpp"

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/random.hpp>
#include <stdexcept>

#include "estimate.hpp"
#include "pile_run.hpp"

namespace drawpoint::benchmarks {
namespace {

constexpr double cycle_window = 0.01;  // [s]

double mean_bucket_force(const engine::loading::LoadingLog& log, double step) {
  const auto component = [&](const char* name) {
    return block_means(log.signals.column(name),
                       static_cast<std::size_t>(std::max(1, steps_in(cycle_window, step))));
  };
  const auto x = component("hinge_G_force_x"), y = component("hinge_G_force_y"),
             z = component("hinge_G_force_z");
  std::vector<double> force;
  for (std::size_t k = 0; k < x.size(); ++k) force.push_back(std::hypot(x[k], y[k], z[k]));
  return mean_of(force);
}

}  // namespace

engine::loading::Scenario with_pile(engine::loading::Scenario scenario, const std::filesystem::path& folder,
                                    int seed) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error(folder.string() + ": no folder for piles can be made here (" + error.message() +
                             "); name one that is there or that can be made");
  scenario.pile.seed = static_cast<std::uint64_t>(seed);
  scenario.pile_file = folder / ("pile_" + std::to_string(seed) + ".h5");
  return scenario;
}

engine::loading::SettledPile displaced(engine::loading::SettledPile pile, std::uint64_t seed, double most) {
  engine::CounterRandom random(seed);
  for (auto& rock : pile.rocks) rock.pose.translation().z() += most * random.uniform();
  return pile;
}

CycleSample cycle_run(engine::loading::Scenario scenario, const engine::loading::SettledPile& pile) {
  scenario.cycles = 1;
  CycleSample sample;
  int steps = 0;
  engine::loading::SimulationHooks hooks;
  hooks.on_step = [&](const engine::StepReport& r) {
    sample.contact_ms += 1e3 * (r.broad_s + r.narrow_s + r.solver_s + r.rest_s);
    sample.mean_deepest_overlap += r.max_overlap;
    ++steps;
  };
  const engine::loading::LoadingLog log = simulate(scenario, pile, hooks);
  if (!log.completed) throw std::runtime_error(log.message);
  sample.ms_step = sample.contact_ms / steps;
  sample.mean_deepest_overlap /= steps;
  sample.bucket_force = mean_bucket_force(log, scenario.world.step);
  sample.loaded_mass = log.cycles.front().loaded_mass;
  return sample;
}

}  // namespace drawpoint::benchmarks
