// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/heavy_islands.h>
#include <drawpoint/engine/solver/islands.h>
#include <drawpoint/engine/solver/sequential_solver.h>
#include <algorithm>
#include <limits>
#include <utility>

namespace drawpoint::engine::detail {
namespace {

constexpr double large_ratio = 3000;  // of masses
constexpr std::size_t most_points = 64;
constexpr int first_iterations = 8;  // per substep, which find most of what touches and slides

}  // namespace

bool masses_differ(const std::vector<SolverBody>& bodies) {
  double least = std::numeric_limits<double>::infinity(), most = 0;  // inverse masses
  for (const SolverBody& body : bodies) {
    if (!(body.inverse_mass > 0)) continue;
    least = std::min(least, body.inverse_mass);
    most = std::max(most, body.inverse_mass);
  }
  return most >= large_ratio * least;
}

bool solvable_directly(const ContactProblem& problem) {
  return !problem.machine && problem.points.size() <= most_points && masses_differ(problem.bodies);
}

void HeavyIslands::take(const ContactProblem& problem) {
  islands_.clear();
  if (!masses_differ(problem.bodies)) return;
  const Islands found = find_islands(problem, problem.pairs);
  std::vector<std::vector<int>> pairs(found.count);
  for (std::size_t k = 0; k < problem.pairs.size(); ++k)
    pairs[found.of_pair[k]].push_back(static_cast<int>(k));
  place_.assign(problem.bodies.size(), -1);
  for (const std::vector<int>& island : pairs) {
    std::size_t points = 0;
    bool machine = false;
    for (const int k : island) {
      points += static_cast<std::size_t>(problem.pairs[k].count);
      machine = machine || problem.pairs[k].a < 0 || problem.pairs[k].b < 0;
    }
    if (machine || points == 0 || points > most_points) continue;
    Island copied = copy(problem, island);
    if (masses_differ(copied.problem.bodies)) islands_.push_back(std::move(copied));
  }
}

HeavyIslands::Island HeavyIslands::copy(const ContactProblem& problem, const std::vector<int>& pairs) {
  Island island;
  island.pairs = pairs;
  island.problem.step = problem.step;
  const auto place = [&](int body) {
    if (place_[body] < 0) {
      place_[body] = static_cast<int>(island.bodies.size());
      island.bodies.push_back(body);
      island.problem.bodies.push_back(problem.bodies[body]);
    }
    return place_[body];
  };
  for (const int k : pairs) {
    ContactPair pair = problem.pairs[k];
    const auto first = problem.points.begin() + pair.first;
    pair.first = static_cast<int>(island.problem.points.size());
    island.problem.points.insert(island.problem.points.end(), first, first + pair.count);
    pair.a = place(pair.a);
    pair.b = place(pair.b);
    island.problem.pairs.push_back(pair);
  }
  for (const int body : island.bodies) place_[body] = -1;
  return island;
}

void HeavyIslands::solve(ContactProblem& problem, const SolverOptions& options) {
  SolverOptions direct = options;
  direct.iterations = std::max(options.iterations, first_iterations);
  direct.iteration_budget = 0;
  for (Island& island : islands_) {
    solve_directly(island.problem, direct);
    put(island, problem);
  }
}

void HeavyIslands::put(const Island& island, ContactProblem& problem) const {
  for (std::size_t k = 0; k < island.bodies.size(); ++k)
    if (can_move(island.problem.bodies[k])) problem.bodies[island.bodies[k]] = island.problem.bodies[k];
  for (std::size_t k = 0; k < island.pairs.size(); ++k) {
    const ContactPair& from = island.problem.pairs[k];
    ContactPair& to = problem.pairs[island.pairs[k]];
    to.start = from.start;
    to.impulse = from.impulse;
    std::copy_n(island.problem.points.begin() + from.first, from.count, problem.points.begin() + to.first);
  }
}

}  // namespace drawpoint::engine::detail
