// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <drawpoint/engine/solver/batch/iteration_order.h>
#include <drawpoint/engine/solver/batch/pair_batch.h>
#include <drawpoint/engine/solver/sequential_iteration.h>
#include <algorithm>
#include <chrono>
#include <drawpoint/benchmarks/micro/contact_methods.hpp>
#include <drawpoint/tests/support/rocks.hpp>
#include <map>

/// Nanoseconds per contact point and iteration, and the share of the memory's speed that the iterations use.
///
/// The contacts are those of a heap of rocks in a box, at rest or while a wall pushes through it; a solve is
/// one substep of many iterations, so that making it ready hardly counts. `bytes_per_point` is what an
/// iteration streams through: the constraint data of all points and pairs, bodies not counted, because they
/// are read again from the cache. `triad` is a[i] = b[i] + s c[i], 24 bytes per element, over arrays that
/// together are as large; `share_of_triad` is bytes streamed per second over the triad's at the nearest size.
using namespace drawpoint;
using engine::ContactProblem;
using engine::World;
namespace detail = engine::detail;

namespace {

// Rocks on a lattice in a 3 m x 3 m box, fallen together for three seconds; digging, a block of 1 m then
// goes through them at 1 m/s for half a second.
ContactProblem heap_problem(int rocks, bool digging) {
  World world({}, support::one_material({0.9, 0.5, 1e9, 0}));
  support::add_floor(world);
  for (const Eigen::Vector3d& n : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0),
                                   Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)})
    world.add_static(support::shared(engine::HalfSpace{n, -1.5}), Eigen::Isometry3d::Identity(), 0);
  for (int k = 0; k < rocks; ++k)
    world.add_rock(support::rock_body(k % 6, 0.4),
                   support::at(-1.1 + 0.55 * (k % 5), -1.1 + 0.55 * (k / 5 % 5), 0.3 + 0.5 * (k / 25)));
  for (int step = 0; step < 600; ++step) world.step();
  if (digging) {
    const int block =
        world.add_rock(support::box_body({0.1, 0.5, 0.5}, 5e4), support::at(-1.3, 0, 0.6), {1, 0, 0});
    for (int step = 0; step < 100; ++step) {
      world.set_rock_velocity(block, {1, 0, 0}, {0, 0, 0});
      world.step();
    }
  }
  ContactProblem problem;
  world.before_solve([&](const ContactProblem& p) { problem = p; });
  world.step();
  return problem;
}

const ContactProblem& problem_of(int rocks, bool digging) {
  static std::map<std::pair<int, bool>, ContactProblem> made;
  const auto key = std::make_pair(rocks, digging);
  if (!made.contains(key)) made.emplace(key, heap_problem(rocks, digging));
  return made.at(key);
}

double bytes_of_a_sequential_iteration(const ContactProblem& problem) {
  return static_cast<double>(problem.points.size() * sizeof(detail::PointBlock) +
                             problem.pairs.size() * sizeof(detail::PairBlock));
}

// A batch has as many point batches as its largest pair has points.
double bytes_of_a_batched_iteration(const ContactProblem& problem) {
  const detail::IterationOrder order = detail::iteration_order(problem, detail::batch_lanes);
  double bytes = 0;
  for (std::size_t k = 0; k + 1 < order.batches.size(); ++k)
    bytes += sizeof(detail::PairBatch) +
             sizeof(detail::PointBatch) * problem.pairs[order.pairs[order.batches[k]]].count;
  return bytes;
}

// Bytes per second of the triad over arrays of so many bytes together; once per size, best of many passes.
double triad_speed(double bytes) {
  const auto length = static_cast<std::size_t>(bytes / 24);
  const int passes = std::max(20, static_cast<int>(2e8 / bytes));
  std::vector<double> a(length, 0), b(length, 1), c(length, 2);
  double least = 1e300;
  for (int k = 0; k < passes; ++k) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < length; ++i) a[i] = b[i] + 3 * c[i];
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 24.0 * static_cast<double>(length) / least;
}

void iterations(benchmark::State& state, const std::string& method, bool digging) {
  constexpr int count = 200;
  const ContactProblem& recorded = problem_of(static_cast<int>(state.range(0)), digging);
  const auto solve = benchmarks::ready(benchmarks::contact_method(method), benchmarks::fixed_work(1, count));
  for (auto _ : state) {
    state.PauseTiming();
    ContactProblem problem = recorded;
    state.ResumeTiming();
    benchmark::DoNotOptimize(solve(problem));
  }
  const double points = static_cast<double>(recorded.points.size()), work = points * count;
  const double bytes = method == "sequential" ? bytes_of_a_sequential_iteration(recorded)
                                              : bytes_of_a_batched_iteration(recorded);
  using benchmark::Counter;
  state.counters["points"] = points;
  state.counters["time_per_point_sweep"] =
      Counter(work, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["bytes_per_point"] = bytes / points;
  state.counters["share_of_triad"] =
      Counter(bytes * count / triad_speed(bytes), Counter::kIsIterationInvariantRate);
}

void triad(benchmark::State& state) {
  double speed = 0;
  for (auto _ : state) speed = std::max(speed, triad_speed(static_cast<double>(state.range(0))));
  state.counters["bytes_per_second"] = speed;
}

}  // namespace

BENCHMARK_CAPTURE(iterations, sequential_rest, "sequential", false)->Arg(200)->Arg(800);
BENCHMARK_CAPTURE(iterations, sequential_dig, "sequential", true)->Arg(800);
BENCHMARK_CAPTURE(iterations, batched_rest, "batched", false)->Arg(200)->Arg(800)->Arg(3000);
BENCHMARK_CAPTURE(iterations, batched_dig, "batched", true)->Arg(800)->Arg(3000);
BENCHMARK(triad)->Arg(1 << 18)->Arg(1 << 21)->Arg(1 << 28)->Iterations(1);
