// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Whatever no model can be fitted to is refused with a text that says where, what, what is allowed and what
// to do.

#include <gtest/gtest.h>

#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <functional>

using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Call {
  MatrixXd X = reference::design(6, 2, 1);
  VectorXd y = VectorXd::LinSpaced(6, 0, 1);
  FitOptions options;
};

std::string refusal(const std::function<void(Call&)>& spoil) {
  Call call;
  spoil(call);
  try {
    fit(call.X, call.y, call.options);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST(BadInput, TheCallItselfIsGood) {
  EXPECT_EQ(refusal([](Call&) {}), "accepted");
}

TEST(BadInput, Runs) {
  EXPECT_EQ(refusal([](Call& c) { c.y.conservativeResize(5); }),
            "kriging::fit: X has 6 rows but y has 5 entries; give one response a run");
  EXPECT_EQ(refusal([](Call& c) { c.X.resize(6, 0); }),
            "kriging::fit: X has 0 columns; allowed is 1 or more; give one column per variable");
  EXPECT_EQ(refusal([](Call& c) {
              c.X.resize(0, 2);
              c.y.resize(0);
            }),
            "kriging::fit: X has 0 runs; allowed is 1 or more; give one row per run");
}

TEST(BadInput, Numbers) {
  EXPECT_EQ(refusal([](Call& c) { c.X(3, 1) = not_a_number; }),
            "kriging::fit: X(3, 1) is nan; allowed are finite numbers; leave failed runs out");
  EXPECT_EQ(refusal([](Call& c) { c.y[2] = -infinity; }),
            "kriging::fit: y[2] is -inf; allowed are finite numbers; leave failed runs out");
  EXPECT_EQ(refusal([](Call& c) { c.y[0] = 1e200; }),
            "kriging::fit: y[0] is 1e+200; allowed are magnitudes up to 1e150; change the unit");
  EXPECT_EQ(refusal([](Call& c) { c.y *= 1e-200; }),
            "kriging::fit: y has a range of 1e-200; allowed are ranges from 1e-150 on; change the unit");
  EXPECT_NE(refusal([](Call& c) { c.X.col(0) *= 1e-200; }).find("variable 0 has a range of"),
            std::string::npos);
}

TEST(BadInput, Box) {
  EXPECT_EQ(refusal([](Call& c) { c.options.lower = VectorXd::Zero(2); }),
            "kriging::fit: the box has 2 lower and 0 upper bounds but X has 2 columns; give one of each a "
            "variable, or "
            "neither");
  EXPECT_EQ(refusal([](Call& c) {
              c.options.lower = Eigen::Vector2d(0, 25);
              c.options.upper = Eigen::Vector2d(1, 5);
            }),
            "kriging::fit: variable 1: lower bound 25 is not below upper bound 5; swap or widen them");
  EXPECT_EQ(refusal([](Call& c) {
              c.options.lower = Eigen::Vector2d(0, not_a_number);
              c.options.upper = Eigen::Vector2d(1, 5);
            }),
            "kriging::fit: lower[1] is nan; allowed are finite numbers; leave failed runs out");
}

TEST(BadInput, Options) {
  EXPECT_EQ(refusal([](Call& c) { c.options.theta_lower = 0; }),
            "kriging::fit: theta_lower is 0; allowed are finite numbers above 0; use a small one for none");
  EXPECT_EQ(refusal([](Call& c) { c.options.theta_upper = VectorXd::Ones(3); }),
            "kriging::fit: theta_upper has 3 entries; allowed is one number, or one a column of X, 2");
  EXPECT_EQ(refusal([](Call& c) { c.options.theta_upper = Eigen::Vector2d(1, 1e-6); }),
            "kriging::fit: variable 1: theta_upper is 1e-06; allowed are finite numbers from theta_lower "
            "1.2e-05 on; raise it");
  EXPECT_EQ(
      refusal([](Call& c) {
        c.options.structure = Structure::isotropic;
        c.options.theta_upper = Eigen::Vector2d(1, 2);
      }),
      "kriging::fit: theta_lower or theta_upper has an entry per variable; an isotropic correlation has one "
      "theta for all numbers; give one number, or take product");
  EXPECT_EQ(
      refusal([](Call& c) { c.options.nugget_lower = not_a_number; }),
      "kriging::fit: nugget_lower is nan; allowed are finite numbers above 0; use a small one for none");
  EXPECT_EQ(
      refusal([](Call& c) { c.options.nugget_upper = 1e-12; }),
      "kriging::fit: nugget_upper is 1e-12; allowed are finite numbers from nugget_lower 1e-10 on; raise it");
  EXPECT_EQ(refusal([](Call& c) { c.options.nugget_power = -1; }),
            "kriging::fit: nugget_power is -1; allowed are finite numbers from 0 on; use 0.5, or 0 for a "
            "simulator without noise");
  EXPECT_EQ(refusal([](Call& c) { c.options.nugget_power = not_a_number; }),
            "kriging::fit: nugget_power is nan; allowed are finite numbers from 0 on; use 0.5, or 0 for a "
            "simulator without noise");
  EXPECT_EQ(refusal([](Call& c) { c.options.starts = 0; }),
            "kriging::fit: starts is 0; allowed is 1 or more; use 8");
  EXPECT_EQ(refusal([](Call& c) { c.options.candidates = 4; }),
            "kriging::fit: candidates is 4; allowed is starts 8 or more; raise it");
  EXPECT_EQ(refusal([](Call& c) { c.options.max_iterations = 0; }),
            "kriging::fit: max_iterations is 0; allowed is 1 or more; use 200");
}

TEST(BadInput, Exponents) {
  EXPECT_EQ(
      refusal([](Call& c) { c.options.exponent = Eigen::Vector2d(2, 2); }),
      "kriging::fit: exponent is given for the correlation gaussian; allowed is power_exponential; leave it "
      "empty");
  EXPECT_EQ(refusal([](Call& c) {
              c.options.correlation = Correlation::power_exponential;
              c.options.exponent = Eigen::Vector2d(2, 2.5);
            }),
            "kriging::fit: exponent[1] is 2.5; allowed are numbers from 1 to 2; use 2 for a smooth response");
  EXPECT_EQ(
      refusal([](Call& c) {
        c.options.correlation = Correlation::power_exponential;
        c.options.exponent = VectorXd::Ones(3);
      }),
      "kriging::fit: exponent has 3 entries; allowed is one a column of X, 2, or none; leave it empty to "
      "estimate it");
}

TEST(BadInput, NoiseVariances) {
  EXPECT_EQ(refusal([](Call& c) { c.options.noise_variance = VectorXd::Ones(6); }),
            "kriging::fit: noise_variance is given but noise is nugget; set noise to known, pooled or "
            "proportional");
  const auto with = [](const VectorXd& v) {
    return refusal([&](Call& c) {
      c.options.noise = Noise::known;
      c.options.noise_variance = v;
    });
  };
  EXPECT_EQ(with(VectorXd::Ones(5)),
            "kriging::fit: noise_variance has 5 entries but X has 6 rows; give one variance per run");
  EXPECT_EQ(with(-VectorXd::Ones(6)),
            "kriging::fit: noise_variance[0] is -1; allowed are 0 to 1e150; give variances, the squares of "
            "standard deviations");
  EXPECT_EQ(with(VectorXd::Zero(6)),
            "kriging::fit: noise_variance is 0 for all runs; allowed is one above 0; use Noise::nugget");
  EXPECT_EQ(with(VectorXd::Constant(6, not_a_number)),
            "kriging::fit: noise_variance[0] is nan; allowed are 0 to 1e150; give variances, the squares of "
            "standard deviations");
}

TEST(BadInput, TrendsAndThreads) {
  EXPECT_EQ(refusal([](Call& c) { c.options.trend = Trend::user; }),
            "kriging::fit: trend is user but basis.values is empty; give the functions");
  EXPECT_EQ(refusal([](Call& c) { c.options.basis.values = [](const VectorXd& x) { return x; }; }),
            "kriging::fit: basis.values is given but trend is not user; set trend to user");
  EXPECT_EQ(
      refusal([](Call& c) {
        c.options.trend = Trend::user;
        c.options.basis.values = [](const VectorXd&) { return VectorXd::Zero(2); };
      }),
      "kriging::fit: basis.values is 0 at all runs; allowed is one function that is not; add the constant 1");
  EXPECT_EQ(refusal([](Call& c) { c.options.threads = -1; }),
            "kriging::fit: threads is -1; allowed is 0 or more; use 0 for all cores");
}

TEST(BadInput, Points) {
  const Call call;
  const Model model = fit(call.X, call.y);
  EXPECT_THROW(model.predict(MatrixXd::Zero(1, 3)), std::invalid_argument);
  EXPECT_THROW(model.mean(MatrixXd::Constant(1, 2, not_a_number)), std::invalid_argument);
  EXPECT_THROW(model(VectorXd::Zero(1)), std::invalid_argument);
}
