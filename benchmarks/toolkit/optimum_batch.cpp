// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// optimum_batch [SEEDS [FUNCTION]]: how far the best run is from the known optimum after 32 runs (Hartmann
/// 6: 48) in batches of 4 or 8, by the rule that keeps a batch apart: jointly, by a Kriging believer that is
/// fitted anew after each point, or one point per cell. Models and first designs as in optimum_gap.

#include <drawpoint/benchmarks/toolkit/optimum_functions.hpp>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/acquisition_joint.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <optional>

namespace {

using namespace drawpoint;
using namespace drawpoint::benchmarks;

doe::RefineOptions options_of(const Case& c, int batch, doe::BatchRule rule, doe::Seed seed) {
  doe::RefineOptions options;
  options.max_points = c.first + (c.inputs == 6 ? 48 : 32);
  options.propose.batch = batch;
  options.propose.seed = seed;
  options.propose.rule = rule;
  options.propose.candidates = 1000;
  return options;
}

double gap_of(const Case& c, int batch, doe::BatchRule rule, doe::Seed seed) {
  const doe::Problem problem = problem_of(c);
  const auto first = doe::optimized_latin_hypercube(problem, c.first, {.seed = seed});
  const auto f = [&](const VectorXd& u) { return c.gap(u); };
  doe::RefineOptions options = options_of(c, batch, rule, seed);
  std::optional<kriging::Model> model;
  const auto fitted = [&](const doe::Evaluations& runs) -> const kriging::Model& {
    return model.emplace(kriging::fit(runs.X(), runs.y("gap"), exact_fit_options(c)));
  };
  options.propose.believe = [&](const VectorXd& u) -> doe::Outcome { return (*model)(u); };
  const doe::JointSampler joint = [&](const doe::Evaluations& runs) {
    return kriging::joint_improvement(fitted(runs), doe::Goal::minimize);
  };
  const doe::Sampler single = [&](const doe::Evaluations& runs) {
    return kriging::log_expected_improvement(fitted(runs), doe::Goal::minimize);
  };
  const doe::Refinement found = rule == doe::BatchRule::joint
                                    ? doe::refine(f, problem, first, joint, options)
                                    : doe::refine(f, problem, first, single, options);
  return found.runs.y("gap").minCoeff();
}

}  // namespace

int main(int argc, char** argv) {
  return all_cases("optimum_batch", argc, argv, [](const Case& c, int seeds) {
    for (const int batch : {4, 8})
      for (const auto& [rule, name] : {std::pair{doe::BatchRule::joint, "joint"},
                                       {doe::BatchRule::believer, "believer"},
                                       {doe::BatchRule::cells, "cells"}})
        print_gaps(c.name, name + (" by " + std::to_string(batch)), seeds,
                   [&, rule = rule](doe::Seed seed) { return gap_of(c, batch, rule, seed); });
  });
}
