// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// optimum_gap [SEEDS [FUNCTION]]: how far the best run is from the known optimum after so many runs by
/// expected improvement, with random candidates alone, with candidates that climb, and with every third run
/// where the model expects the best. One run per batch, its place by the logarithm of the improvement, a
/// model that takes the function as exact (nugget 1e-10), first designs by doe::optimized_latin_hypercube.
/// Quartiles over the seeds (11), seconds per seed with all fits.

#include <drawpoint/benchmarks/toolkit/optimum_functions.hpp>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/acquisition.hpp>
#include <drawpoint/kriging/fit.hpp>

namespace {

using namespace drawpoint;
using namespace drawpoint::benchmarks;

enum class Way { random, climbing, finishing };

double gap_of(const Case& c, doe::Seed seed, Way way) {
  const doe::Problem problem = problem_of(c);
  const auto model_of = [&](const doe::Evaluations& runs) {
    return kriging::fit(runs.X(), runs.y("gap"), exact_fit_options(c));
  };
  const doe::Sampler improvement = [&](const doe::Evaluations& runs) {
    return kriging::log_expected_improvement(model_of(runs), doe::Goal::minimize);
  };
  const doe::Sampler predicted = [&](const doe::Evaluations& runs) {
    return kriging::predicted_value(model_of(runs), doe::Goal::minimize);
  };
  const doe::Mix mix(way == Way::finishing ? std::vector<doe::Share>{{2, improvement}, {1, predicted}}
                                           : std::vector<doe::Share>{{1, improvement}});
  doe::RefineOptions options;
  options.max_points = c.runs;
  options.propose.batch = 1;
  options.propose.seed = seed;
  options.propose.climb = way != Way::random;
  const auto found =
      doe::refine([&](const VectorXd& u) { return c.gap(u); }, problem,
                  doe::optimized_latin_hypercube(problem, c.first, {.seed = seed}), mix, options);
  return found.runs.y("gap").minCoeff();
}

}  // namespace

int main(int argc, char** argv) {
  return all_cases("optimum_gap", argc, argv, [](const Case& c, int seeds) {
    for (const auto& [way, name] : {std::pair{Way::random, "random candidates"},
                                    {Way::climbing, "climbing"},
                                    {Way::finishing, "every third predicted"}})
      print_gaps(c.name, name, seeds, [&, way = way](doe::Seed seed) { return gap_of(c, seed, way); });
  });
}
