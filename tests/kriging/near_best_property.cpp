// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// The region around the best run in which a search goes on: inside the box, of every kind of variable.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/near_best.hpp>
#include <drawpoint/kriging/optimize.hpp>
#include <drawpoint/tests/support/median.hpp>
#include <numbers>
#include <set>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using support::median;

namespace {

std::vector<doe::Variable> three_kinds() {
  std::vector<doe::Variable> all{{"x", "m", -2.0, 8.0}, {"n", "1", 1.0, 9.0}, {"kind", "1", 0.0, 2.0}};
  all[1].kind = doe::VariableKind::integer;
  all[2].kind = doe::VariableKind::categorical;
  all[2].levels = {"a", "b", "c"};
  return all;
}

}  // namespace

// Half a side is 0.3 of 10 m and of 8 at first, 0.6 of that after six runs, and 0.01 at last, but one for whole
// numbers.
TEST(NearBest, ShrinksWithTheAgeOfTheBestRun) {
  const auto variables = three_kinds();
  const Eigen::Vector3d best(3.0, 5.0, 1.0);
  const auto reaches = [&](double age, double x, double n) {
    return detail::NearBest(variables, best, age).contains(Eigen::Vector3d(3.0 + x, 5.0 + n, 0.0));
  };
  EXPECT_TRUE(reaches(0, 3.0, 2.0));
  EXPECT_FALSE(reaches(0, 3.01, 0.0));
  EXPECT_FALSE(reaches(0, 0.0, 3.0));
  EXPECT_TRUE(reaches(6, 1.8, 1.0));
  EXPECT_FALSE(reaches(6, 1.81, 0.0));
  EXPECT_FALSE(reaches(6, 0.0, 2.0));
  EXPECT_TRUE(reaches(1000, 0.1, 1.0));
  EXPECT_FALSE(reaches(1000, 0.11, 0.0));
}

// Wherever the best run lies and however old it is, all points lie in region and box, whole numbers are whole, and
// whole numbers and categories reach every value that they may.
TEST(NearBest, HoldsItsPoints) {
  const auto variables = three_kinds();
  for (const double age : {0.0, 7.0, 40.0})
    for (const double share : {0.0, 0.5, 1.0}) {
      const Eigen::Vector3d best(-2.0 + 10.0 * share, 1.0 + 8.0 * share, 2.0 * share);
      const detail::NearBest region(variables, best, age);
      const MatrixXd P = region.points(300, 5);
      EXPECT_EQ(P, region.points(300, 5));
      std::set<double> whole, levels;
      for (const auto& row : P.rowwise()) {
        const VectorXd x = row.transpose();
        EXPECT_TRUE(region.contains(x));
        for (Eigen::Index k = 0; k < 3; ++k) {
          EXPECT_GE(x[k], variables[static_cast<std::size_t>(k)].lower);
          EXPECT_LE(x[k], variables[static_cast<std::size_t>(k)].upper);
        }
        whole.insert(x[1]);
        levels.insert(x[2]);
      }
      for (const double n : whole) EXPECT_EQ(n, std::round(n));
      EXPECT_EQ(levels, (std::set<double>{0, 1, 2}));
      const std::size_t most = age > 6 ? 3 : 5, inside = share == 0.5 ? most : (most + 1) / 2;
      EXPECT_EQ(whole.size(), inside) << age << " " << share;
    }
}

// Rastrigin's function of four inputs has 10 000 valleys in this box, the best of 60 random points is 22 to 31. The
// median of eleven searches is 4; it is 15 without models that are sums of one variable each, and 22 without the region
// as well. Five of them are made here.
TEST(NearBest, HelpsOnARuggedFunction) {
  const auto rastrigin = [](const VectorXd& u) {
    double sum = 0;
    for (const double v : u) {
      const double x = -4.0 + 9.0 * v;
      sum += x * x - 10.0 * std::cos(2.0 * std::numbers::pi * x) + 10.0;
    }
    return sum;
  };
  doe::Problem problem;
  for (int k = 0; k < 4; ++k) problem.variables.push_back({"u" + std::to_string(k), "1", 0.0, 1.0});
  problem.responses = {{"y", "1", doe::Goal::minimize}};
  std::vector<double> best;
  for (doe::Seed seed = 1; seed <= 5; ++seed)
    best.push_back(optimize(rastrigin, problem, 60, {.seed = seed}).best.front().y[0]);
  EXPECT_LT(median(best), 10.0);
}

// Five wells of a width of a tenth: only runs elsewhere tell that the best of them is another one. A search that stays
// near its best run misses it for 13 of 16 seeds, one without the region for 1: at these rates 2 of 10 and fewer are
// missed with a probability of 0.005 % and 98 %.
TEST(NearBest, LeavesAWellForADeeperOne) {
  const MatrixXd places =
      (MatrixXd(5, 2) << 0.15, 0.2, 0.8, 0.15, 0.5, 0.55, 0.2, 0.85, 0.85, 0.8).finished();
  const VectorXd depths = (VectorXd(5) << 1.0, 1.2, 1.1, 1.5, 0.9).finished();
  const auto wells = [&](const VectorXd& x) {
    double sum = 0;
    for (Eigen::Index k = 0; k < depths.size(); ++k)
      sum -= depths[k] * std::exp(-(x - places.row(k).transpose()).squaredNorm() / (2 * 0.1 * 0.1));
    return sum;
  };
  const doe::Problem problem{{{"x", "1", 0.0, 1.0}, {"z", "1", 0.0, 1.0}}, {{"y", "1", doe::Goal::minimize}}};
  int missed = 0;
  for (doe::Seed seed = 1; seed <= 10; ++seed)
    missed += optimize(wells, problem, 60, {.seed = seed}).best.front().y[0] > -1.4;
  EXPECT_LE(missed, 2);
}
