// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/islands.h>
#include <algorithm>
#include <numeric>

namespace drawpoint::engine::detail {
namespace {

int root_of(std::vector<int>& parents, int node) {
  while (parents[node] != node) node = parents[node] = parents[parents[node]];
  return node;
}

}  // namespace

bool can_move(const SolverBody& body) {
  return body.inverse_mass > 0 || body.inverse_inertia.cwiseAbs().maxCoeff() > 0;
}

Islands find_islands(const ContactProblem& problem, const std::vector<ContactPair>& pairs) {
  const int bodies = static_cast<int>(problem.bodies.size());
  std::vector<int> parents(static_cast<std::size_t>(bodies) + 1);  // the machine behind the bodies
  std::iota(parents.begin(), parents.end(), 0);
  const auto node = [&](int index) {
    return index < 0 ? bodies : can_move(problem.bodies[index]) ? index : -1;
  };
  for (const ContactPair& pair : pairs) {
    const int a = node(pair.a), b = node(pair.b);
    if (a >= 0 && b >= 0) parents[root_of(parents, a)] = root_of(parents, b);
  }
  std::vector<int> number(parents.size(), -1);
  Islands islands;
  for (const ContactPair& pair : pairs) {
    int& island = number[root_of(parents, std::max({node(pair.a), node(pair.b), 0}))];
    if (island < 0) island = islands.count++;
    islands.of_pair.push_back(island);
  }
  return islands;
}

}  // namespace drawpoint::engine::detail
