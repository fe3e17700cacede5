// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

struct Case {
  int n, m;
  std::size_t fronts, first;
};

// Numbers of fronts and of points on the first one, on which pagmo 2.18 and moocore 0.20 agree. They are
// whole numbers: no tolerance.
class Fronts : public testing::TestWithParam<Case> {};

TEST_P(Fronts, AreThoseOfOtherPrograms) {
  const auto [n, m, fronts, first] = GetParam();
  const Eigen::MatrixXd Y = support::cube_points(n, m, static_cast<doe::Seed>(1000 + m));
  const auto sorted = non_dominated_sort(Y);
  EXPECT_EQ(sorted.size(), fronts);
  EXPECT_EQ(sorted.front().size(), first);
  EXPECT_EQ(non_dominated(Y), sorted.front());
}

INSTANTIATE_TEST_SUITE_P(UniformCube, Fronts,
                         testing::Values(Case{200, 2, 28, 9}, Case{200, 3, 11, 27}, Case{200, 6, 3, 90},
                                         Case{1000, 2, 63, 12}, Case{1000, 3, 19, 18}, Case{1000, 6, 5, 278},
                                         Case{10000, 2, 190, 8}, Case{10000, 3, 47, 28},
                                         Case{10000, 6, 10, 843}));

}  // namespace
