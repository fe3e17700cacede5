// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// How well the model decides where runs fail, over designs: against the nearest run, and where failures
/// follow no place. The table over more regions is benchmarks/toolkit/success_table.cpp.

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/success_model.hpp>
#include <functional>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using Chance = std::function<double(const VectorXd& x)>;

MatrixXd uniform_points(doe::RandomStream& random, Eigen::Index n) {
  MatrixXd X(n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < 3; ++k) X(i, k) = random.uniform();
  return X;
}

/// Of one design of 50 runs, judged at 500 other places.
struct Judged {
  double wrong = 0, wrong_by_nearest = 0;  ///< expected share of wrong decisions
  double mean = 0, truth = 0;              ///< of P and of the chance
};

bool nearest_succeeded(const MatrixXd& X, const std::vector<bool>& succeeded, const VectorXd& x) {
  Eigen::Index nearest = 0;
  (X.rowwise() - x.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return succeeded[static_cast<std::size_t>(nearest)];
}

Judged judge(const Chance& chance, doe::Seed seed) {
  doe::RandomStream random(seed);
  const MatrixXd X = uniform_points(random, 50);
  std::vector<bool> succeeded;
  for (Eigen::Index i = 0; i < X.rows(); ++i) succeeded.push_back(random.uniform() < chance(X.row(i)));
  const MatrixXd Z = uniform_points(random, 500);
  const VectorXd P = fit_success(X, succeeded, {VectorXd::Zero(3), VectorXd::Ones(3)}).probability(Z);
  Judged judged;
  const auto error = [](bool says, double truth) { return says ? 1.0 - truth : truth; };
  for (Eigen::Index i = 0; i < Z.rows(); ++i) {
    const double truth = chance(Z.row(i)), share = 1.0 / static_cast<double>(Z.rows());
    judged.wrong += share * error(P[i] >= 0.5, truth);
    judged.wrong_by_nearest += share * error(nearest_succeeded(X, succeeded, Z.row(i)), truth);
    judged.mean += share * P[i];
    judged.truth += share * truth;
  }
  return judged;
}

struct Mean {
  double value = 0, error = 0;  ///< standard error
};

Mean mean_of(const std::vector<double>& values) {
  const Eigen::Map<const VectorXd> v(values.data(), static_cast<Eigen::Index>(values.size()));
  const double n = static_cast<double>(v.size()), mean = v.mean();
  return {mean, std::sqrt((v.array() - mean).square().sum() / (n - 1) / n)};
}

/// Of 20 designs, f(judged).
template <class F>
Mean over_designs(const Chance& chance, const F& f) {
  std::vector<double> values;
  for (doe::Seed seed = 1; seed <= 20; ++seed) values.push_back(f(judge(chance, 77 * seed)));
  return mean_of(values);
}

// Fewer wrong decisions than by the nearest run, paired over the designs, by four standard errors: half of
// them or less where the region is simple.
TEST(SuccessModelOverDesigns, DecidesBetterThanTheNearestRun) {
  const Chance edge = [](const VectorXd& x) { return x[0] + x[1] < 1.4 ? 1.0 : 0.0; };
  const Chance corner = [](const VectorXd& x) { return x[0] > 0.6 && x[1] > 0.6 ? 0.0 : 1.0; };
  const Chance blurred = [](const VectorXd& x) { return 1.0 / (1.0 + std::exp(15.0 * (x[0] - 0.7))); };
  for (const Chance& region : {edge, corner, blurred}) {
    const Mean gain = over_designs(region, [](const Judged& j) { return j.wrong_by_nearest - j.wrong; });
    EXPECT_GT(gain.value, 4.0 * gain.error);
  }
}

// One run in ten fails, anywhere. Nothing decides better than to go on, which is wrong at one in ten places;
// the nearest run is wrong at 2 · 0.1 · 0.9. Halfway between, and no bias beyond four standard errors and the
// 0.02 that a share of 50 runs plus one of both kinds is off.
TEST(SuccessModelOverDesigns, FailuresWithoutAPlaceForbidNoPlace) {
  const Chance anywhere = [](const VectorXd&) { return 0.9; };
  EXPECT_LT(over_designs(anywhere, [](const Judged& j) { return j.wrong; }).value, 0.14);
  const Mean bias = over_designs(anywhere, [](const Judged& j) { return j.mean - j.truth; });
  EXPECT_LT(std::abs(bias.value), 0.02 + 4.0 * bias.error);
}

// Places tell in all designs of an edge, and in few of failures without a place (a fifth at most; more than 8
// of 20 with a probability below 1 %).
TEST(SuccessModelOverDesigns, SaysWhetherPlacesTell) {
  const auto told = [](const Chance& chance) {
    int count = 0;
    for (doe::Seed seed = 1; seed <= 20; ++seed) {
      doe::RandomStream random(91 * seed);
      const MatrixXd X = uniform_points(random, 50);
      std::vector<bool> succeeded;
      for (Eigen::Index i = 0; i < X.rows(); ++i) succeeded.push_back(random.uniform() < chance(X.row(i)));
      count += fit_success(X, succeeded, {VectorXd::Zero(3), VectorXd::Ones(3)}).place_tells();
    }
    return count;
  };
  EXPECT_EQ(told([](const VectorXd& x) { return x[0] > 0.8 ? 0.0 : 1.0; }), 20);
  EXPECT_LE(told([](const VectorXd&) { return 0.4; }), 8);
  EXPECT_LE(told([](const VectorXd&) { return 0.9; }), 8);
}

}  // namespace
