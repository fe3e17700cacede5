// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// How often do a default model's intervals hold the truth?
//
//   interval_coverage [RUNS...]      default: 50 100 200 runs
//
// One row a function and a number of runs, over 11 Latin hypercubes and 500 new points each: the share of
// observations within the central 50, 80 and 95 % interval, as median with the quartiles of the designs. For
// `process`, draws of the Gaussian process that a fit takes for granted, what is missing from 50, 80 and
// 95 % is the price of estimating its parameters. The other functions (tests/kriging/reference_cases.hpp)
// are no such draws; noisy4 is observed with noise of unit variance. `error` is the median of RMSE over the
// root of the mean predicted variance: above 1 the model is too sure of itself.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;

namespace {

constexpr int designs = 11, tests = 500;

Eigen::VectorXd normal_numbers(Eigen::Index count, doe::Seed seed) {
  doe::RandomStream random(seed);
  Eigen::VectorXd z(count);
  for (double& value : z) {
    const double u1 = random.uniform(), u2 = random.uniform();
    value = std::sqrt(-2 * std::log(1 - u1)) * std::cos(2 * reference::pi * u2);
  }
  return z;
}

// A draw at the points: Gaussian correlation, rates 4, 2, 1 and 0.5 on [0, 1]⁴, unit variance.
Eigen::VectorXd process(const Eigen::MatrixXd& X, doe::Seed seed) {
  const Eigen::RowVectorXd scale = (Eigen::RowVectorXd(4) << 2, std::sqrt(2.0), 1, std::sqrt(0.5)).finished();
  const Eigen::MatrixXd Z = X.array().rowwise() * scale.array();
  Eigen::MatrixXd R(X.rows(), X.rows());
  for (Eigen::Index i = 0; i < Z.rows(); ++i)
    R.col(i) = (-(Z.rowwise() - Z.row(i)).rowwise().squaredNorm()).array().exp();
  R.diagonal().array() += 1e-9;  // the draw's rounding: 3e-5 of its standard deviation
  return R.llt().matrixL() * normal_numbers(X.rows(), seed);
}

Eigen::VectorXd observed(const std::string& function, const Eigen::MatrixXd& X, doe::Seed seed) {
  if (function == "process") return process(X, seed);
  if (function == "branin4") return reference::values(reference::branin4, X);
  if (function == "ishigami4") return reference::values(reference::ishigami4, X);
  return reference::values(reference::noisy4, X) + normal_numbers(X.rows(), seed);
}

Validation validated(const std::string& function, int runs, doe::Seed seed) {
  Eigen::MatrixXd X(runs + tests, 4);
  X << reference::design(runs, 4, seed), reference::design(tests, 4, 1000 + seed);
  const Eigen::VectorXd y = observed(function, X, 2000 + seed);
  return validate(fit(X.topRows(runs), y.head(runs)), X.bottomRows(tests), y.tail(tests));
}

// Median with quartiles.
struct Spread {
  double lower, median, upper;
};

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
  };
  return {at(0.25), at(0.5), at(0.75)};
}

void print_row(const std::string& function, int runs) {
  std::vector<Validation> all;
  for (doe::Seed seed = 1; seed <= designs; ++seed) all.push_back(validated(function, runs, seed));
  std::printf("%-10s %5d", function.c_str(), runs);
  for (const double level : {0.5, 0.8, 0.95}) {
    std::vector<double> shares;
    for (const Validation& v : all) shares.push_back(100 * score(v, ErrorFunction::coverage, level));
    const Spread s = spread(shares);
    std::printf("   %5.1f (%5.1f to %5.1f)", s.median, s.lower, s.upper);
  }
  std::vector<double> ratios;
  for (const Validation& v : all) ratios.push_back(v.rmse / std::sqrt(v.observation_variance.mean()));
  std::printf("   %6.2f\n", spread(ratios).median);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) {
    sizes.push_back(std::atoi(argv[i]));
    if (sizes.back() >= 10) continue;
    std::fprintf(stderr,
                 "interval_coverage: \"%s\" is no number of runs; allowed are whole numbers from 10\n",
                 argv[i]);
    return 2;
  }
  if (sizes.empty()) sizes = {50, 100, 200};
  std::printf("%-10s %5s   %-22s   %-22s   %-22s   %6s\n", "function", "runs", "50 %", "80 %", "95 %",
              "error");
  for (const char* function : {"process", "branin4", "ishigami4", "noisy4"})
    for (const int runs : sizes) print_row(function, runs);
}
