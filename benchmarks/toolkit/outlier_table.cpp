// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// outlier_table: in how many of 40 designs is a run that does not belong named, and how many others are? Takes
/// no options; prints a table.

#include <array>
#include <cmath>
#include <cstdio>
#include <drawpoint/benchmarks/toolkit/unit_box.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/kriging/outliers.hpp>
#include <exception>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace drawpoint;
using benchmarks::unit_box;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int designs = 40;

/// On the unit box.
struct Function {
  const char* name;
  int inputs;
  double (*f)(const VectorXd&);
};

double friedman(const VectorXd& u) {
  return 10 * std::sin(M_PI * u[0] * u[1]) + 20 * std::pow(u[2] - .5, 2) + 10 * u[3] + 5 * u[4];
}

double branin(const VectorXd& u) {
  const double a = -5 + 15 * u[0], b = 15 * u[1];
  return std::pow(b - 5.1 / (4 * M_PI * M_PI) * a * a + 5 / M_PI * a - 6, 2) +
         10 * (1 - 1 / (8 * M_PI)) * std::cos(a) + 10;
}

double jump(const VectorXd& u) { return (u[0] > .6 ? 10 : 0) + u[1]; }

double peak(const VectorXd& u) {
  return 100 * std::exp(-40 * (std::pow(u[0] - .3, 2) + std::pow(u[1] - .6, 2))) + u[2];
}

double sum(const VectorXd& u) { return u.sum(); }

double waves(const VectorXd& u) {
  return std::sin(5 * u[0]) + std::cos(4 * u[1]) * u[2] + .5 * std::sin(6 * u[3] * u[0]);
}

constexpr std::array functions = {Function{"Friedman", 5, friedman}, Function{"Branin", 2, branin},
                                  Function{"jump", 2, jump},         Function{"narrow peak", 3, peak},
                                  Function{"sum", 4, sum},           Function{"waves", 4, waves}};

struct Setting {
  int runs;
  double noise, outlier;  // in deviations of the response
};

struct Count {
  int found = 0, others = 0;
};

/// Every second one with the corners, where they are two fifths of the runs or less.
MatrixXd design_of(const Function& function, int runs, int seed) {
  MatrixXd X = doe::latin_hypercube(unit_box(function.inputs), runs, {.seed = static_cast<doe::Seed>(seed)});
  const int corners = 1 << function.inputs;
  if (5 * corners <= 2 * runs && seed % 2 == 0)
    for (int corner = 0; corner < corners; ++corner)
      for (int k = 0; k < function.inputs; ++k) X(corner, k) = corner >> k & 1;
  return X;
}

void count(const Function& function, const Setting& setting, int seed, Count& counted) {
  const MatrixXd X = design_of(function, setting.runs, seed);
  std::mt19937 random(static_cast<unsigned>(77 * (seed - 1) + setting.runs));
  std::normal_distribution<> normal;
  VectorXd y(setting.runs);
  for (int i = 0; i < setting.runs; ++i) y[i] = function.f(X.row(i).transpose());
  const double deviation = std::sqrt((y.array() - y.mean()).square().mean());
  for (double& value : y) value += setting.noise * deviation * normal(random);
  const auto bad = static_cast<Eigen::Index>(random() % static_cast<unsigned>(setting.runs));
  y[bad] += setting.outlier * deviation;
  kriging::FitOptions options;
  options.seed = 1;
  options.lower = VectorXd::Zero(function.inputs);
  options.upper = VectorXd::Ones(function.inputs);
  const auto fitter = [&](const MatrixXd& P, const VectorXd& v) {
    return kriging::TransformedModel(kriging::fit(P, v, options));
  };
  for (const kriging::Outlier& outlier : kriging::find_outliers(fitter(X, y), X, y, fitter))
    ++(setting.outlier > 0 && outlier.run == bad ? counted.found : counted.others);
}

}  // namespace

int main() {
  try {
    std::printf("of %d designs\n%-12s %5s %6s %9s %6s %12s\n", designs, "response", "runs", "noise",
                "outlier", "found", "others named");
    for (const Function& function : functions)
      for (const int runs : {20, 60})
        for (const double noise : {0.0, 0.1})
          for (const double outlier : {0.0, 3.0, 10.0}) {
            Count counted;
            for (int seed = 1; seed <= designs; ++seed)
              count(function, {runs, noise, outlier}, seed, counted);
            std::printf("%-12s %5d %6.1f %9.0f %6d %12d\n", function.name, runs, noise, outlier,
                        counted.found, counted.others);
            std::fflush(stdout);
          }
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "outlier_table: %s\n", e.what());
    return 1;
  }
}
