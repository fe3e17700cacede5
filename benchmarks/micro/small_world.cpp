// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <drawpoint/tests/support/rocks.hpp>
#include <drawpoint/tests/support/scenes.hpp>
#include <functional>

/// What a step of a world of five bodies costs: fixed costs, which piles hide.
///
/// One iteration of the benchmark is one step, default options. A world is made anew, untimed, every `span` steps: so a
/// fall stays a fall. Counters are means per step: contact points, iterations of the solver, and the step's parts [µs].
using namespace drawpoint;
using engine::World;

namespace {

World floor_world() {
  World world({}, support::one_material({.friction = 0.8}));
  support::add_floor(world);
  return world;
}

// Five cubes of 0.3 m on each other.
World stack() {
  World world = floor_world();
  for (int k = 0; k < 5; ++k)
    world.add_rock(support::box_body({0.15, 0.15, 0.15}), support::at(0, 0, 0.15 + 0.3 * k));
  return world;
}

// Five rocks of 0.3 m side by side, `height` over the floor, turned so that they land on a corner and tumble.
World rocks(double height) {
  World world = floor_world();
  for (int k = 0; k < 5; ++k) {
    Eigen::Isometry3d pose = support::at(0.35 * k, 0, height);
    pose.linear() = Eigen::AngleAxisd(0.5 + k, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    world.add_rock(support::rock_body(k, 0.3), pose);
  }
  return world;
}

World stepped(World world, int steps) {
  for (int k = 0; k < steps; ++k) world.step();
  return world;
}

struct Sums {
  double points = 0, iterations = 0, broad = 0, narrow = 0, solver = 0, rest = 0;

  void add(const engine::StepReport& report) {
    points += report.points;
    iterations += report.iterations;
    broad += 1e6 * report.broad_s;
    narrow += 1e6 * report.narrow_s;
    solver += 1e6 * report.solver_s;
    rest += 1e6 * report.rest_s;
  }
  void show(benchmark::State& state) const {
    const auto mean = [](double sum) { return benchmark::Counter(sum, benchmark::Counter::kAvgIterations); };
    state.counters["points"] = mean(points);
    state.counters["solver_iterations"] = mean(iterations);
    state.counters["broad_us"] = mean(broad);
    state.counters["narrow_us"] = mean(narrow);
    state.counters["solver_us"] = mean(solver);
    state.counters["rest_us"] = mean(rest);
  }
};

void steps(benchmark::State& state, const std::function<World()>& make, int span) {
  World world = make();
  Sums sums;
  int step = 0;
  for (auto _ : state) {
    if (++step > span) {
      state.PauseTiming();
      world = make();
      step = 1;
      state.ResumeTiming();
    }
    sums.add(world.step());
  }
  sums.show(state);
}

}  // namespace

// At rest; the first steps, in which the stack settles; in the air; from the first touch on; at rest again.
BENCHMARK_CAPTURE(
    steps, stack_standing, [] { return stepped(stack(), 200); }, 1'000'000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(steps, stack_settling, stack, 20)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(
    steps, rocks_in_the_air, [] { return rocks(10); }, 100)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(
    steps, rocks_tumbling, [] { return rocks(0.4); }, 100)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(
    steps, rocks_lying, [] { return stepped(rocks(0.4), 1000); }, 1'000'000)
    ->Unit(benchmark::kMicrosecond);
