// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/world/pair_memory.h>

using namespace drawpoint::engine;
using Eigen::Vector3d;

// Two points carry 3 and 1 N s along a tilted normal, and some friction; half of the first is an impact,
// which does not carry over. So 2.5 of 4 N s stay: the moment, whose limit goes with the load, keeps 2.5/4 of
// itself. Six operations on numbers of size 1: 1e-15.
TEST(PairMemory, AMomentKeepsTheShareOfTheLoadThatItsPointsKeep) {
  ContactProblem problem;
  ContactPair pair;
  pair.collider_a = 4;
  pair.collider_b = 9;
  pair.count = 2;
  pair.start = Vector3d(0.3, -0.2, 0.1);
  problem.pairs = {pair};
  const Vector3d normal = Vector3d(1, 2, 2) / 3, tangent = Vector3d(2, 1, -2) / 3;
  for (const double load : {3.0, 1.0}) {
    ContactPoint point;
    point.normal = normal;
    point.start = load * (normal + 0.4 * tangent);
    point.warm_start_fraction = load == 3.0 ? 0.5 : 1.0;
    problem.points.push_back(point);
  }
  detail::PairMemory memory;
  memory.begin_step({0}, 1);
  memory.store(problem, 0);
  EXPECT_LT((memory.start(0, 4, 9).rolling() - 2.5 / 4 * pair.start).norm(), 1e-15);

  for (ContactPoint& point : problem.points) point.warm_start_fraction = 1;
  memory.store(problem, 0);
  EXPECT_EQ(memory.start(0, 4, 9).rolling(), pair.start);
}
