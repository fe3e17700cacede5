// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "pile_run.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace drawpoint::benchmarks {
namespace {

void check_sound(const support::PileWorld& world, const std::string& phase) {
  for (std::size_t k = 0; k < world.world().rocks().size(); ++k) {
    const engine::Rock& rock = world.world().rocks()[k];
    double inside = std::numeric_limits<double>::infinity();
    for (const support::PileWall& wall : world.pile().walls)
      inside = std::min(inside, wall.normal.dot(rock.pose.translation()) - wall.offset);
    if (inside > -1 && rock.pose.matrix().allFinite() && rock.velocity.allFinite()) continue;
    throw std::runtime_error("rock " + std::to_string(k) + " left the box during \"" + phase +
                             "\", t = " + std::to_string(world.world().time()) +
                             " s: the contact solution broke down; use a smaller step or more iterations");
  }
}

}  // namespace

double PhaseTimes::median() const {
  if (wall.empty()) return 0;
  std::vector<double> sorted = wall;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  return 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
}

double PhaseTimes::mean() const {
  if (wall.empty()) return 0;
  return std::accumulate(wall.begin(), wall.end(), 0.0) / static_cast<double>(wall.size());
}

nlohmann::json PhaseTimes::parts() const {
  const double n = static_cast<double>(std::max<std::size_t>(1, wall.size()));
  return {{"broad", broad / n},
          {"narrow", narrow / n},
          {"solver", solver / n},
          {"machine", machine / n},
          {"rest", rest / n}};
}

engine::StepReport add_step(PhaseTimes& times, engine::World& world) {
  const auto start = std::chrono::steady_clock::now();
  engine::StepReport report;
  try {
    report = world.step();
  } catch (const std::invalid_argument& error) {  // a pose that is not finite, told by the contact finder
    throw std::runtime_error("the contact solution broke down at t = " + std::to_string(world.time()) +
                             " s; use a smaller step or more iterations (" + error.what() + ")");
  }
  times.wall.push_back(
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  times.broad += 1e3 * report.broad_s;
  times.narrow += 1e3 * report.narrow_s;
  times.solver += 1e3 * report.solver_s;
  times.machine += 1e3 * report.machine_s;
  times.rest += 1e3 * report.rest_s;
  times.points = report.points;
  times.manifolds = report.manifolds;
  times.computed += report.computed;
  times.refused += report.refused;
  times.complementarity = std::max(times.complementarity, report.complementarity);
  times.cone = std::max(times.cone, report.cone);
  return report;
}

PhaseTimes run_phase(support::PileWorld& world, const std::string& name, int steps, Progress& progress,
                     const AfterStep& after) {
  PhaseTimes times;
  for (int k = 0; k < steps; ++k) {
    const engine::StepReport report = add_step(times, world.world());
    if (after) after(report);
    progress.show(name, k + 1, steps);
  }
  check_sound(world, name);
  return times;
}

int steps_in(double seconds, double step) {
  return std::max(1, static_cast<int>(std::lround(seconds / step)));
}

}  // namespace drawpoint::benchmarks
