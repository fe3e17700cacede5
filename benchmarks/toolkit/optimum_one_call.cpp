// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// optimum_one_call [SEEDS]: the gap of the best run to the known optimum after 60 runs by kriging::optimize, with
/// default options: the functions of optimum_gap, and a welded beam with five limits (Ragsdell, Phillips 1976, in
/// the version whose cheapest design costs 1.86164) in a narrow and in a wide box.

#include <cstdio>
#include <cstdlib>
#include <drawpoint/benchmarks/toolkit/optimum_functions.hpp>
#include <drawpoint/kriging/optimize.hpp>
#include <drawpoint/tests/support/welded_beam.hpp>
#include <limits>
#include <string>

namespace {

using namespace drawpoint;
using namespace drawpoint::benchmarks;
using support::beam, support::weld;

/// Infinite where no run keeps the limits.
double gap_of(const kriging::Optimum& found, double optimum) {
  return found.feasible ? found.best.front().y[0] - optimum : std::numeric_limits<double>::infinity();
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 11;
  constexpr int budget = 60;
  for (const Case& c : cases)
    print_gaps(c.name, "one call", seeds, [&](doe::Seed seed) {
      const auto f = [&](const VectorXd& u) { return c.gap(u); };
      return gap_of(kriging::optimize(f, problem_of(c), budget, {.seed = seed}), 0.0);
    });
  for (const double thickest : {2.0, 5.0})
    print_gaps("Welded beam", "up to " + std::to_string(static_cast<int>(thickest)) + " in", seeds,
               [&](doe::Seed seed) {
                 return gap_of(kriging::optimize(weld, beam(thickest), budget, {.seed = seed}), 1.86164);
               });
  return 0;
}
