// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Fits by maximum likelihood against the best known likelihoods of three functions of four inputs.
//
// Reference: multistart L-BFGS-B with the analytic gradient in NumPy, 50 starts at n = 100 and 8 at n = 500,
// length scales on [0, 1] in [0.01, 100] and nugget in [1e-10, 10]; likelihoods on the standardised response.
// Ours lie on the range of the data, which is a little shorter, and go to 102: that reaches 0.003 higher
// where an inert input stands at its bound. In that study no published program reached all three at n = 100
// with its defaults.

#include <gtest/gtest.h>

#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint::kriging;

namespace {

struct Case {
  std::string name;
  int runs;
  double likelihood, nrmse;
};

// The concentrated likelihood of y/sd is that of y plus n ln sd.
double standardized_likelihood(const Model& model, const reference::Data& data) {
  return model.log_likelihood() + static_cast<double>(data.y.size()) * std::log(reference::deviation(data.y));
}

// 0.01 is ten times the gain at which a search gives up. Equal likelihoods within it leave the NRMSE equal to
// a few per cent; two per cent is what the comparison asks for.
void expect_best_known(const Case& c, drawpoint::doe::Seed seed) {
  const reference::Data data = reference::training(c.name, c.runs), test = reference::testing(c.name);
  FitOptions options;
  options.seed = seed;
  options.estimation = Estimation::maximum_likelihood;
  const Model model = fit(data.X, data.y, options);
  EXPECT_NEAR(standardized_likelihood(model, data), c.likelihood, 0.01) << c.name << ", seed " << seed;
  EXPECT_LE(validate(model, test.X, test.y).nrmse, 1.02 * c.nrmse) << c.name << ", seed " << seed;
  EXPECT_EQ(model.status(), Status::converged) << model.message();
  EXPECT_GE(model.report().starts_agreed, 1);
  EXPECT_GE(model.report().evaluations, model.report().starts_tried);
}

}  // namespace

TEST(ReferenceCases, AreThePublishedOnes) {
  const Eigen::MatrixXd train = reference::design(100, 4, 1100), test = reference::design(2000, 4, 999);
  EXPECT_TRUE(
      train.row(0).isApprox(Eigen::RowVector4d(0.41583424, 0.14463602, 0.05350111, 0.18301584), 1e-7));
  EXPECT_TRUE(test.row(0).isApprox(Eigen::RowVector4d(0.61037633, 0.15774357, 0.67962024, 0.26200003), 1e-7));
  struct Check {
    std::string name;
    int runs;
    double first, mean, deviation;
  };
  const std::vector<Check> checks{{"branin4", 100, 94.573921562, 89.0181342559, 58.0592209291},
                                  {"ishigami4", 100, 0.725148825874, 3.73399165326, 3.56110307913},
                                  {"noisy4", 100, 6.71182295677, 11.863637315, 4.72624001983},
                                  {"branin4", 500, 28.080397227, 81.5714240257, 57.13109804},
                                  {"ishigami4", 500, 2.92422379313, 3.49373159058, 3.77371893157},
                                  {"noisy4", 500, 11.4136151094, 11.8001020323, 4.79923445326}};
  for (const Check& c : checks) {  // printed with twelve digits
    const Eigen::VectorXd y = reference::training(c.name, c.runs).y;
    EXPECT_NEAR(y[0] / c.first, 1.0, 1e-11) << c.name << " " << c.runs;
    EXPECT_NEAR(y.mean() / c.mean, 1.0, 1e-11) << c.name << " " << c.runs;
    EXPECT_NEAR(reference::deviation(y) / c.deviation, 1.0, 1e-11) << c.name << " " << c.runs;
  }
  const Eigen::VectorXd branin = reference::testing("branin4").y;  // printed with eight
  EXPECT_NEAR(branin.minCoeff(), 0.95784926, 1e-8);
  EXPECT_NEAR(branin.maxCoeff(), 359.42121, 1e-5);
}

TEST(LikeliestFit, ReachesTheBestKnownLikelihoodOfHundredRunsForEverySeed) {
  for (const Case& c :
       {Case{"branin4", 100, -10.60608, 0.020796}, Case{"ishigami4", 100, -62.56294, 0.046792},
        Case{"noisy4", 100, -39.23093, 0.021001}})
    for (drawpoint::doe::Seed seed = 1; seed <= 11; ++seed) expect_best_known(c, seed);
}

TEST(LikeliestFit, ReachesTheBestKnownLikelihoodOfFiveHundredNoisyRuns) {
  for (drawpoint::doe::Seed seed = 1; seed <= 3; ++seed)
    expect_best_known({"noisy4", 500, 10.67262, 0.010411}, seed);
}

// Without noise the likelihood grows with every bound that is widened, so not the likelihood but the error is
// compared, and the likelihood must only not be lower.
TEST(LikeliestFit, IsNoWorseThanTheBestKnownOfFiveHundredRunsWithoutNoise) {
  for (const Case& c : {Case{"branin4", 500, 1692.798, 2.10e-4}, Case{"ishigami4", 500, 1172.880, 1.15e-3}}) {
    const reference::Data data = reference::training(c.name, c.runs), test = reference::testing(c.name);
    FitOptions options;
    options.estimation = Estimation::maximum_likelihood;
    const Model model = fit(data.X, data.y, options);
    EXPECT_GE(standardized_likelihood(model, data), c.likelihood - 0.01) << c.name;
    EXPECT_LE(validate(model, test.X, test.y).nrmse, 1.02 * c.nrmse) << c.name;
  }
}
