// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Variances of few samples, drawn towards those of all: its parts against exact values, its estimates against the
/// model that they stand for, and what a fit makes of runs that seem quiet by chance.

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/moderated_noise.hpp>
#include <drawpoint/kriging/noise_model.hpp>
#include <drawpoint/kriging/replicates.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// χ² of `freedom` degrees over them.
double scatter_of_one(int freedom, doe::RandomStream& random) {
  double sum = 0;
  for (int i = 0; i < freedom; ++i) sum += std::pow(random.normal(), 2);
  return sum / freedom;
}

struct Told {
  VectorXd truth, told;
};

/// True variances about 4 by the inverse of χ² of `shared` degrees, 0: all 4; told ones of `freedom` each.
Told variances(Eigen::Index n, int shared, int freedom, doe::Seed seed) {
  doe::RandomStream random(seed);
  Told t{VectorXd(n), VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    t.truth[i] = shared > 0 ? 4 / scatter_of_one(shared, random) : 4;
    t.told[i] = t.truth[i] * scatter_of_one(freedom, random);
  }
  return t;
}

VectorXd all(const VectorXd& of, double freedom) { return VectorXd::Constant(of.size(), freedom); }

double mean_square_of_logarithm(const VectorXd& a, const VectorXd& b) {
  return (a.array() / b.array()).log().square().mean();
}

}  // namespace

// Abramowitz, Stegun 1964, 6.3.2, 6.3.3, 6.4.2, 6.4.4; the series are good to 8e-13.
TEST(Polygamma, MeetsExactValues) {
  const double euler = std::numbers::egamma, pi = std::numbers::pi;
  EXPECT_NEAR(detail::digamma(1), -euler, 1e-12);
  EXPECT_NEAR(detail::digamma(0.5), -euler - 2 * std::log(2.0), 1e-12);
  EXPECT_NEAR(detail::digamma(31), detail::digamma(30) + 1.0 / 30, 1e-12);
  EXPECT_NEAR(detail::trigamma(1), pi * pi / 6, 1e-12);
  EXPECT_NEAR(detail::trigamma(0.5), pi * pi / 2, 1e-12);
  EXPECT_NEAR(detail::trigamma(1e6), 1e-6 + 0.5e-12, 1e-18);
  for (const double x : {1e-4, 0.03, 0.5, 1.0, 7.0, 300.0, 1e8})
    EXPECT_NEAR(detail::inverse_trigamma(detail::trigamma(x)) / x, 1, 1e-11) << x;
}

// 20 000 variances tell what they were drawn from. ln v has the variance ψ'(d/2) + ψ'(d₀/2) = 5.58, 1.14 and 0.75 for
// one, five and twenty degrees, and an excess kurtosis of at most 4, so that its estimate is off by √(6/20000) = 1.7 %
// of it. One standard error is taken off, and four more are allowed: 0.47, 0.10 and 0.06 of ψ'(d₀/2) = 0.645, which d₀
// = 4 follows. s₀² has the error of the mean, √(5.6/20000) = 1.7 %, and what d₀ is off by.
TEST(SharedNoise, IsWhatVariancesWereDrawnFrom) {
  for (const int freedom : {1, 5, 20}) {
    const Told t = variances(20000, 4, freedom, 3);
    const SharedNoise shared = shared_noise(t.told, all(t.told, freedom));
    EXPECT_NEAR(shared.freedom / 4, 1, freedom == 1 ? 0.9 : 0.2) << freedom;
    EXPECT_NEAR(shared.variance / 4, 1, freedom == 1 ? 0.4 : 0.1) << freedom;
  }
}

// Nearer to the truth than what is told, for any number of samples and any scatter of the truth, and where the truth
// scatters widely nearer than what all tell together. 40 variances, means over 50 sets: what chance adds to the
// differences is below a tenth of them. Where all are equal, d₀ that is not known to be infinite costs below a tenth of
// what is told costs.
TEST(ModeratedNoise, IsNearerToTheTruth) {
  for (const int freedom : {1, 2, 5, 20})
    for (const int shared : {0, 2, 4, 20}) {
      double told = 0, pooled = 0, moderated = 0;
      for (doe::Seed seed = 1; seed <= 50; ++seed) {
        const Told t = variances(40, shared, freedom, seed);
        told += mean_square_of_logarithm(t.told, t.truth);
        pooled += mean_square_of_logarithm(all(t.told, t.told.mean()), t.truth);
        moderated += mean_square_of_logarithm(moderated_noise(t.told, freedom), t.truth);
      }
      EXPECT_LT(moderated, shared > 0 ? told : told / 10) << freedom << " " << shared;
      if (shared == 2) {
        EXPECT_LT(moderated, pooled) << freedom << " " << shared;
      }
    }
}

// In other units they are the same; they keep the order and lie between themselves and s₀²; of infinitely many samples
// they are as they were, and without noise 0.
TEST(ModeratedNoise, KeepsUnitsAndOrder) {
  for (doe::Seed seed = 1; seed <= 20; ++seed) {
    const Told t = variances(30, 4, 2, seed);
    const VectorXd moderated = moderated_noise(t.told, 2);
    const SharedNoise shared = shared_noise(t.told, all(t.told, 2));
    for (const double unit : {1e-16, 1e16})
      EXPECT_LT((moderated_noise(unit * t.told, 2).array() / (unit * moderated.array()) - 1).abs().maxCoeff(),
                1e-9);
    for (Eigen::Index i = 1; i < 30; ++i) {
      EXPECT_GE((t.told[i] - t.told[0]) * (moderated[i] - moderated[0]), 0);
      EXPECT_GE(moderated[i], std::min(t.told[i], shared.variance) * (1 - 1e-12));
      EXPECT_LE(moderated[i], std::max(t.told[i], shared.variance) * (1 + 1e-12));
      EXPECT_GT(moderated[i], 0);
    }
    EXPECT_EQ(moderated_noise(t.told, std::numeric_limits<double>::infinity()), t.told);
  }
  EXPECT_EQ(moderated_noise(VectorXd::Zero(3), 2), VectorXd::Zero(3));
  EXPECT_EQ(moderated_noise(VectorXd::Constant(1, 5.0), 1), VectorXd::Constant(1, 5.0));
}

// Where chance is all that the variances differ by, the quietest of few runs is not left quiet: the seventh part of the
// true variance at least in 19 of 20 sets of two samples each, where by itself it is below a hundredth in every other
// one.
TEST(ModeratedNoise, OfFewRunsErrsTowardsOneVariance) {
  for (const Eigen::Index n : {10, 20, 40}) {
    int quiet = 0, raw = 0;
    for (doe::Seed seed = 1; seed <= 200; ++seed) {
      const Told t = variances(n, 0, 1, seed);
      quiet += moderated_noise(t.told, 1).minCoeff() < 4.0 / 7;
      raw += t.told.minCoeff() < 0.04;
    }
    EXPECT_LE(quiet, 20) << n << ": 10 and three standard deviations, √10 each";
    EXPECT_GT(raw, 80) << n;
  }
}

// A variance of 0 beside others is no variance of a normal sample: of counts, two of five are often equal. All are
// taken together then.
TEST(ModeratedNoise, OfEqualSamplesIsThatOfAll) {
  const VectorXd own = (VectorXd(5) << 0.5, 0, 2, 8, 0).finished();
  EXPECT_LT((moderated_noise(own, 1).array() - 2.1).abs().maxCoeff(), 1e-14);
  const VectorXd freedom = (VectorXd(3) << 1, 2, 3).finished(), three = (VectorXd(3) << 6, 0, 2).finished();
  EXPECT_LT((moderated_noise(three, freedom).array() - 2.0).abs().maxCoeff(), 1e-14);
}

TEST(ModeratedNoise, RefusesWhatCannotBe) {
  EXPECT_THROW(moderated_noise(VectorXd(), 2), std::invalid_argument);
  EXPECT_THROW(moderated_noise(VectorXd::Constant(3, -1.0), 2), std::invalid_argument);
  EXPECT_THROW(moderated_noise(VectorXd::Constant(3, 1.0), 0), std::invalid_argument);
  EXPECT_THROW(shared_noise(VectorXd::Ones(3), VectorXd::Ones(2)), std::invalid_argument);
}

namespace {

double slope(double x) { return 3 + std::sin(4 * x); }

MatrixXd places(int n, int d, doe::Seed seed) {
  doe::Problem box;
  box.responses = {{.name = "y", .unit = "1"}};
  for (int k = 0; k < d; ++k) box.variables.push_back({"x" + std::to_string(k), "1", 0.0, 1.0});
  return doe::latin_hypercube(box, n, {.seed = seed});
}

/// Share of the places where the 95 % interval of the mean holds the function.
double held(const TransformedModel& model, const MatrixXd& at) {
  const VectorXd low = model.quantile(at, 0.025), high = model.quantile(at, 0.975);
  int count = 0;
  for (Eigen::Index i = 0; i < at.rows(); ++i)
    count += low[i] <= slope(at(i, 0)) && slope(at(i, 0)) <= high[i];
  return count / static_cast<double>(at.rows());
}

}  // namespace

// Runs of two samples with the same noise everywhere, of four inputs of which one matters: some seem exact. A fit that
// takes each at its word goes through them; moderated it holds what it says. 30 designs of 40 runs; a design's coverage
// scatters by some 15 %, so 30 by 3 %: 95 less three of these and one for what the fit's normal intervals leave out.
TEST(ModeratedNoise, NoRunIsTakenForExactByChance) {
  double raw = 0, moderated = 0, repeats = 0;
  for (doe::Seed seed = 1; seed <= 30; ++seed) {
    doe::RandomStream random(seed);
    const MatrixXd X = places(40, 4, seed), at = places(50, 4, 100 + seed);
    MatrixXd twice(80, 4);
    VectorXd y(40), told(40), both(80);
    for (Eigen::Index i = 0; i < 40; ++i) {
      const double a = slope(X(i, 0)) + random.normal(), b = slope(X(i, 0)) + random.normal();
      y[i] = 0.5 * (a + b);
      told[i] = 0.25 * (a - b) * (a - b);
      twice.row(2 * i) = twice.row(2 * i + 1) = X.row(i);
      both[2 * i] = a;
      both[2 * i + 1] = b;
    }
    const auto fitted = [&](double freedom) {
      return fit_with_noise(X, y, Scale::linear, {}, {}, NoiseSource::told, told, freedom);
    };
    raw += held(fitted(exactly_known), at) / 30;
    moderated += held(fitted(1), at) / 30;
    const Replicates own = replicates(twice, both, ReplicateNoise::own);
    EXPECT_LT((own.noise_variance - moderated_noise(told, 1)).cwiseAbs().maxCoeff(), 1e-12);
    repeats +=
        held(fit_with_noise(own.X, own.y, Scale::linear, {}, {}, NoiseSource::told, own.noise_variance), at) /
        30;
  }
  EXPECT_LT(raw, moderated - 0.04) << "this is a case without the fault";
  EXPECT_GT(moderated, 0.85);
  EXPECT_GT(repeats, 0.85);
}

// The other side: a third of the runs scatters fiftyfold and five samples each tell so. The moderated fit is still led
// by the precise ones: its error is below half of that with one size of noise.
TEST(ModeratedNoise, KeepsWhatRunsKnow) {
  double pooled = 0, moderated = 0;
  for (doe::Seed seed = 1; seed <= 10; ++seed) {
    doe::RandomStream random(seed);
    MatrixXd X(40, 1);
    VectorXd y(40), told(40);
    for (Eigen::Index i = 0; i < 40; ++i) {
      X(i, 0) = random.uniform();
      const double deviation = i % 3 == 0 ? 1.0 : 0.02;
      y[i] = slope(X(i, 0)) + deviation * random.normal();
      told[i] = deviation * deviation * scatter_of_one(4, random);
    }
    const MatrixXd at = VectorXd::LinSpaced(50, 0, 1);
    const auto error = [&](NoiseSource source) {
      const TransformedModel model = fit_with_noise(X, y, Scale::linear, {}, {}, source, told, 4);
      return (model.mean(at) - at.col(0).unaryExpr(&slope)).norm();
    };
    pooled += error(NoiseSource::pooled);
    moderated += error(NoiseSource::told);
  }
  EXPECT_LT(moderated, 0.5 * pooled);
}
