// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// No surrogate and no search depends on the units of inputs and responses.
///
/// A unit is a power of two, 1.3e8 or 7.5e-9: it changes no digit of a number, so a fit takes the same way and
/// only what is compared with a number of some unit may differ. Predictions then scale to round-off: 1e-9 of
/// their range leaves room for sums in another order, and is a hundredth of what an absolute term of 1e-8 of a
/// unit would do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <drawpoint/kriging/any_surrogate.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/fit_fidelities.hpp>
#include <drawpoint/kriging/fit_nearest.hpp>
#include <drawpoint/kriging/fit_radial.hpp>
#include <drawpoint/kriging/optimize.hpp>
#include <drawpoint/kriging/polynomial.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <limits>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const double large = std::exp2(27), small = std::exp2(-27);

struct Units {
  Eigen::RowVector2d x;
  double y;
};

const std::vector<Units> units{{{large, large}, 1},     {{small, small}, 1},     {{1, 1}, large},
                               {{1, 1}, small},         {{large, small}, small}, {{small, large}, large},
                               {{small, small}, small}, {{large, large}, large}};

struct Kind {
  const char* name;
  AnySurrogate (*fitted)(const MatrixXd& X, const VectorXd& y);
};

AnySurrogate of_two_fidelities(const MatrixXd& X, const VectorXd& y) {
  const FidelityLevel coarse{"coarse", X, y}, fine{"fine", X.topRows(15), 0.5 * y.head(15)};
  return fit_fidelities({coarse, fine});
}

const std::vector<Kind> kinds{
    {"usual", [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate { return fit(X, y); }},
    {"likeliest",
     [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate {
       return fit(X, y, {.estimation = Estimation::maximum_likelihood});
     }},
    {"exact",
     [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate { return fit(X, y, {.noise = Noise::none}); }},
    {"Matern 5/2",
     [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate {
       return fit(X, y, {.correlation = Correlation::matern52, .trend = Trend::quadratic});
     }},
    {"power exponential",
     [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate {
       return fit(X, y, {.correlation = Correlation::power_exponential, .trend = Trend::blind});
     }},
    {"isotropic",
     [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate {
       return fit(X, y, {.structure = Structure::isotropic});
     }},
    {"additive",
     [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate {
       return fit(X, y, {.structure = Structure::additive});
     }},
    {"nearest runs",
     [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate {
       return fit_nearest(X, y, {}, {.neighbourhood = 20});
     }},
    {"chosen",
     [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate {
       return choose_fit(X, y, usual_kinds()).model;
     }},
    {"polynomial",
     [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate {
       return fit_polynomial(X, y, {.degree = 3});
     }},
    {"chosen polynomial",
     [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate {
       return fit_polynomial(X, y, {.degree = 3, .selection = Selection::leave_one_out});
     }},
    {"radial", [](const MatrixXd& X, const VectorXd& y) -> AnySurrogate { return fit_radial(X, y); }},
    {"two fidelities", of_two_fidelities}};

/// X with its columns in other units.
MatrixXd in_units(MatrixXd X, const Eigen::RowVector2d& unit) {
  for (Eigen::Index j = 0; j < 2; ++j) X.col(j) *= unit[j];
  return X;
}

double hills(const VectorXd& x) { return std::sin(5 * x[0]) + 2 * (x[1] - 0.4) * (x[1] - 0.4); }

class Kinds : public testing::TestWithParam<Kind> {};

TEST_P(Kinds, DoNotDependOnUnits) {
  const MatrixXd X = reference::design(30, 2, 21), at = reference::design(40, 2, 22);
  VectorXd y = reference::values(hills, X);
  doe::RandomStream random(4);
  for (double& value : y) value += 0.05 * random.normal();
  const Prediction plain = GetParam().fitted(X, y).predict(at, Target::observation);
  const double range = y.maxCoeff() - y.minCoeff();
  for (const Units& unit : units) {
    const Prediction other =
        GetParam().fitted(in_units(X, unit.x), unit.y * y).predict(in_units(at, unit.x), Target::observation);
    for (Eigen::Index i = 0; i < at.rows(); ++i) {
      EXPECT_NEAR(other.mean[i] / unit.y, plain.mean[i], 1e-9 * range) << unit.x << ", " << unit.y;
      EXPECT_NEAR(other.variance[i] / (unit.y * unit.y), plain.variance[i], 1e-9 * range * range)
          << unit.x << ", " << unit.y;
    }
  }
}

std::string name_of_kind(const testing::TestParamInfo<Kind>& info) {
  std::string name;
  for (const char c : std::string(info.param.name))
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(AnyUnit, Kinds, testing::ValuesIn(kinds), name_of_kind);

/// A problem of two inputs: one objective, or two and a limit, in the units.
struct Search {
  doe::Problem problem;
  doe::Outcome run(const VectorXd& x, const Units& unit) const {
    const double u = x[0] / unit.x[0], v = x[1] / unit.x[1];
    const double f = std::cos(3 * u) + (v - 0.3) * (v - 0.3) - 0.5;
    if (problem.responses.size() == 1) return {unit.y * f};
    return {unit.y * f, u - v, unit.y * (u + v)};
  }
};

Search search_in(const Units& unit, bool several) {
  Search search{{{{"u", "m", 0, unit.x[0]}, {"v", "m", 0, unit.x[1]}}, {{"f", "N", doe::Goal::minimize}}}};
  if (several) {
    search.problem.responses.push_back({"g", "1", doe::Goal::minimize});
    search.problem.responses.push_back(
        {.name = "sum", .unit = "N", .goal = doe::Goal::at_most, .limit = 1.25 * unit.y});
  }
  search.problem.deterministic = true;
  return search;
}

Optimum found_in(const Units& unit, bool several) {
  const Search search = search_in(unit, several);
  return optimize([&](const VectorXd& x) { return search.run(x, unit); }, search.problem, 24);
}

/// The least of the first objective, or of both as a sum, in units of 1.
double least_of(const Optimum& found, const Units& unit) {
  double least = std::numeric_limits<double>::infinity();
  for (const OptimalPoint& best : found.best) {
    const double other = best.y.size() > 1 ? best.y[1] : 0.0;
    least = std::min(least, best.y[0] / unit.y + other);
  }
  return least;
}

class Searches : public testing::TestWithParam<bool> {};

// A criterion is a logarithm, which a unit of the response shifts: its last digits differ. A climb, whose steps of
// differences begin with 1e-4 of the box, then ends elsewhere on a flat crest, and this grows from run to run. So
// the first chosen run, the ninth, counts, to ten such steps, and what is found, to 1e-3 of the range.
TEST_P(Searches, FindTheSameInAnyUnit) {
  const Units one{{1, 1}, 1};
  const Optimum plain = found_in(one, GetParam());
  ASSERT_EQ(plain.runs.rows.size(), 24u);
  for (const Units& unit : units) {
    const Optimum other = found_in(unit, GetParam());
    ASSERT_EQ(other.runs.rows.size(), 24u);
    for (Eigen::Index j = 0; j < 2; ++j)
      EXPECT_NEAR(other.runs.rows[8].x[j] / unit.x[j], plain.runs.rows[8].x[j], 1e-3)
          << unit.x << ", " << unit.y << ", input " << j;
    EXPECT_TRUE(other.feasible);
    EXPECT_NEAR(least_of(other, unit), least_of(plain, one), 2e-3) << unit.x << ", " << unit.y;
  }
}

INSTANTIATE_TEST_SUITE_P(AnyUnit, Searches, testing::Bool());

}  // namespace
