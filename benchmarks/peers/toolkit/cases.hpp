// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What our toolkit and its peers are both asked, and how the answers are told to
/// benchmarks/peers/compare_toolkit.
///
/// Searches: 250 generations of 100 points, seeds 1..11, simulated binary crossover 0.9 with index 20,
/// polynomial mutation 1/d with index 20 (Deb's settings); measured by the hypervolume of the points below
/// the reference. Fronts: standard normals made positive on the unit sphere, reference 1.1
/// (tests/pareto/test_functions.hpp). An answer is one line of JSON. Times are CPU seconds of the process,
/// the least of the repeats.

#include <algorithm>
#include <cstdio>
#include <drawpoint/benchmarks/toolkit/cpu_time.hpp>
#include <string>
#include <vector>

namespace drawpoint::peers {

using benchmarks::cpu_seconds;
using benchmarks::least_seconds;

struct SearchCase {
  const char* name;
  unsigned d, m;
};

inline const std::vector<SearchCase>& search_cases() {
  static const std::vector<SearchCase> cases{
      {"ZDT1", 30, 2}, {"ZDT3", 30, 2}, {"ZDT6", 10, 2}, {"DTLZ2", 12, 3}};
  return cases;
}

inline constexpr unsigned generations = 250, population = 100, seeds = 11;
inline constexpr double crossover_rate = 0.9, crossover_index = 20.0, mutation_index = 20.0, reference = 1.1;

struct FrontCase {
  int m, n, seed;
};

inline const std::vector<FrontCase>& front_cases() {
  static const std::vector<FrontCase> cases{{3, 100, 31},  {3, 1000, 31}, {3, 10000, 31}, {4, 100, 41},
                                            {4, 1000, 41}, {5, 300, 51},  {6, 100, 61},   {6, 300, 61}};
  return cases;
}

inline void tell_search(const char* name, std::vector<double> volumes, double seconds) {
  std::sort(volumes.begin(), volumes.end());
  std::printf(
      "{\"table\": \"search\", \"case\": \"%s\", \"median\": %.17g, \"least\": %.17g, \"largest\": %.17g, "
      "\"cpu_s\": %.6g}\n",
      name, volumes[volumes.size() / 2], volumes.front(), volumes.back(), seconds);
  std::fflush(stdout);
}

inline void tell_volume(const FrontCase& c, double volume, double seconds) {
  std::printf("{\"table\": \"hypervolume\", \"case\": \"%d-d %d\", \"volume\": %.17g, \"cpu_s\": %.6g}\n",
              c.m, c.n, volume, seconds);
  std::fflush(stdout);
}

}  // namespace drawpoint::peers
