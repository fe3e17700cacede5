// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <time.h>

#include <algorithm>
#include <cassert>
#include <drawpoint/benchmarks/micro/evaluated_solve.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

namespace drawpoint::benchmarks {
namespace {

using namespace engine;

// One thread is timed by its processor time, which other programs lengthen least; several by the clock.
double now(int threads) {
  timespec t{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Of one solve [s]; `solved` gets the solution.
double time_of(const ContactProblem& problem, const Ready& method, int threads, Solved& solved) {
  solved.problem = problem;
  const double start = now(threads);
  solved.report = method(solved.problem);
  return now(threads) - start;
}

// Calls run(), which returns the time it took, so often or more: short solves go on for a while, since a
// shared machine changes its speed meanwhile.
template <class Run>
void repeat(int least, const Run& run) {
  constexpr double least_time = 0.4;  // [s]
  double spent = 0;
  for (int k = 0; k < least || spent < least_time; ++k) spent += run();
}

void check(const ContactMethod& method, const MethodOptions& options, int repeats) {
  if (options.iterations < 1 || options.substeps < 1 || options.threads < 1 || repeats < 1)
    throw std::invalid_argument("iterations, substeps, threads and repeats must be at least 1");
  if (options.substeps > 1 && !method.takes_substeps)
    throw std::invalid_argument("method \"" + method.name + "\" solves whole steps; give --substeps 1");
}

}  // namespace

Evaluation evaluate(const ContactProblem& problem, const ContactMethod& method, const MethodOptions& options,
                    int repeats, const Converged& converged) {
  check(method, options, repeats);
  assert(converged.substeps == options.substeps && "a distance is to the limit of as many substeps");
  Solved solved;
  Evaluation j;
  j.milliseconds = std::numeric_limits<double>::infinity();
  const Ready run = ready(method, options);
  time_of(problem, run, options.threads, solved);  // buffers get their size
  repeat(repeats, [&] {
    const double time = time_of(problem, run, options.threads, solved);
    j.milliseconds = std::min(j.milliseconds, 1e3 * time);
    return time;
  });
  j.residual = residual(solved.problem, solved.report.machine, options.substeps);
  j.distance = distance(solved.problem, solved.report.machine, converged.solved.problem,
                        converged.solved.report.machine);
  j.momentum_defect = momentum_defect(problem, solved.problem, solved.report.machine);
  return j;
}

double nanoseconds_per_point_and_iteration(const ContactProblem& problem, const ContactMethod& method,
                                           const MethodOptions& options, int repeats) {
  check(method, options, repeats);
  if (problem.points.empty()) return 0;
  MethodOptions more = options;
  more.iterations += std::max(50, options.iterations);
  Solved solved;
  const Ready run = ready(method, options), run_longer = ready(method, more);
  // Of a long solve and a short one just before, at about the same speed of the machine.
  std::vector<double> differences;
  repeat(repeats, [&] {
    const double brief = time_of(problem, run, options.threads, solved),
                 longer = time_of(problem, run_longer, options.threads, solved);
    differences.push_back(longer - brief);
    return brief + longer;
  });
  const auto median = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), median, differences.end());
  const double work =
      static_cast<double>(problem.points.size()) * options.substeps * (more.iterations - options.iterations);
  return 1e9 * std::max(0.0, *median) / work;
}

}  // namespace drawpoint::benchmarks
