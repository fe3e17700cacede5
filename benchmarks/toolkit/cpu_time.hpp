// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <ctime>
#include <limits>

/// CPU time of the process, for figures that other load on the machine must not change [s].
namespace drawpoint::benchmarks {

inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The least time of up to 200 calls, as many as fit in half a second, three at least.
template <class Call>
double least_seconds(const Call& call) {
  double least = std::numeric_limits<double>::infinity(), spent = 0.0;
  for (int k = 0; k < 3 || (k < 200 && spent < 0.5); ++k) {
    const double start = cpu_seconds();
    call();
    const double time = cpu_seconds() - start;
    least = std::min(least, time);
    spent += time;
  }
  return least;
}

}  // namespace drawpoint::benchmarks
