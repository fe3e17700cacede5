// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// optimum_one_call [SEEDS]: the gap of the best run to the known optimum after 60 runs by kriging::optimize, with
/// default options: the functions of optimum_gap, and a welded beam with five limits (Ragsdell, Phillips 1976, in
/// the version whose cheapest design costs 1.86164) in a narrow and in a wide box.

#include <cstdio>
#include <cstdlib>
#include <drawpoint/benchmarks/toolkit/optimum_functions.hpp>
#include <drawpoint/kriging/optimize.hpp>
#include <limits>
#include <string>

namespace {

using namespace drawpoint;
using namespace drawpoint::benchmarks;

doe::Problem beam(double thickest) {
  return {.variables = {{"weld_height", "in", 0.125, thickest},
                        {"weld_length", "in", 0.1, 10.0},
                        {"bar_depth", "in", 0.1, 10.0},
                        {"bar_width", "in", 0.125, thickest}},
          .responses = {{"cost", "USD", doe::Goal::minimize},
                        {"shear_stress", "psi", doe::Goal::at_most, 13600.0},
                        {"bending_stress", "psi", doe::Goal::at_most, 30000.0},
                        {"weld_beyond_bar", "in", doe::Goal::at_most, 0.0},
                        {"deflection", "in", doe::Goal::at_most, 0.25},
                        {"buckling_load", "lbf", doe::Goal::at_least, 6000.0}}};
}

doe::Outcome weld(const VectorXd& x) {
  const double h = x[0], l = x[1], t = x[2], b = x[3];
  const double q = 0.25 * (h + t) * (h + t), arm = std::sqrt(0.25 * l * l + q);
  const double direct = 6000.0 / (std::sqrt(2.0) * h * l);
  const double twist = 6000.0 * (14.0 + 0.5 * l) * arm / (2.0 * std::sqrt(2.0) * h * l * (l * l / 12.0 + q));
  return {1.10471 * h * h * l + 0.04811 * t * b * (14.0 + l),
          std::sqrt(direct * direct + twist * twist + l * direct * twist / arm),
          504000.0 / (t * t * b),
          h - b,
          2.1952 / (t * t * t * b),
          64746.022 * (1.0 - 0.0282346 * t) * t * b * b * b};
}

/// Of an infeasible end: infinite.
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
