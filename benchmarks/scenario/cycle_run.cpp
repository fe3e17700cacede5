// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "cycle_run.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/random.hpp>
#include <stdexcept>

namespace drawpoint::benchmarks {
namespace {

constexpr double window = 0.01;  // [s]

double mean_bucket_force(const engine::loading::LoadingLog& log, double step) {
  const auto& x = log.signals.column("hinge_G_force_x");
  const auto &y = log.signals.column("hinge_G_force_y"), &z = log.signals.column("hinge_G_force_z");
  const std::size_t rows = static_cast<std::size_t>(std::max(1L, std::lround(window / step)));
  double sum = 0;
  std::size_t windows = 0;
  for (std::size_t first = 0; first + rows <= x.size(); first += rows, ++windows) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (std::size_t k = first; k < first + rows; ++k) force += Eigen::Vector3d(x[k], y[k], z[k]);
    sum += force.norm() / static_cast<double>(rows);
  }
  return sum / static_cast<double>(windows);
}

// A file's name of this process, removed at the end.
struct Scratch {
  explicit Scratch(const std::filesystem::path& beside)
      : path(beside.string() + "." + std::to_string(getpid()) + ".started") {}
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::filesystem::path path;
};

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

CycleSample cycle_run(engine::loading::Scenario scenario, const engine::loading::SettledPile& pile) {
  const Scratch scratch(scenario.pile_file);
  scenario.cycles = 1;
  scenario.pile_file = scratch.path;
  write_pile(scratch.path, pile, scenario);  // the same pile, whatever it was poured with
  CycleSample sample;
  int steps = 0;
  engine::loading::SimulationHooks hooks;
  hooks.on_step = [&](const engine::contact::StepReport& r) {
    sample.contact_ms += 1e3 * (r.broad_s + r.narrow_s + r.solver_s + r.rest_s);
    sample.mean_deepest_overlap += r.max_overlap;
    ++steps;
  };
  const engine::loading::LoadingLog log = simulate(scenario, hooks);
  if (!log.completed) throw std::runtime_error(log.message);
  sample.ms_step = sample.contact_ms / steps;
  sample.mean_deepest_overlap /= steps;
  sample.bucket_force = mean_bucket_force(log, scenario.world.step);
  sample.loaded_mass = log.cycles.front().loaded_mass;
  return sample;
}

}  // namespace drawpoint::benchmarks
