// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <drawpoint/engine/contact/solver.hpp>
#include <drawpoint/tests/support/rocks.hpp>

/// Nanoseconds a contact point a sweep, on the contacts of a heap of rocks that has come to rest in a box.
using namespace drawpoint;
using engine::contact::ContactProblem;
using engine::contact::World;

namespace {

// Rocks on a lattice in a 3 m x 3 m box, fallen together for three seconds.
World settled_heap(int rocks) {
  World world({}, support::one_material({0.9, 0.5, 1e9, 0}));
  support::add_floor(world);
  for (const Eigen::Vector3d& n : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0),
                                   Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)})
    world.add_static(support::shared(engine::contact::HalfSpace{n, -1.5}), Eigen::Isometry3d::Identity(), 0);
  for (int k = 0; k < rocks; ++k)
    world.add_rock(support::rock_body(k % 6, 0.4),
                   support::at(-1.1 + 0.55 * (k % 5), -1.1 + 0.55 * (k / 5 % 5), 0.3 + 0.5 * (k / 25)));
  for (int step = 0; step < 600; ++step) world.step();
  return world;
}

const ContactProblem& resting_problem(int rocks) {
  static std::map<int, ContactProblem> made;
  const auto found = made.find(rocks);
  return found != made.end() ? found->second
                             : made.emplace(rocks, settled_heap(rocks).problem()).first->second;
}

void contact_sweeps(benchmark::State& state) {
  const ContactProblem& recorded = resting_problem(static_cast<int>(state.range(0)));
  const int sweeps = static_cast<int>(state.range(1));
  for (auto _ : state) {
    state.PauseTiming();
    ContactProblem problem = recorded;
    state.ResumeTiming();
    benchmark::DoNotOptimize(engine::contact::solve(problem, {.sweeps = sweeps}));
  }
  const double work = static_cast<double>(recorded.points.size()) * sweeps;
  state.counters["points"] = static_cast<double>(recorded.points.size());
  state.counters["time_per_point_sweep"] =
      benchmark::Counter(work, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

BENCHMARK(contact_sweeps)
    ->Args({200, 20})
    ->Args({200, 150})
    ->Args({800, 20})
    ->Args({800, 150})
    ->Unit(benchmark::kMillisecond);
