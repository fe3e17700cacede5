// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// optimum_gap [SEEDS]: how far the best run is from the known optimum after so many runs by expected improvement,
/// with candidates that climb and with random candidates alone. One run per batch, its place by the logarithm of
/// the improvement, a model that takes the function as exact (nugget 1e-10), first designs by
/// doe::optimized_latin_hypercube. Quartiles over the seeds (11), seconds per seed with all fits.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/acquisition.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <exception>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace drawpoint;
using Eigen::VectorXd;
using std::numbers::pi;

double branin(const VectorXd& u) {
  const double a = 15 * u[0] - 5, b = 15 * u[1];
  return std::pow(b - 5.1 / (4 * pi * pi) * a * a + 5 / pi * a - 6, 2) +
         10 * (1 - 1 / (8 * pi)) * std::cos(a) + 10 - 0.39788735772973816;
}

/// The logarithm of Goldstein and Price's function over its least value, 3: that spans five decades.
double goldstein_price(const VectorXd& u) {
  const double x = 4 * u[0] - 2, y = 4 * u[1] - 2;
  const double first =
      1 + std::pow(x + y + 1, 2) * (19 - 14 * x + 3 * x * x - 14 * y + 6 * x * y + 3 * y * y);
  const double second =
      30 + std::pow(2 * x - 3 * y, 2) * (18 - 32 * x + 12 * x * x + 48 * y - 36 * x * y + 27 * y * y);
  return std::log(first * second / 3);
}

constexpr std::array<double, 4> heights = {1, 1.2, 3, 3.2};

template <std::size_t d>
double hartmann(const VectorXd& u, const std::array<std::array<double, d>, 4>& rates,
                const std::array<std::array<double, d>, 4>& places) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    double exponent = 0;
    for (std::size_t k = 0; k < d; ++k)
      exponent += rates[i][k] * std::pow(u[static_cast<Eigen::Index>(k)] - places[i][k], 2);
    sum -= heights[i] * std::exp(-exponent);
  }
  return sum;
}

double hartmann3(const VectorXd& u) {
  return 3.8627797869493365 + hartmann<3>(u, {{{3, 10, 30}, {0.1, 10, 35}, {3, 10, 30}, {0.1, 10, 35}}},
                                          {{{0.3689, 0.1170, 0.2673},
                                            {0.4699, 0.4387, 0.7470},
                                            {0.1091, 0.8732, 0.5547},
                                            {0.0381, 0.5743, 0.8828}}});
}

double hartmann6(const VectorXd& u) {
  return 3.3223680114155147 + hartmann<6>(u,
                                          {{{10, 3, 17, 3.5, 1.7, 8},
                                            {0.05, 10, 17, 0.1, 8, 14},
                                            {3, 3.5, 1.7, 10, 17, 8},
                                            {17, 8, 0.05, 10, 0.1, 14}}},
                                          {{{0.1312, 0.1696, 0.5569, 0.0124, 0.8283, 0.5886},
                                            {0.2329, 0.4135, 0.8307, 0.3736, 0.1004, 0.9991},
                                            {0.2348, 0.1451, 0.3522, 0.2883, 0.3047, 0.6650},
                                            {0.4047, 0.8828, 0.8732, 0.5743, 0.1091, 0.0381}}});
}

struct Case {
  const char* name;
  int inputs, first, runs;
  double (*gap)(const VectorXd& u);
};

constexpr std::array cases = {
    Case{"Branin", 2, 10, 40, branin}, Case{"Goldstein-Price", 2, 10, 40, goldstein_price},
    Case{"Hartmann 3", 3, 15, 40, hartmann3}, Case{"Hartmann 6", 6, 30, 80, hartmann6}};

double gap_of(const Case& c, doe::Seed seed, bool climb) {
  doe::Problem problem;
  for (int k = 0; k < c.inputs; ++k) problem.variables.push_back({"u" + std::to_string(k), "1", 0.0, 1.0});
  problem.responses = {{"gap", "1", doe::Goal::minimize}};
  kriging::FitOptions exact;
  exact.lower = VectorXd::Zero(c.inputs);
  exact.upper = VectorXd::Ones(c.inputs);
  exact.nugget_lower = exact.nugget_upper = 1e-10;
  const auto improvement = [&](const doe::Evaluations& runs) -> doe::Criterion {
    return kriging::log_expected_improvement(kriging::fit(runs.X(), runs.y("gap"), exact),
                                             doe::Goal::minimize);
  };
  doe::RefineOptions options;
  options.max_points = c.runs;
  options.propose.batch = 1;
  options.propose.seed = seed;
  options.propose.climb = climb;
  const auto found =
      doe::refine([&](const VectorXd& u) { return c.gap(u); }, problem,
                  doe::optimized_latin_hypercube(problem, c.first, {.seed = seed}), improvement, options);
  return found.runs.y("gap").minCoeff();
}

void print(const Case& c, int seeds, bool climb) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<double> gaps;
  for (int seed = 1; seed <= seeds; ++seed) gaps.push_back(gap_of(c, static_cast<doe::Seed>(seed), climb));
  std::sort(gaps.begin(), gaps.end());
  const auto n = gaps.size();
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / seeds;
  std::printf("%-16s %4d %-9s %9.2g %9.2g %9.2g %9.2g %8.2f\n", c.name, c.runs, climb ? "climbing" : "random",
              gaps[n / 4], gaps[n / 2], gaps[3 * n / 4], gaps.back(), seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 11;
    if (seeds < 1) throw std::invalid_argument("SEEDS is below 1; give a whole number such as 11");
    std::printf("gap to the optimum over %d seeds\n%-16s %4s %-9s %9s %9s %9s %9s %8s\n", seeds, "function",
                "runs", "points", "quarter", "median", "three q.", "worst", "seconds");
    for (const Case& c : cases)
      for (const bool climb : {false, true}) print(c, seeds, climb);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "optimum_gap: %s\n", e.what());
    return 1;
  }
}
