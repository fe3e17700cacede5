// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Counts: their moments by quadrature, the evidence of one and two runs, the gradient, and predictions.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/count_model.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/tests/support/told.hpp>
#include <limits>
#include <tuple>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double log_poisson(double count, double log_mean) {
  return count * log_mean - std::exp(log_mean) - std::lgamma(count + 1.0);
}

/// Integral, mean and variance of Poisson times normal by Simpson's rule on 100 000 intervals, from fifteen
/// deviations below the mean, or 5 below where Poisson's law is highest, to as much above: far below 1e-10.
detail::TiltedMoments by_simpson(const detail::CountRun& run, double mean, double variance) {
  constexpr int intervals = 100000;
  const double s = std::sqrt(variance), likeliest = std::log(run.count + 1) - run.offset;
  const double from = std::min(mean - 15 * s, likeliest - 5), to = std::max(mean + 15 * s, likeliest + 5);
  const auto log_integrand = [&](double f) {
    return log_poisson(run.count, f + run.offset) + detail::log_normal_density((f - mean) / s) - std::log(s);
  };
  double highest = -1e300;
  for (int k = 0; k <= intervals; ++k)
    highest = std::max(highest, log_integrand(from + (to - from) * k / intervals));
  const double h = (to - from) / intervals;
  double sum[3] = {0, 0, 0};
  for (int k = 0; k <= intervals; ++k) {
    const double f = from + k * h;
    const double weight = (k == 0 || k == intervals ? 1
                           : k % 2                  ? 4
                                                    : 2) *
                          h / 3 * std::exp(log_integrand(f) - highest);
    for (int power = 0; power < 3; ++power) sum[power] += weight * std::pow(f - mean, power);
  }
  const double shift = sum[1] / sum[0];
  return {mean + shift, sum[2] / sum[0] - shift * shift, std::log(sum[0]) + highest};
}

TEST(CountRun, MomentsAreThoseOfQuadrature) {
  for (const double count : {0.0, 1.0, 7.0, 300.0})
    for (const double mean : {-2.0, 0.0, 3.0})
      for (const auto& [variance, stated] :
           {std::pair(0.01, 1e-9), {1.0, 1e-9}, {10.0, 1e-9}, {100.0, 1e-5}}) {
        const detail::CountRun run{count, 0.4};
        const detail::TiltedMoments found = run.tilted(mean, variance),
                                    exact = by_simpson(run, mean, variance);
        EXPECT_NEAR(found.mean, exact.mean, stated * (1 + std::abs(exact.mean))) << count << " " << variance;
        EXPECT_NEAR(found.variance, exact.variance, stated * (1 + exact.variance))
            << count << " " << variance;
        EXPECT_NEAR(found.log_integral, exact.log_integral, stated * (1 + std::abs(exact.log_integral)));
      }
}

// One run: expectation propagation is exact. Two: against 400 x 400 points of the trapezoidal rule over eight
// deviations of both; the error of the method is held to 0.003, a fifth of that for success and failure.
TEST(CountPosterior, EvidenceOfOneAndTwoRuns) {
  const detail::CountRun three{3, 0.5}, none{0, 0.5};
  const auto one = detail::latent_posterior(MatrixXd::Constant(1, 1, 2.0), std::vector{three});
  EXPECT_NEAR(one.log_evidence, by_simpson(three, 0, 2.0).log_integral, 1e-8);
  for (const double correlation : {-0.5, 0.0, 0.9}) {
    MatrixXd K = MatrixXd::Constant(2, 2, 2.0 * correlation);
    K.diagonal().setConstant(2.0);
    const MatrixXd L = K.llt().matrixL();
    double Z = 0, weights = 0;
    for (int i = 0; i < 400; ++i)
      for (int j = 0; j < 400; ++j) {
        const Eigen::Vector2d z(-8 + 16.0 * i / 399, -8 + 16.0 * j / 399), f = L * z;
        const double weight = std::exp(-0.5 * z.squaredNorm());
        weights += weight;
        Z += weight * std::exp(log_poisson(3, f[0] + 0.5) + log_poisson(0, f[1] + 0.5));
      }
    const auto both = detail::latent_posterior(K, std::vector{three, none});
    EXPECT_TRUE(both.converged);
    EXPECT_NEAR(both.log_evidence, std::log(Z / weights), 0.003) << correlation;
  }
}

struct Spills {
  MatrixXd X;
  VectorXd counts, rate;

  /// Rocks spilled over a square: rate from 0.05 in one corner to 12 in the other, and `own` of each run.
  Spills(int runs, doe::Seed seed, double own = 0) {
    const doe::Problem box{{{"a", "1", 0.0, 1.0}, {"b", "1", 0.0, 1.0}}, {{"spill", "1"}}};
    X = doe::latin_hypercube(box, runs, {.seed = seed});
    counts.resize(runs);
    rate.resize(runs);
    doe::RandomStream random(seed);
    for (Eigen::Index i = 0; i < runs; ++i) {
      rate[i] = rate_at(X.row(i).transpose());
      counts[i] = draw(rate[i] * std::exp(own * random.normal()), random);
    }
  }
  static double rate_at(const VectorXd& x) { return 0.05 * std::exp(5.5 * x[0] * std::cos(0.8 * x[1])); }
  /// By the product of uniform numbers (Knuth).
  static double draw(double mean, doe::RandomStream& random) {
    double left = std::exp(-mean), product = random.uniform(), count = 0;
    for (; product > left; ++count) product *= random.uniform();
    return count;
  }
};

// Central differences with h = 1e-4 have an error of some 1e-8, and what the sites' tolerance leaves over 2h.
TEST(CountLikelihood, GradientIsThatOfTheValue) {
  const Spills spills(30, 2);
  std::vector<detail::CountRun> runs;
  for (const double count : spills.counts) runs.push_back({count, 0.3});
  detail::LatentLikelihood likelihood((2.0 * spills.X.array() - 1.0).matrix(), runs);
  VectorXd p = likelihood.middle();
  p += VectorXd{{1.3, -0.4, 0.5, 0.7}};
  const VectorXd gradient = likelihood.gradient(p);
  for (Eigen::Index k = 0; k < 4; ++k) {
    VectorXd up = p, down = p;
    up[k] += 1e-4;
    down[k] -= 1e-4;
    EXPECT_NEAR(gradient[k], (likelihood.value(up) - likelihood.value(down)) / 2e-4, 1e-5) << k;
  }
}

// A rate alike everywhere, 200 runs of it: its mean count is right to 4 · sqrt(2/200), and a run of mean 2
// counts none with a chance of e⁻² = 0.135, at most two with 0.677; their derivatives by the rate are below
// 0.3.
TEST(CountModel, OfOneRateIsPoissonsLaw) {
  MatrixXd X(200, 1);
  VectorXd counts(200);
  doe::RandomStream random(5);
  for (Eigen::Index i = 0; i < 200; ++i) {
    X(i, 0) = random.uniform();
    counts[i] = Spills::draw(2, random);
  }
  const CountModel model = fit_counts(X, counts);
  const MatrixXd middle = MatrixXd::Constant(1, 1, 0.5);
  const double off = 4 * std::sqrt(2.0 / 200);
  EXPECT_TRUE(model.converged());
  EXPECT_NEAR(model.mean(middle)[0], 2, off);
  EXPECT_NEAR(model.probability_at_most(middle, 0)[0], std::exp(-2), 0.3 * off);
  EXPECT_NEAR(model.probability_at_most(middle, 2)[0], 5 * std::exp(-2), 0.3 * off);
  EXPECT_EQ(model.quantile(middle, 0.5)[0], 2);
  EXPECT_LT(model.deviation_of_a_run(), 0.4);
  const Prediction run = model.predict(middle, Target::observation);
  EXPECT_GE(run.variance[0], run.mean[0]);
}

// Cumulative probabilities of Poisson counts with a normal logarithm of the mean, against 20 001 points of the
// same rule: of large counts and of wide logarithms, to what the header states.
TEST(CountDistribution, IsThatOfAFineRule) {
  for (const auto& [mean, deviation, stated] : {std::tuple(1.0, 0.0, 1e-6),
                                                {0.3, 1.0, 1e-6},
                                                {100.0, 0.1, 1e-6},
                                                {1000.0, 0.02, 1e-6},
                                                {1000.0, 1.0, 1e-6},
                                                {3000.0, 0.0, 1e-3},
                                                {3000.0, 0.5, 1e-3}}) {
    const detail::CountDistribution found(std::log(mean), deviation * deviation);
    const int most = static_cast<int>(mean);
    double exact = 0, weights = 0;
    const int points = deviation > 0 ? 20001 : 1;
    for (int k = 0; k < points; ++k) {
      const double z = points > 1 ? 8.5 * (2.0 * k / (points - 1) - 1) : 0.0, weight = std::exp(-0.5 * z * z);
      weights += weight;
      const double log_mean = std::log(mean) + deviation * z;
      double at_most = 0, term = -std::exp(log_mean);  // ln of the probability of 0
      for (int count = 0; count <= most; ++count) {
        if (count > 0) term += log_mean - std::log(count);
        at_most += std::exp(term);
      }
      exact += weight * at_most;
    }
    EXPECT_NEAR(found.at_most(most), exact / weights, stated) << mean << " " << deviation;
  }
}

TEST(CountModel, LargeCountsAndQuantilesEnd) {
  const Spills spills(40, 6);
  VectorXd many = spills.counts * 500;
  for (double& count : many) count = std::min(count, 10000.0);
  const CountModel model = fit_counts(spills.X, many);
  EXPECT_TRUE(model.converged());
  const MatrixXd X{{0.9, 0.1}};
  EXPECT_EQ(model.quantile(X, 0.5, 1e6)[0], std::numeric_limits<double>::infinity());
  EXPECT_GT(model.probability_at_most(X, std::numeric_limits<int>::max())[0], 0.99);
  EXPECT_EQ(model.probability_at_most(X, -1)[0], 0);
  EXPECT_GT(model.quantile(X, 1 - 1.2e-16)[0], model.quantile(X, 0.5)[0]);
}

// Probabilities add to 1, and their mean and variance are those of the prediction: sums over 400 counts of a
// mean of 12 at most.
TEST(CountModel, ProbabilitiesHaveTheMomentsOfThePrediction) {
  const Spills spills(60, 3);
  const CountModel model = fit_counts(spills.X, spills.counts);
  const MatrixXd X{{0.1, 0.5}, {0.9, 0.1}};
  const Prediction p = model.predict(X, Target::observation);
  VectorXd before = VectorXd::Zero(2), mean = before, square = before;
  for (int count = 0; count <= 400; ++count) {
    const VectorXd at_most = model.probability_at_most(X, count);
    for (int i = 0; i < 2; ++i) {
      mean[i] += count * (at_most[i] - before[i]);
      square[i] += 1.0 * count * count * (at_most[i] - before[i]);
    }
    before = at_most;
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(before[i], 1, 1e-9);
    EXPECT_NEAR(mean[i], p.mean[i], 1e-5 * p.mean[i]);
    EXPECT_NEAR(square[i] - mean[i] * mean[i], p.variance[i], 1e-3 * p.variance[i]);
  }
}

/// The root of a count has about the same noise everywhere, so that errors where little is counted count too.
double error_of_root(const VectorXd& found, const VectorXd& exact) {
  return (found.array().max(0).sqrt() - exact.array().sqrt()).matrix().norm();
}

// 95 % intervals of one more run between quantiles: those of counts hold at least 95 %. 12 designs of 200 new
// runs each; a share of 2400 has a standard error of 0.45 % and what designs share adds some: 93 % at least.
TEST(CountModel, IntervalsHoldNewRunsAndErrorsAreSmallerThanKrigings) {
  int held = 0, all = 0, better = 0;
  for (doe::Seed seed = 1; seed <= 12; ++seed) {
    const Spills known(60, seed), fresh(200, 100 + seed);
    const CountModel model = fit_counts(known.X, known.counts);
    const VectorXd low = model.quantile(fresh.X, 0.025), high = model.quantile(fresh.X, 0.975);
    for (Eigen::Index i = 0; i < 200; ++i) held += fresh.counts[i] >= low[i] && fresh.counts[i] <= high[i];
    all += 200;
    const VectorXd plain = fit(known.X, known.counts).mean(fresh.X), mine = model.mean(fresh.X);
    better += error_of_root(mine, fresh.rate) < error_of_root(plain, fresh.rate);
  }
  EXPECT_GE(held, 0.93 * all);
  EXPECT_GE(better, 10);  // were it as good as plain Kriging, so often by chance in 0.02
}

// Counts that scatter by more than Poisson's law: σ = 0.7 is found within a third by 100 runs of some tens of
// counts; of Poisson's law alone it stays small.
TEST(CountModel, FindsWhatARunHasOfItsOwn) {
  MatrixXd X(100, 1);
  VectorXd counts(100), law(100);
  doe::RandomStream random(8);
  for (Eigen::Index i = 0; i < 100; ++i) {
    X(i, 0) = random.uniform();
    law[i] = Spills::draw(20, random);
    counts[i] = Spills::draw(20 * std::exp(0.7 * random.normal()), random);
  }
  // σ² from 100 normal values: standard error sqrt(2/100) of it, with Poisson's noise of 1/20 beside 0.49.
  EXPECT_NEAR(fit_counts(X, counts).deviation_of_a_run(), 0.7, 4 * 0.7 * std::sqrt(0.5 / 100) * 1.1);
  EXPECT_LT(fit_counts(X, law).deviation_of_a_run(), 0.2);
}

TEST(CountModel, CountsPerExposure) {
  MatrixXd X(80, 1);
  VectorXd counts(80), exposure(80);
  doe::RandomStream random(9);
  for (Eigen::Index i = 0; i < 80; ++i) {
    X(i, 0) = random.uniform();
    exposure[i] = i % 2 == 0 ? 1 : 10;
    counts[i] = Spills::draw(3 * exposure[i], random);
  }
  const CountModel model = fit_counts(X, counts, {.exposure = exposure});
  const MatrixXd middle = MatrixXd::Constant(1, 1, 0.5);
  EXPECT_NEAR(model.mean(middle)[0], 3, 4 * std::sqrt(3.0 / (40 + 400)));
  EXPECT_NEAR(model.probability_at_most(middle, 0, 0.1)[0], std::exp(-0.3), 0.05);
}

TEST(CountModel, RunsWithoutAnyCountAndRepeatedRuns) {
  const MatrixXd X = (VectorXd(4) << 0, 0, 0.5, 1).finished();
  const CountModel none = fit_counts(X, VectorXd::Zero(4));
  EXPECT_TRUE(none.converged());
  EXPECT_LT(none.mean(X).maxCoeff(), 1);
  EXPECT_GT(none.mean(X).minCoeff(), 0);
  EXPECT_EQ(none.quantile(X, 0.5).maxCoeff(), 0);
  const CountModel far = fit_counts(X, VectorXd{{0, 1, 3, 250}});
  EXPECT_TRUE(far.converged());
  EXPECT_GT(far.mean(X)[3], 100);
}

TEST(CountModel, IsASurrogateAmongOthers) {
  const Spills spills(30, 4);
  const Surrogates both(
      {AnySurrogate(fit_counts(spills.X, spills.counts)), AnySurrogate(fit(spills.X, spills.rate))});
  const std::vector<doe::Outcome> at_runs = both(spills.X, {});
  ASSERT_EQ(at_runs.size(), 30U);
  EXPECT_EQ(at_runs[7].values()[0], fit_counts(spills.X, spills.counts).mean(spills.X)[7]);
}

TEST(CountModel, BadInputIsNamed) {
  const MatrixXd X = MatrixXd::Random(3, 2);
  const auto text = [&](const VectorXd& counts, const CountOptions& options = {}) {
    return support::told([&] { fit_counts(X, counts, options); });
  };
  EXPECT_EQ(text(VectorXd{{1, 2}}),
            "kriging::fit_counts: X has 3 rows but counts has 2 entries; give one per run");
  EXPECT_EQ(
      text(VectorXd{{1, 2.5, 0}}),
      "kriging::fit_counts: counts[1] is 2.5; allowed are whole numbers from 0 to 10000; fit other responses "
      "with fit_transformed");
  EXPECT_EQ(text(VectorXd{{1, -1, 0}}).substr(0, 35), "kriging::fit_counts: counts[1] is -");
  EXPECT_EQ(text(VectorXd{{1, 1, 0}}, {.exposure = VectorXd{{1, 1, 0}}}),
            "kriging::fit_counts: exposure[2] is 0; allowed are finite numbers above 0");
  EXPECT_EQ(text(VectorXd{{1, 1, 0}}, {.lower = VectorXd{{0, 1}}, .upper = VectorXd{{1, 1}}}),
            "kriging::fit_counts: variable 1 has the bounds 1 and 1; allowed are finite ones with lower "
            "below upper");
  const CountModel model = fit_counts(X, VectorXd{{1, 2, 0}});
  EXPECT_EQ(support::told([&] { model.mean(MatrixXd::Constant(1, 2, std::nan(""))); }),
            "kriging::CountModel: X has an entry that is not finite or beyond 1e150; give numbers below it");
  EXPECT_EQ(support::told([&] { model.mean(MatrixXd::Zero(1, 3)); }),
            "kriging::CountModel: X has 3 columns; allowed are 2; give one per variable");
  EXPECT_EQ(support::told([&] { model.quantile(X, 1.0); }),
            "kriging::CountModel::quantile: p is 1; allowed is between 0 and 1; 0.975 is usual");
}

}  // namespace
