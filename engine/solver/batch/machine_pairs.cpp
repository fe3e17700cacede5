// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/batch/machine_pairs.h>
#include <algorithm>
#include <cassert>

namespace drawpoint::engine::detail {

MachinePairs::MachinePairs(const ContactProblem& problem, const std::vector<int>& row_of, int substeps)
    : part_(part_of_problem(problem, row_of, rows_, members_)), iteration_(part_, substeps) {}

ContactProblem MachinePairs::part_of_problem(const ContactProblem& problem, const std::vector<int>& row_of,
                                             std::vector<int>& rows, std::vector<int>& members) {
  ContactProblem part;
  part.step = problem.step;
  part.machine = problem.machine;
  std::vector<int> place(problem.bodies.size(), -1);
  const auto placed = [&](int index) {
    if (index < 0) return index;
    assert(index < static_cast<int>(row_of.size()) && "each body has a row in the batch solve");
    if (place[index] < 0) {
      place[index] = static_cast<int>(rows.size());
      rows.push_back(row_of[index]);
      part.bodies.push_back(problem.bodies[index]);
    }
    return place[index];
  };
  for (std::size_t k = 0; k < problem.pairs.size(); ++k) {
    if (problem.pairs[k].a >= 0 && problem.pairs[k].b >= 0) continue;
    ContactPair pair = problem.pairs[k];
    members.push_back(static_cast<int>(k));
    const auto first = problem.points.begin() + pair.first;
    pair.a = placed(pair.a);
    pair.b = placed(pair.b);
    pair.first = static_cast<int>(part.points.size());
    part.points.insert(part.points.end(), first, first + pair.count);
    part.pairs.push_back(pair);
  }
  return part;
}

bool MachinePairs::touches_bodies() const {
  return std::any_of(part_.bodies.begin(), part_.bodies.end(),
                     [](const SolverBody& body) { return body.inverse_mass > 0; });
}

void MachinePairs::gather_bodies(const std::vector<BodyRow>& bodies) {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const BodyRow& row = bodies[rows_[k]];
    part_.bodies[k].velocity = {row.velocity[0], row.velocity[1], row.velocity[2]};
    part_.bodies[k].angular_velocity = {row.angular_velocity[0], row.angular_velocity[1],
                                        row.angular_velocity[2]};
  }
}

void MachinePairs::put_back(std::vector<BodyRow>& bodies) const {
  for (std::size_t k = 0; k < rows_.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      bodies[rows_[k]].velocity[i] = static_cast<float>(part_.bodies[k].velocity[i]);
      bodies[rows_[k]].angular_velocity[i] = static_cast<float>(part_.bodies[k].angular_velocity[i]);
    }
}

void MachinePairs::refresh(const std::vector<BodyRow>& end) {
  gather_bodies(end);
  iteration_.refresh();
}

void MachinePairs::start(std::vector<BodyRow>& bodies) {
  gather_bodies(bodies);
  iteration_.start();
  put_back(bodies);
}

void MachinePairs::correct(std::vector<BodyRow>& bodies) {
  gather_bodies(bodies);
  iteration_.correct();
  put_back(bodies);
}

double MachinePairs::iteration(std::vector<BodyRow>& bodies) {
  gather_bodies(bodies);
  const double change = iteration_.iteration();
  put_back(bodies);
  return change;
}

ResidualSums MachinePairs::residual_sums(const std::vector<BodyRow>& bodies) {
  gather_bodies(bodies);
  return iteration_.residual_sums();
}

SuperBodySolution MachinePairs::store(ContactProblem& problem) {
  const SuperBodySolution solution = iteration_.store();
  for (std::size_t k = 0; k < members_.size(); ++k) {
    ContactPair& pair = problem.pairs[members_[k]];
    pair.start = part_.pairs[k].start;
    pair.impulse = part_.pairs[k].impulse;
    for (int i = 0; i < pair.count; ++i) {
      problem.points[pair.first + i].start = part_.points[part_.pairs[k].first + i].start;
      problem.points[pair.first + i].impulse = part_.points[part_.pairs[k].first + i].impulse;
      problem.points[pair.first + i].warm_start_fraction =
          part_.points[part_.pairs[k].first + i].warm_start_fraction;
    }
  }
  return solution;
}

}  // namespace drawpoint::engine::detail
