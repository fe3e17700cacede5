// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// What adaptive sampling is worth: the error of a Kriging model after so many runs, chosen in six ways.
//
//   adaptive_sampling [SEEDS] [FUNCTION]      11 seeds and all functions by default
// One-shot designs: random Latin hypercube, scrambled Sobol'. Adaptive, from one Latin hypercube with corners
// of 10 runs (d = 2) or 32 (d = 4) in batches of 5: the largest Kriging variance (kept apart by the penalty),
// Voronoi cells alone, LOLA-Voronoi as the paper has it, SUMO's product form, and 0.7 LOLA-Voronoi + 0.3
// disagreement of the model with the one of the batch before. One surrogate measures all: kriging::fit by its
// default options, NRMSE over 4000 scrambled Sobol' points. Median and quartiles over the seeds; the lines of
// a function share its first designs.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/bumpy_functions.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

using namespace drawpoint;

namespace {

struct Case {
  std::string name;
  doe::Problem problem;
  double (*f)(const Eigen::VectorXd&);
  int first;
  std::vector<int> budgets;
};

doe::Problem box(int d, double lower, double upper) {
  doe::Problem problem{{}, {{"y", "1"}}};
  for (int j = 0; j < d; ++j) problem.variables.push_back({"x" + std::to_string(j), "1", lower, upper});
  return problem;
}

std::vector<Case> cases() {
  return {{"peaks", box(2, -5, 5), kriging::reference::peaks, 10, {25, 50, 100}},
          {"ring", box(2, -2, 2), kriging::reference::ring, 10, {25, 50, 100}},
          {"branin4", box(4, 0, 1), kriging::reference::branin4, 32, {50, 80, 120}}};
}

kriging::Model fitted(const doe::Evaluations& runs) { return kriging::fit(runs.X(), runs.y("y")); }

double error(const Case& c, const doe::Evaluations& runs) {
  const Eigen::MatrixXd X = doe::scrambled_sobol(c.problem, 4000, {.seed = 4711});
  return kriging::validate(fitted(runs), X, kriging::reference::values(c.f, X)).nrmse;
}

doe::Criterion widest(const doe::Evaluations& runs) {
  return [model = fitted(runs)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    return model.predict(X).variance;
  };
}

/// The model of now against the one of the batch before.
doe::Sampler change_of_model() {
  return [last = std::shared_ptr<kriging::Model>()](const doe::Evaluations& runs) mutable -> doe::Criterion {
    const auto now = std::make_shared<kriging::Model>(fitted(runs));
    const auto before = std::exchange(last, now);
    const auto mean = [](std::shared_ptr<kriging::Model> model) -> doe::Criterion {
      return [model](const Eigen::MatrixXd& X) -> Eigen::VectorXd { return model->mean(X); };
    };
    if (!before) return doe::distance_to_runs(runs);
    return doe::disagreement({mean(now), mean(before)});
  };
}

doe::Mix alone(doe::Sampler sampler) { return doe::Mix({{1.0, std::move(sampler)}}); }

doe::Mix sampler(const std::string& method, doe::Seed seed) {
  if (method == "max variance") return alone(widest);
  if (method == "Voronoi") return alone(doe::voronoi_sampler({.seed = seed}));
  if (method == "LOLA-Voronoi") return alone(doe::LolaVoronoi({.seed = seed}));
  return doe::Mix({{0.7, doe::LolaVoronoi({.seed = seed})}, {0.3, change_of_model()}});
}

/// NRMSE at each budget.
std::vector<double> one_shot(const Case& c, bool sobol, doe::Seed seed) {
  std::vector<double> errors;
  for (const int n : c.budgets) {
    const Eigen::MatrixXd X = sobol ? doe::scrambled_sobol(c.problem, n, {.seed = seed})
                                    : doe::latin_hypercube(c.problem, n, {.seed = seed});
    errors.push_back(error(c, doe::evaluate(c.f, c.problem, X)));
  }
  return errors;
}

std::vector<double> adaptive(const Case& c, const std::string& method, doe::Seed seed) {
  const Eigen::MatrixXd first = doe::latin_hypercube(c.problem, c.first, {.seed = seed, .corners = true});
  doe::RefineOptions options{.max_points = c.budgets.back()};
  options.propose.batch = 5;
  options.propose.seed = seed;
  if (method == "max variance") options.propose.rule = doe::BatchRule::penalty;
  const doe::Evaluations runs = doe::refine(c.f, c.problem, first, sampler(method, seed), options).runs;
  std::vector<double> errors;
  for (const int n : c.budgets)
    errors.push_back(error(c, {c.problem, {runs.rows.begin(), runs.rows.begin() + n}}));
  return errors;
}

void compare(const Case& c, int seeds) {
  std::printf("\n%s: NRMSE, median [quartiles] of %d seeds\n%-14s", c.name.c_str(), seeds, "runs");
  for (const int n : c.budgets) std::printf("  %-26d", n);
  std::printf("\n");
  for (const std::string method :
       {"LHS", "Sobol", "max variance", "Voronoi", "LOLA-Voronoi", "0.7 LV + 0.3 e"}) {
    std::vector<Eigen::VectorXd> errors(c.budgets.size(), Eigen::VectorXd(seeds));
    for (int s = 0; s < seeds; ++s) {
      const doe::Seed seed = 1 + s;
      const bool planned = method == "LHS" || method == "Sobol";
      const auto found = planned ? one_shot(c, method == "Sobol", seed) : adaptive(c, method, seed);
      for (std::size_t b = 0; b < found.size(); ++b) errors[b][s] = found[b];
    }
    std::printf("%-14s", method.c_str());
    for (Eigen::VectorXd& e : errors) {
      std::sort(e.begin(), e.end());
      const auto at = [&](double p) { return e[static_cast<Eigen::Index>(std::lround(p * (seeds - 1)))]; };
      std::printf("  %.2e [%.2e %.2e]", at(0.5), at(0.25), at(0.75));
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 11;
  const std::string only = argc > 2 ? argv[2] : "";
  if (seeds < 1) {
    std::fprintf(stderr, "adaptive_sampling: SEEDS is %s; allowed is 1 or more\n", argv[1]);
    return 2;
  }
  for (const Case& c : cases())
    if (only.empty() || only == c.name) compare(c, seeds);
}
