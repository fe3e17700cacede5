// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Functions with known optima, as their height above it on the unit box, and how far searches stay from it.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <drawpoint/benchmarks/toolkit/unit_box.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/options.hpp>
#include <exception>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::benchmarks {

using Eigen::VectorXd;
using std::numbers::pi;

inline double branin(const VectorXd& u) {
  const double a = 15 * u[0] - 5, b = 15 * u[1];
  return std::pow(b - 5.1 / (4 * pi * pi) * a * a + 5 / pi * a - 6, 2) +
         10 * (1 - 1 / (8 * pi)) * std::cos(a) + 10 - 0.39788735772973816;
}

/// The logarithm of Goldstein and Price's function over its least value, 3: that spans five decades.
inline double goldstein_price(const VectorXd& u) {
  const double x = 4 * u[0] - 2, y = 4 * u[1] - 2;
  const double first =
      1 + std::pow(x + y + 1, 2) * (19 - 14 * x + 3 * x * x - 14 * y + 6 * x * y + 3 * y * y);
  const double second =
      30 + std::pow(2 * x - 3 * y, 2) * (18 - 32 * x + 12 * x * x + 48 * y - 36 * x * y + 27 * y * y);
  return std::log(first * second / 3);
}

inline constexpr std::array<double, 4> heights = {1, 1.2, 3, 3.2};

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

inline double hartmann3(const VectorXd& u) {
  return 3.8627797869493365 + hartmann<3>(u, {{{3, 10, 30}, {0.1, 10, 35}, {3, 10, 30}, {0.1, 10, 35}}},
                                          {{{0.3689, 0.1170, 0.2673},
                                            {0.4699, 0.4387, 0.7470},
                                            {0.1091, 0.8732, 0.5547},
                                            {0.0381, 0.5743, 0.8828}}});
}

inline double hartmann6(const VectorXd& u) {
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
  double range;  ///< of the function over the box
  double (*gap)(const VectorXd& u);
};

inline constexpr std::array cases = {
    Case{"Branin", 2, 10, 40, 308.1, branin}, Case{"Goldstein-Price", 2, 10, 40, 12.75, goldstein_price},
    Case{"Hartmann 3", 3, 15, 40, 3.86, hartmann3}, Case{"Hartmann 6", 6, 30, 80, 3.32, hartmann6}};

inline doe::Problem problem_of(const Case& c) {
  doe::Problem problem = unit_box(c.inputs);
  problem.responses.front().name = "gap";
  return problem;
}

/// Fits in the unit box.
inline kriging::FitOptions fit_options(const Case& c) {
  kriging::FitOptions options;
  options.lower = VectorXd::Zero(c.inputs);
  options.upper = VectorXd::Ones(c.inputs);
  return options;
}

/// Of a function that is exact.
inline kriging::FitOptions exact_fit_options(const Case& c) {
  kriging::FitOptions options = fit_options(c);
  options.nugget_lower = options.nugget_upper = 1e-10;
  return options;
}

/// Prints quartiles of the gaps of the seeds and the seconds per seed of gap_of(seed).
template <class Gap>
void print_gaps(const char* name, const std::string& way, int seeds, const Gap& gap_of) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<double> gaps;
  for (int seed = 1; seed <= seeds; ++seed) gaps.push_back(gap_of(static_cast<doe::Seed>(seed)));
  std::sort(gaps.begin(), gaps.end());
  const auto n = gaps.size();
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / seeds;
  std::printf("%-16s %-20s %9.2g %9.2g %9.2g %9.2g %8.2f\n", name, way.c_str(), gaps[n / 4], gaps[n / 2],
              gaps[3 * n / 4], gaps.back(), seconds);
  std::fflush(stdout);
}

/// Runs the cases; the words of the command line are the number of seeds, else 11, and one function, else
/// all.
template <class Study>
int all_cases(const char* program, int argc, char** argv, const Study& study) {
  try {
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 11;
    if (seeds < 1) throw std::invalid_argument("SEEDS is below 1; give a whole number such as 11");
    std::printf("gap to the optimum over %d seeds\n%-16s %-20s %9s %9s %9s %9s %8s\n", seeds, "function",
                "way", "quarter", "median", "three q.", "worst", "seconds");
    for (const Case& c : cases)
      if (argc < 3 || std::string(argv[2]) == c.name) study(c, seeds);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", program, e.what());
    return 1;
  }
}

}  // namespace drawpoint::benchmarks
