// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "accuracy_run.hpp"

#include "estimate.hpp"

namespace drawpoint::benchmarks {
namespace {

constexpr double take_up = 0.5, hold = 1.0, window = 0.01, evaluated = 0.6;  // [s]

support::RockPile moved_to(const SettledState& settled, double offset) {
  support::RockPile pile = settled.pile;
  for (std::size_t k = 0; k < pile.rocks.size(); ++k) {
    pile.rocks[k].start = settled.states[k].pose;
    if (k % 2 == 1) pile.rocks[k].start.translation().z() += offset;
  }
  return pile;
}

double mass_moment(const support::PileWorld& world) {
  double sum = 0;
  for (const engine::Rock& rock : world.world().rocks()) sum += rock.body.mass * rock.pose.translation().x();
  return sum;
}

void sample_rest(AccuracySample& sample, support::PileWorld& world, Progress& progress) {
  const double h = world.world().options().step;
  run_phase(world, "take up", steps_in(take_up, h), progress);
  const auto before = world.states();
  const int steps = steps_in(hold, h);
  sample.ms_rest = run_phase(world, "hold", steps, progress).median();
  const auto states = world.states();
  const support::OverlapStatistics overlap = support::rock_overlaps(world.pile(), states);
  sample.overlap_mean = overlap.mean;
  sample.overlap_p99 = overlap.p99;
  sample.drift = support::drift(before, states, steps * h).mean;
}

void sample_dig(AccuracySample& sample, support::PileWorld& world, Progress& progress) {
  const double h = world.world().options().step;
  const int steps = steps_in(support::RockPile::dig_time, h), skipped = steps - steps_in(evaluated, h);
  const double moment = mass_moment(world);
  std::vector<double> drag;
  int step = 0;
  world.dig();
  sample.ms_dig = run_phase(world, "dig", steps, progress, [&](const auto&) {
                    if (step++ >= skipped) drag.push_back(-world.blade().contact_wrench().force.x());
                  }).mean();
  const std::vector<double> windows = block_means(drag, steps_in(window, h));
  sample.drag = mean_of(windows);
  sample.drag_p95 = percentile(windows, 0.95);
  sample.mass_moved = (mass_moment(world) - moment) / (world.pile().blade.speed * steps * h);
  sample.dig_overlap_p99 = support::rock_overlaps(world.pile(), world.states()).p99;
}

}  // namespace

SettledState settled(support::RockPile pile, const engine::WorldOptions& options, Progress& progress) {
  support::PileWorld world(std::move(pile), options);
  run_phase(world, "settle", steps_in(support::RockPile::settle_time, options.step), progress);
  return {world.pile(), world.states()};
}

AccuracySample accuracy_sample(const SettledState& settled, const engine::WorldOptions& options,
                               double offset, Progress& progress) {
  support::PileWorld world(moved_to(settled, offset), options);
  AccuracySample sample;
  sample_rest(sample, world, progress);
  sample_dig(sample, world, progress);
  return sample;
}

}  // namespace drawpoint::benchmarks
