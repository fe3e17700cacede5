// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <cmath>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/pareto/generators.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>
#include <numeric>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

/// The volume by counting unit cells of the box 0..side in m dimensions: exact for whole numbers.
double counted(const Eigen::MatrixXd& Y, int side) {
  const Eigen::Index m = Y.cols();
  Eigen::RowVectorXd cell = Eigen::RowVectorXd::Zero(m);
  double covered = 0.0;
  for (Eigen::Index j = 0; j < m;) {
    covered += ((Y.rowwise() - cell).array() <= 0.0).rowwise().all().any();
    for (j = 0; j < m && ++cell[j] == side; ++j) cell[j] = 0.0;  // the next cell, until all have been visited
  }
  return covered;
}

// Small whole numbers: every product and sum is exact, so equality is.
RC_GTEST_PROP(Hypervolume, IsTheNumberOfCoveredCells, ()) {
  const int m = *rc::gen::inRange(1, 7), side = m <= 4 ? 5 : 3;
  const Eigen::MatrixXd Y = support::whole_points(*rc::gen::inRange(1, 25), m, side + 1);
  RC_ASSERT(hypervolume(Y, Eigen::VectorXd::Constant(m, side)) == counted(Y, side));
}

RC_GTEST_PROP(Hypervolume, OrderOfRowsAndOfObjectivesDoesNotMatter, ()) {
  const int m = *rc::gen::inRange(1, 7);
  const Eigen::MatrixXd Y = support::whole_points(*rc::gen::inRange(1, 25), m, 7);
  const Eigen::MatrixXd shuffled = Y(support::shuffled_rows(Y.rows()), support::shuffled_rows(m));
  const Eigen::VectorXd reference = Eigen::VectorXd::Constant(m, 7.0);
  RC_ASSERT(hypervolume(shuffled, reference) == hypervolume(Y, reference));
}

// Scaling by powers of two and shifting by whole numbers is exact.
RC_GTEST_PROP(Hypervolume, ScalesWithTheUnitsAndIgnoresTheOrigin, ()) {
  const int m = *rc::gen::inRange(1, 7);
  const Eigen::MatrixXd Y = support::whole_points(*rc::gen::inRange(1, 25), m, 7);
  Eigen::RowVectorXd scale(m), shift(m);
  for (double& s : scale) s = std::ldexp(1.0, *rc::gen::resize(100, rc::gen::inRange(-3, 4)));
  for (double& s : shift) s = *rc::gen::resize(100, rc::gen::inRange(-50, 50));
  const Eigen::RowVectorXd reference = Eigen::RowVectorXd::Constant(m, 7.0);
  const Eigen::MatrixXd moved = (Y.rowwise() + shift) * scale.asDiagonal();
  const Eigen::VectorXd moved_reference = ((reference + shift) * scale.asDiagonal()).transpose();
  RC_ASSERT(hypervolume(moved, moved_reference) == scale.prod() * hypervolume(Y, reference.transpose()));
}

// By the definition, point by point; whole numbers, so equality is exact. Dominated and repeated points are
// common in these sets.
RC_GTEST_PROP(HypervolumeContributions, AreWhatTheVolumeLosesWithoutThePoint, ()) {
  const int m = *rc::gen::inRange(1, 7);
  const Eigen::MatrixXd Y = support::whole_points(*rc::gen::inRange(1, 25), m, 7);
  const Eigen::VectorXd reference = Eigen::VectorXd::Constant(m, 6.0);
  const Eigen::VectorXd contributions = hypervolume_contributions(Y, reference);
  for (int i = 0; i < Y.rows(); ++i) {
    std::vector<int> others;
    for (int k = 0; k < Y.rows(); ++k)
      if (k != i) others.push_back(k);
    RC_ASSERT(contributions[i] == hypervolume(Y, reference) - hypervolume(Y(others, Eigen::all), reference));
  }
}

// The sweep over three objectives and the unions box by box are two methods. Of 400 points on a sphere and
// their 400 dominated doubles an error is some n roundings of a point's own box, about 1: 800·1e-16.
TEST(HypervolumeContributions, OfThreeObjectivesByTwoMethods) {
  Eigen::MatrixXd Y(800, 3);
  Y.topRows(400) = support::sphere_points(400, 3, 5);
  Y.bottomRows(400) = Y.topRows(400).array() + 0.02 * support::cube_points(400, 3, 6).array();
  const Eigen::VectorXd reference = Eigen::VectorXd::Constant(3, 1.1);
  Eigen::VectorXd by_unions = Eigen::VectorXd::Zero(800);
  detail::contributions_by_unions<3>(detail::boxes(Y, reference), by_unions);
  EXPECT_LE((hypervolume_contributions(Y, reference) - by_unions).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_GT(by_unions.maxCoeff(), 1e-6);
}

// Some of the points have no box: they reach the reference.
RC_GTEST_PROP(HypervolumeContributions, OfBoxesThatAreLeftAreThoseOfTheirPoints, ()) {
  const int m = *rc::gen::inRange(1, 5);
  const Eigen::MatrixXd Y = support::whole_points(*rc::gen::inRange(1, 25), m, 7);
  const Eigen::VectorXd reference = Eigen::VectorXd::Constant(m, 6.0);
  const auto n = static_cast<int>(Y.rows());
  detail::Boxes boxes = detail::boxes(Y, reference);
  std::vector<int> left(static_cast<std::size_t>(n));
  std::iota(left.begin(), left.end(), 0);
  while (left.size() > 1) {
    const auto gone =
        left.begin() + *rc::gen::inRange<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(left.size()));
    boxes.remove(*gone);
    left.erase(gone);
    const Eigen::VectorXd expected = hypervolume_contributions(Y(left, Eigen::all), reference);
    RC_ASSERT(detail::contributions(boxes, n)(left) == expected);
  }
}

TEST(Hypervolume, PointsBeyondTheReferenceAddNothing) {
  Eigen::MatrixXd Y(3, 4);
  Y << 1, 1, 1, 1, 0, 0, 0, 2, 0, 0, 5, 0;
  EXPECT_EQ(hypervolume(Y, Eigen::VectorXd::Constant(4, 2.0)), 1.0);
  EXPECT_EQ(hypervolume(Y.bottomRows(2), Eigen::VectorXd::Constant(4, 2.0)), 0.0);
  EXPECT_EQ(hypervolume(Eigen::MatrixXd(0, 4), Eigen::VectorXd::Constant(4, 2.0)), 0.0);
}

TEST(Hypervolume, BadInputIsNamed) {
  const auto text = [](const Eigen::MatrixXd& Y, const Eigen::VectorXd& reference) {
    return support::thrown_text<std::invalid_argument>([&] { hypervolume(Y, reference); });
  };
  EXPECT_EQ(
      text(Eigen::MatrixXd::Zero(2, 3), Eigen::VectorXd::Ones(2)),
      "pareto::hypervolume: points has 3 columns, reference has 2 entries; both need one per objective");
  EXPECT_EQ(text(Eigen::MatrixXd::Constant(2, 3, NAN), Eigen::VectorXd::Ones(3)),
            "pareto::hypervolume: points holds NaN or infinity; leave out failed runs");
  EXPECT_EQ(text(Eigen::MatrixXd::Zero(2, 3), Eigen::VectorXd::Constant(3, INFINITY)),
            "pareto::hypervolume: reference holds NaN or infinity; give finite numbers");
  EXPECT_EQ(text(Eigen::MatrixXd::Zero(2, 9), Eigen::VectorXd::Ones(9)),
            "pareto::hypervolume: points has 9 objectives; allowed are up to 8, for the cost grows "
            "exponentially; compare such fronts by pareto::igd_plus");
}

}  // namespace
