// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "cycle_run.hpp"

#include <cmath>
#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/random.hpp>
#include <stdexcept>

namespace drawpoint::benchmarks {
namespace {

double mean_bucket_force(const engine::loading::LoadingLog& log) {
  const auto& x = log.signals.column("hinge_G_force_x");
  const auto &y = log.signals.column("hinge_G_force_y"), &z = log.signals.column("hinge_G_force_z");
  double sum = 0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += std::hypot(x[k], y[k], z[k]);
  return sum / static_cast<double>(x.size());
}

}  // namespace

engine::loading::Scenario with_pile(engine::loading::Scenario scenario, const std::filesystem::path& folder,
                                    int seed) {
  std::filesystem::create_directories(folder);
  scenario.pile.seed = static_cast<std::uint64_t>(seed);
  scenario.pile_file = folder / ("pile_" + std::to_string(seed) + ".h5");
  return scenario;
}

engine::loading::SettledPile displaced(engine::loading::SettledPile pile, std::uint64_t seed, double most) {
  engine::CounterRandom random(seed);
  for (auto& rock : pile.rocks) rock.pose.translation().z() += most * random.uniform();
  return pile;
}

CycleSample cycle_run(engine::loading::Scenario scenario, const engine::loading::SettledPile& pile,
                      const std::filesystem::path& scratch) {
  scenario.cycles = 1;
  scenario.pile_file = scratch;
  write_pile(scratch, pile, scenario);  // the same pile, whatever it was poured with
  CycleSample sample;
  int steps = 0;
  engine::loading::SimulationHooks hooks;
  hooks.on_step = [&](const engine::contact::StepReport& r) {
    sample.contact_ms += 1e3 * (r.broad_s + r.narrow_s + r.solver_s + r.rest_s);
    sample.deepest_overlap += r.max_overlap;
    ++steps;
  };
  const engine::loading::LoadingLog log = simulate(scenario, hooks);
  std::filesystem::remove(scratch);
  if (!log.completed) throw std::runtime_error(log.message);
  sample.ms_step = sample.contact_ms / steps;
  sample.deepest_overlap /= steps;
  sample.bucket_force = mean_bucket_force(log);
  sample.loaded_mass = log.cycles.front().loaded_mass;
  return sample;
}

}  // namespace drawpoint::benchmarks
