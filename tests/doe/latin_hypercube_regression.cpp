// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/tests/doe/problems.hpp>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

// Values of an independent NumPy implementation of splitmix64 and of the same Latin hypercube, printed with
// eight digits: the stored numbers are rounded, so half a unit of the last digit is the whole tolerance.
// Published comparisons of Kriging codes use these designs, and so do this project's.
constexpr double rounding = 0.5e-8;

void expect_first_row(int runs, Seed seed, const Eigen::RowVector4d& expected) {
  const Eigen::MatrixXd X = latin_hypercube(support::unit_problem(4), runs, {.seed = seed, .corners = false});
  EXPECT_LE((X.row(0) - expected).cwiseAbs().maxCoeff(), rounding) << X.row(0);
}

TEST(LatinHypercube, TheTrainingDesignOf100Runs) {
  expect_first_row(100, 1100, {0.41583424, 0.14463602, 0.05350111, 0.18301584});
}

TEST(LatinHypercube, TheTestDesignOf2000Runs) {
  expect_first_row(2000, 999, {0.61037633, 0.15774357, 0.67962024, 0.26200003});
}

}  // namespace
