// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/pareto/polish.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

using doe::Goal;

/// The front that a search would have left: responses at the rows of X.
template <class F>
Front rough_front(const F& f, const doe::Problem& problem, const Eigen::MatrixXd& X) {
  const detail::Roles role = detail::roles(problem);
  Front front;
  front.X = X;
  front.responses.resize(X.rows(), static_cast<Eigen::Index>(problem.responses.size()));
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    front.responses.row(i) = f(X.row(i).transpose()).values.transpose();
  front.Y = front.responses(Eigen::all, role.objectives);
  return front;
}

/// |x - a|² and |x - b|² in four variables of [0, 1]; a and b share x_2 and lie outside the box in x_3: the
/// Pareto set is the segment from a to b with x_3 at its lower bound.
const Eigen::Vector4d a(0.2, 0.3, 0.5, -0.1), b(0.8, 0.5, 0.5, -0.1);

ValueAndJacobian paraboloids(const Eigen::VectorXd& x) {
  ValueAndJacobian y{Eigen::VectorXd(2), Eigen::MatrixXd(2, 4)};
  y.values << (x - a).squaredNorm(), (x - b).squaredNorm();
  y.jacobian << 2.0 * (x - a).transpose(), 2.0 * (x - b).transpose();
  return y;
}

/// Eleven points around the segment, up to 0.05 off it in every variable.
Eigen::MatrixXd around_the_segment() {
  doe::RandomStream random(5);
  Eigen::MatrixXd X(11, 4);
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    X.row(i) = (a + (0.05 + 0.09 * static_cast<double>(i)) * (b - a)).transpose();
    X(i, 3) = 0.05;
    for (double& x : X.row(i)) x += 0.1 * (random.uniform() - 0.5);
  }
  return X;
}

// Ipopt ends where the optimality error in scaled units is below 1e-9: across the segment the gradients grow
// by 2/range > 2 a unit, so x lies within 1e-9 of it; at the bound of x_3, x_3·z <= 1e-9 with the multiplier
// z = 0.2/range > 0.2, so x_3 <= 5e-9. Ten times that is left for the multipliers of the tightened
// constraints. The residual is the part of the gradients that these errors leave, below 2·5e-8 of 2·0.1.
class Forms : public testing::TestWithParam<ScalarForm> {};

TEST_P(Forms, BringEveryPointToTheKnownSet) {
  const doe::Problem problem = support::unit_problem(4, 2);
  const Front rough = rough_front(paraboloids, problem, around_the_segment());
  const Polished polished = polish(paraboloids, problem, rough, {.form = GetParam()});
  EXPECT_EQ(polished.status, PolishStatus::completed);
  EXPECT_EQ(polished.message, "");
  const Eigen::Vector4d direction = (b - a).normalized();
  for (Eigen::Index i = 0; i < rough.X.rows(); ++i) {
    const Eigen::Vector4d x = polished.front.X.row(i).transpose();
    EXPECT_EQ(polished.points[static_cast<std::size_t>(i)], PolishedPoint::improved);
    EXPECT_LE(x[3], 5e-8);
    Eigen::Vector4d across = x - a - direction * direction.dot(x - a);
    across[3] = 0.0;
    EXPECT_LE(across.norm(), 5e-8);
    EXPECT_LE(polished.residual[i], 1e-6);
    EXPECT_GT(polished.residual_before[i], 1e-3);
    EXPECT_TRUE((polished.front.Y.row(i).array() <= rough.Y.row(i).array()).all());
    EXPECT_EQ(polished.front.Y.row(i).transpose(), paraboloids(polished.front.X.row(i).transpose()).values);
  }
  EXPECT_GT(polished.hypervolume, polished.hypervolume_before);
  EXPECT_EQ(polished.hypervolume_before, hypervolume(rough.Y, polished.reference));
  EXPECT_EQ(polished.hypervolume, hypervolume(polished.front.Y, polished.reference));
}

TEST_P(Forms, LeaveATrueOptimumWhereItIs) {
  const doe::Problem problem = support::unit_problem(4, 2);
  Eigen::MatrixXd X(2, 4);
  X << 0.35, 0.35, 0.5, 0.0, 0.5, 0.4, 0.5, 0.0;
  const Front optimal = rough_front(paraboloids, problem, X);
  const Polished polished = polish(paraboloids, problem, optimal, {.form = GetParam()});
  EXPECT_EQ(polished.front.X, optimal.X);
  EXPECT_EQ(polished.points, std::vector<PolishedPoint>(2, PolishedPoint::unchanged));
  EXPECT_LE(polished.residual.maxCoeff(), 1e-14);  // exact but for rounding
}

// Maximise -p, minimise q over [0, 30] x [0, 0.02] (p, q the variables over
// their ranges 20 and 0.01) outside the unit circle: the front is the circle's arc. The limit is kept with
// ten tolerances to spare, 1e-8 of its scale (its range on the front, at most 1): the radius² ends in [1, 1 +
// 1e-7].
// Where the last point's q is above 1, epsilon_constraint may bring p down to 0 and then only ρ presses q
// at the limit: with gradients 1/range_q and 2/scale its multiplier is ρ·scale/(2 range_q), range_q < 1, and
// the slack times the multiplier ends below 1e-9: the radius² may stay 2e-9/ρ = 2e-5 higher.
TEST_P(Forms, KeepALimitInNaturalUnitsAndSigns) {
  const doe::Problem problem{{{"p", "kg", 0.0, 30.0}, {"q", "m", 0.0, 0.015}},
                             {{"less_p", "kg", Goal::maximize},
                              {"wear", "mm", Goal::minimize},
                              {"radius", "1", Goal::at_least, 1.0},
                              {"kept", "1", Goal::record}}};
  const auto f = [](const Eigen::VectorXd& x) {
    const double p = x[0] / 20.0, q = x[1] / 0.01;
    ValueAndJacobian y{Eigen::VectorXd(4), Eigen::MatrixXd(4, 2)};
    y.values << -x[0], 1e3 * x[1], p * p + q * q, p;
    y.jacobian << -1.0, 0.0, 0.0, 1e3, 2.0 * p / 20.0, 2.0 * q / 0.01, 1.0 / 20.0, 0.0;
    return y;
  };
  Eigen::MatrixXd X(8, 2);
  for (Eigen::Index i = 0; i < 8; ++i) {
    const double angle = 0.1 + 0.18 * static_cast<double>(i),
                 radius = 1.05 + 0.01 * static_cast<double>(i % 3);
    X.row(i) << 20.0 * radius * std::cos(angle), 0.01 * radius * std::sin(angle);
  }
  const Polished polished = polish(f, problem, rough_front(f, problem, X), {.form = GetParam()});
  for (Eigen::Index i = 0; i < 8; ++i) {
    const bool pressed_by_augmentation = GetParam() == ScalarForm::epsilon_constraint && X(i, 1) > 0.01;
    EXPECT_GE(polished.front.responses(i, 2), 1.0);
    EXPECT_LE(polished.front.responses(i, 2), 1.0 + 1e-7 + (pressed_by_augmentation ? 2e-5 : 0.0));
    EXPECT_LE(polished.residual[i], 1e-6);
  }
  EXPECT_GT(polished.hypervolume, polished.hypervolume_before);
}

INSTANTIATE_TEST_SUITE_P(Polish, Forms,
                         testing::Values(ScalarForm::chebyshev, ScalarForm::epsilon_constraint),
                         [](const auto& info) {
                           return info.param == ScalarForm::chebyshev ? "chebyshev" : "epsilon_constraint";
                         });

TEST(Polish, APointWhereTheFunctionFailsStays) {
  const doe::Problem problem = support::unit_problem(4, 2);
  const Front rough = rough_front(paraboloids, problem, around_the_segment());
  const auto f = [&](const Eigen::VectorXd& x) {
    if (x == rough.X.row(3).transpose()) throw std::runtime_error("stuck");
    return paraboloids(x);
  };
  const Polished polished = polish(f, problem, rough);
  EXPECT_EQ(polished.points[3], PolishedPoint::failed);
  EXPECT_EQ(polished.front.X.row(3), rough.X.row(3));
  EXPECT_TRUE(std::isnan(polished.residual[3]));
  EXPECT_EQ(polished.points[4], PolishedPoint::improved);
  EXPECT_EQ(polished.status, PolishStatus::points_failed);
  EXPECT_EQ(polished.message,
            "1 of 11 points were left as they were: the function failed there, or the search did not end");
}

TEST(Polish, AnEmptyFrontHasNothingToPolish) {
  Front none;
  none.X.resize(0, 4);
  none.Y.resize(0, 2);
  const Polished polished = polish(paraboloids, support::unit_problem(4, 2), none);
  EXPECT_EQ(polished.status, PolishStatus::empty_front);
  EXPECT_EQ(polished.message, "the front has no points");
}

TEST(Polish, BadInputIsNamed) {
  const doe::Problem problem = support::unit_problem(4, 2);
  const Front rough = rough_front(paraboloids, problem, around_the_segment());
  const auto text = [&](const PolishOptions& options, const doe::Problem& of) {
    return support::thrown_text<std::invalid_argument>([&] { polish(paraboloids, of, rough, options); });
  };
  EXPECT_EQ(text({.objective = 2}, problem),
            "pareto::polish: objective is 2; allowed is 0 to the number of objectives - 1");
  EXPECT_EQ(text({.tolerance = 0.0}, problem), "pareto::polish: tolerance is 0; allowed is above 0");
  EXPECT_EQ(text({.reference = Eigen::VectorXd::Ones(3)}, problem),
            "pareto::polish: reference has 3 entries; give one per objective or leave it out");
  EXPECT_EQ(
      text({}, support::unit_problem(3, 2)),
      "pareto::polish: front has 4 variables and 2 objectives, the problem has 3 and 2; give the front of "
      "this problem");
}

}  // namespace

// The segment again, with x_0 one of 0, 1, 2, 3 in another unit: it keeps the whole number of the search, and
// the others go to their optimum beside it, which for x_2 and x_3 is that of both objectives.
TEST_P(Forms, LeaveWholeNumbersWhole) {
  doe::Problem problem = support::unit_problem(4, 2);
  problem.variables[0] = doe::integer_variable("count", "1", 0, 3);
  const auto counted = [](const Eigen::VectorXd& x) {
    Eigen::VectorXd scaled = x;
    scaled[0] /= 3.0;
    ValueAndJacobian y = paraboloids(scaled);
    y.jacobian.col(0) /= 3.0;
    return y;
  };
  Eigen::MatrixXd X = around_the_segment();
  for (Eigen::Index i = 0; i < X.rows(); ++i) X(i, 0) = static_cast<double>(i % 4);
  const Polished polished = polish(counted, problem, rough_front(counted, problem, X), {.form = GetParam()});
  EXPECT_EQ(polished.front.X.col(0), X.col(0));
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    EXPECT_EQ(polished.points[static_cast<std::size_t>(i)], PolishedPoint::improved);
    EXPECT_NEAR(polished.front.X(i, 2), 0.5, 5e-8);
    EXPECT_LE(polished.front.X(i, 3), 5e-8);
    EXPECT_LE(polished.residual[i], 1e-6);
  }
}

// Where no variable is real there is nothing to polish, and the search's point is as good as it gets.
TEST_P(Forms, LeaveAFrontOfWholeNumbersAsItIs) {
  doe::Problem problem = support::unit_problem(4, 2);
  for (doe::Variable& v : problem.variables) v = doe::integer_variable(v.name, "1", 0, 1);
  const Eigen::MatrixXd X = (Eigen::MatrixXd(2, 4) << 0, 0, 0, 0, 1, 1, 0, 0).finished();
  const Polished polished =
      polish(paraboloids, problem, rough_front(paraboloids, problem, X), {.form = GetParam()});
  EXPECT_EQ(polished.status, PolishStatus::completed) << polished.message;
  EXPECT_EQ(polished.front.X, X);
  EXPECT_EQ(polished.points, std::vector<PolishedPoint>(2, PolishedPoint::unchanged));
  EXPECT_TRUE(polished.residual.array().isNaN().all()) << "an empty condition certifies nothing";
}
