// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/compare.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/fit_radial.hpp>
#include <drawpoint/kriging/polynomial.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const std::vector<NamedFitter<>> fitters{
    {"constant", [](const MatrixXd& X, const VectorXd& y) { return fit_polynomial(X, y, {.degree = 0}); }},
    {"quadratic", [](const MatrixXd& X, const VectorXd& y) { return fit_polynomial(X, y); }},
    {"cubic splines", [](const MatrixXd& X, const VectorXd& y) { return fit_radial(X, y); }},
    {"kriging", [](const MatrixXd& X, const VectorXd& y) { return fit(X, y); }}};

double parabola(const VectorXd& x) { return x[0] * x[0] + x[0] * x[1] - x[1]; }
double wave(const VectorXd& x) { return std::sin(7 * x[0]) * std::cos(3 * x[1]); }

}  // namespace

TEST(Compare, PicksTheKindThatFits) {
  const MatrixXd X = reference::design(30, 2, 3);
  VectorXd noisy = reference::values(parabola, X);
  doe::RandomStream random(4);
  for (double& value : noisy) value += 0.02 * random.normal();
  const VectorXd bent = reference::values(wave, X);
  for (const Estimator estimator : {Estimator::leave_one_out, Estimator::k_fold}) {
    const Measure measure{.estimator = estimator, .error = ErrorFunction::rmse, .target = 0.1};
    EXPECT_EQ(compare(measure, X, noisy, fitters).name(), "quadratic") << "its own kind";
    const Comparison<> c = compare(measure, X, bent, fitters);
    EXPECT_EQ(c.name(), "kriging");
    EXPECT_NE(c.model.as<Model>(), nullptr);
    EXPECT_EQ(c.model.as<Radial>(), nullptr);
    EXPECT_EQ(c.table.size(), 4u);
    EXPECT_EQ(c.met, c.table[3].assessment.value <= 0.1);
    EXPECT_EQ(best_of(measure, X, bent, fitters).mean(X), fit(X, bent).mean(X));
  }
}

// The closed form is taken where there is one, and it is that of the surrogate itself.
TEST(Compare, UsesTheClosedFormOfEachKind) {
  const MatrixXd X = reference::design(20, 2, 3);
  const VectorXd y = reference::values(wave, X);
  const Measure measure{.estimator = Estimator::leave_one_out, .error = ErrorFunction::rmse};
  const Comparison<> c = compare(measure, X, y, fitters);
  EXPECT_EQ(c.table[1].assessment.value, leave_one_out(fit_polynomial(X, y)).rmse);
  EXPECT_EQ(c.table[2].assessment.value, leave_one_out(fit_radial(X, y)).rmse);
  EXPECT_EQ(c.table[3].assessment.value, leave_one_out(fit(X, y)).rmse);
}

struct Mean {
  double value;
  Prediction predict(const MatrixXd& X, Target = Target::latent) const {
    return {mean(X), VectorXd::Zero(X.rows())};
  }
  VectorXd mean(const MatrixXd& X) const { return VectorXd::Constant(X.rows(), value); }
};

// Without a closed form each run is predicted by the mean of the others: it is missed by (y − ȳ) n/(n − 1).
TEST(Compare, RefitsWithoutAClosedForm) {
  const MatrixXd X = reference::design(10, 2, 3);
  const VectorXd y = reference::values(wave, X);
  const std::vector<NamedFitter<>> own{
      {"mean", [](const MatrixXd&, const VectorXd& v) { return Mean{v.mean()}; }}};
  const Comparison<> c =
      compare({.estimator = Estimator::leave_one_out, .error = ErrorFunction::rmse}, X, y, own);
  const double expected = std::sqrt((y.array() - y.mean()).square().mean()) * 10 / 9;
  EXPECT_NEAR(c.table[0].assessment.value, expected, 1e-14);
}

TEST(Compare, TakesTheFirstOfEquals) {
  const MatrixXd X = reference::design(12, 2, 3);
  const VectorXd y = reference::values(wave, X);
  const auto same = [](const MatrixXd& P, const VectorXd& v) { return fit_polynomial(P, v); };
  const Measure measure{.estimator = Estimator::k_fold, .error = ErrorFunction::q2};
  EXPECT_EQ(compare<Polynomial>(measure, X, y, {{"a", same}, {"b", same}}).best, 0u);
  // NRMSE of equal responses is NaN for all.
  const Measure undefined{.estimator = Estimator::k_fold, .error = ErrorFunction::nrmse};
  EXPECT_EQ(compare(undefined, X, VectorXd::Ones(12), fitters).best, 0u);
}

TEST(Compare, RefusesNothingToCompare) {
  const auto refusal = [](const std::vector<NamedFitter<>>& all) -> std::string {
    try {
      compare({}, reference::design(12, 2, 3), VectorXd::LinSpaced(12, 0, 1), all);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal({}), "kriging::compare: 0 fitters; allowed is 1 or more; name at least one");
  EXPECT_EQ(refusal({{"empty", {}}}),
            "kriging::compare: fitter \"empty\" has no function; give one of (X, y) that returns a "
            "surrogate");
}
