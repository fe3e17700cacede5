// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// optimum_noise [SEEDS [FUNCTION]]: how far a noisy search ends from the known optimum: the true gap at the
/// point where the last model expects the best, after 50 runs of two inputs, 60 of three and 90 of six, noise
/// of 5, 10 and 20 % of the function's range; by the improvement of a re-interpolated model and by the
/// knowledge gradient. First designs as in optimum_gap, fits of 4 starts from 64 candidates.

#include <drawpoint/benchmarks/toolkit/optimum_functions.hpp>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/acquisition_gradient.hpp>
#include <drawpoint/kriging/fit.hpp>

namespace {

using namespace drawpoint;
using namespace drawpoint::benchmarks;

double gap_of(const Case& c, double noise, bool gradient, doe::Seed seed) {
  const doe::Problem problem = problem_of(c);
  const auto model_of = [&](const doe::Evaluations& runs) {
    kriging::FitOptions options = fit_options(c);
    options.starts = 4;
    options.candidates = 64;
    return kriging::fit(runs.X(), runs.y("gap"), options);
  };
  const auto next = [&](const doe::Evaluations& runs) -> doe::Criterion {
    const kriging::Model model = model_of(runs);
    return gradient ? kriging::log_knowledge_gradient(model, doe::Goal::minimize)
                    : kriging::log_expected_improvement(model, doe::Goal::minimize);
  };
  const auto f = [&](const VectorXd& u, doe::Seed draw) {
    return c.gap(u) + noise * c.range * doe::RandomStream(draw).normal();
  };
  doe::RefineOptions options;
  options.max_points = c.inputs == 2 ? 50 : c.inputs == 3 ? 60 : 90;
  options.propose.batch = 1;
  options.propose.seed = seed;
  options.propose.candidates = 500;
  options.evaluate.seed = seed;
  const auto found = doe::refine(f, problem, doe::optimized_latin_hypercube(problem, c.first, {.seed = seed}),
                                 next, options);
  const auto best = [&](const doe::Evaluations& runs) {
    return kriging::predicted_value(model_of(runs), doe::Goal::minimize);
  };
  return c.gap(doe::propose(found.runs, best, {.seed = 99}).row(0).transpose());
}

}  // namespace

int main(int argc, char** argv) {
  return all_cases("optimum_noise", argc, argv, [](const Case& c, int seeds) {
    for (const double noise : {0.05, 0.1, 0.2})
      for (const bool gradient : {false, true})
        print_gaps(c.name,
                   std::string(gradient ? "gradient, " : "improvement, ") +
                       std::to_string(static_cast<int>(std::round(100 * noise))) + " %",
                   seeds, [&](doe::Seed seed) { return gap_of(c, noise, gradient, seed); });
  });
}
