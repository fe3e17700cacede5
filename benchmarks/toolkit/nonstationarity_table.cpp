// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// nonstationarity_table: in how many of 20 designs is a response called uneven, and in how many is a jump
/// found? Takes no options; prints a table.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/benchmarks/toolkit/unit_box.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/nonstationarity.hpp>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace drawpoint;
using benchmarks::unit_box;
using Eigen::VectorXd;

constexpr int designs = 20;

/// On the unit box; `noise` is the deviation of a run at x.
struct Response {
  std::string name;
  int inputs;
  std::function<double(const VectorXd&)> f, noise;
};

double wave(const VectorXd& x) {
  double sum = std::sin(3 * x[0]);
  for (Eigen::Index k = 1; k < x.size(); ++k)
    sum += std::cos(static_cast<double>(1 + k) * x[k]) * (0.5 + x[k - 1]);
  return sum;
}

double friedman(const VectorXd& x) {
  return 10 * std::sin(M_PI * x[0] * x[1]) + 20 * std::pow(x[2] - 0.5, 2) + 10 * x[3] + 5 * x[4];
}

double branin(const VectorXd& x) {
  const double a = 15 * x[0] - 5, b = 15 * x[1];
  return std::pow(b - 5.1 / (4 * M_PI * M_PI) * a * a + 5 / M_PI * a - 6, 2) +
         10 * (1 - 1 / (8 * M_PI)) * std::cos(a) + 10;
}

double none(const VectorXd&) { return 0; }

std::function<double(const VectorXd&)> always(double noise) {
  return [noise](const VectorXd&) { return noise; };
}

/// A flat wave, and 1 more where `inside` holds.
std::function<double(const VectorXd&)> step(std::function<bool(const VectorXd&)> inside) {
  return [inside](const VectorXd& x) { return 0.3 * wave(x) + (inside(x) ? 1.0 : 0.0); };
}

std::vector<Response> responses() {
  const auto along_input = step([](const VectorXd& x) { return x[0] > 0.55; });
  const auto diagonal = step([](const VectorXd& x) { return x[0] + x[1] > 1.1; });
  return {{"even: wave", 2, wave, none},
          {"even: wave", 4, wave, none},
          {"even: wave, noise", 4, wave, always(0.1)},
          {"even: Friedman", 5, friedman, none},
          {"even: Branin", 2, branin, none},
          {"even: noise alone", 4, none, always(1)},
          {"jump with an input", 2, along_input, none},
          {"jump with an input", 4, along_input, none},
          {"jump with an input, noise", 5, step([](const VectorXd& x) { return x[4] > 0.3; }), always(0.05)},
          {"jump along a diagonal", 2, diagonal, none},
          {"jump along a diagonal", 4, diagonal, none},
          {"jump into a corner", 4, step([](const VectorXd& x) { return x[0] > 0.6 && x[1] > 0.6; }), none},
          {"jump into a disc", 2,
           step([](const VectorXd& x) { return (x.array() - 0.5).matrix().norm() < 0.3; }), none},
          {"bend", 4, [](const VectorXd& x) { return 0.3 * wave(x) + 4 * std::max(0.0, x[0] - 0.6); }, none},
          {"bump", 2,
           [](const VectorXd& x) {
             return 0.3 * wave(x) + std::exp(-80 * (x.array() - 0.7).matrix().squaredNorm());
           },
           none},
          {"noise grows with an input", 4, [](const VectorXd& x) { return 0.5 * wave(x); },
           [](const VectorXd& x) { return 0.02 + 0.5 * x[1]; }}};
}

void print(const Response& response, int runs) {
  const doe::Problem problem = unit_box(response.inputs);
  int uneven = 0, jumps = 0;
  for (doe::Seed seed = 1; seed <= designs; ++seed) {
    const Eigen::MatrixXd X = doe::optimized_latin_hypercube(problem, runs, {.seed = seed});
    VectorXd y(runs);
    doe::RandomStream random(77 + seed);
    for (Eigen::Index i = 0; i < runs; ++i) {
      const VectorXd x = X.row(i).transpose();
      y[i] = response.f(x) + response.noise(x) * random.normal();
    }
    const kriging::Stationarity found = kriging::check_stationarity(kriging::fit(X, y));
    uneven += found.uneven;
    jumps += found.jump.has_value();
  }
  std::printf("%-28s %6d %5d %7d %5d\n", response.name.c_str(), response.inputs, runs, uneven, jumps);
  std::fflush(stdout);
}

}  // namespace

int main() {
  std::printf("%-28s inputs  runs  uneven  jump   of %d designs\n", "response", designs);
  for (const int runs : {40, 80})
    for (const Response& response : responses()) print(response, runs);
}
