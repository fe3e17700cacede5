// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

struct Case {
  int n, m;
  double volume;
};

// Values on which pagmo 2.18 and moocore 0.20 agree to twelve digits, reference point 1.1 in every objective.
// Half a unit of the twelfth printed digit is 5e-13. The points differ by the last bits of sqrt, log and cos
// between libraries, a few 1e-16 of a coordinate each, and so does the volume, relatively; rounding adds at
// most n·1e-16 = 1e-12 of it for the largest set.
class SpherePoints : public testing::TestWithParam<Case> {};

TEST_P(SpherePoints, HaveTheVolumeOfOtherPrograms) {
  const auto [n, m, volume] = GetParam();
  const Eigen::MatrixXd Y = support::sphere_points(n, m, static_cast<doe::Seed>(10 * m + 1));
  EXPECT_NEAR(hypervolume(Y, Eigen::VectorXd::Constant(m, 1.1)), volume, 5e-13 + 1e-12 * volume);
}

INSTANTIATE_TEST_SUITE_P(Hypervolume, SpherePoints,
                         testing::Values(Case{100, 3, 0.713600989415}, Case{1000, 3, 0.778534229659},
                                         Case{10000, 3, 0.799560273792}, Case{100, 4, 0.891403594963},
                                         Case{1000, 4, 1.060947025005}, Case{300, 5, 1.157585519726},
                                         Case{100, 6, 1.097229296181}, Case{300, 6, 1.298798404944}));

}  // namespace
