// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// scale_choice: is the right scale chosen for a response with bounds, and what does it bring? See the help
/// text.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <drawpoint/doe/detail/enumerators.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace drawpoint;
using namespace drawpoint::kriging;

constexpr const char* help =
    R"(Fits responses with bounds, in 4 variables, on every scale that their range allows, and asks 400 new runs
which one was best.

  scale_choice
  scale_choice --runs 200 --seeds 11

One row per response and number of runs: how often each scale was chosen over the designs (optimised Latin
hypercubes), then of the ranked probability score on new runs, predictions kept within the range, the geometric
mean over the designs of: chosen over linear, the largest of these, and best over linear, which no rule beats.
Last the per cent of new runs within 95 % intervals, linear and chosen.

With w = 1.5 sin 3a + 1.2 b - c^2 + ab, a to d the variables, and e normal noise, the responses are what their
names say.)";

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Case {
  std::string name;
  ResponseRange range;
  std::function<double(double w, double e)> response;
};

std::vector<Case> cases() {
  const ResponseRange positive{0, infinity}, share{0, 1};
  return {{"exp(w + 0.4 e)", positive, [](double w, double e) { return std::exp(w + 0.4 * e); }},
          {"exp(0.3 w + 0.4 e)", positive, [](double w, double e) { return std::exp(0.3 * w + 0.4 * e); }},
          {"exp(e)", positive, [](double, double e) { return std::exp(e); }},
          {"exp(w)", positive, [](double w, double) { return std::exp(w); }},
          {"(1 + w)^2", positive, [](double w, double) { return (1 + w) * (1 + w); }},
          {"3 + w", positive, [](double w, double) { return 3 + w; }},
          {"10 + w + 0.4 e", positive, [](double w, double e) { return 10 + w + 0.4 * e; }},
          {"max(1.5 + w + 0.4 e, 0)", positive,
           [](double w, double e) { return std::max(1.5 + w + 0.4 * e, 0.0); }},
          {"max(w - 0.8 + 0.5 e, 0)", positive,
           [](double w, double e) { return std::max(w - 0.8 + 0.5 * e, 0.0); }},
          {"max(0.2 w + e, 0)^2 / 50", positive,
           [](double w, double e) { return std::pow(std::max(0.2 * w + e, 0.0), 2) / 50; }},
          {"logistic(2 w - 2 + 0.5 e)", share,
           [](double w, double e) { return 1 / (1 + std::exp(-(2 * w - 2 + 0.5 * e))); }}};
}

struct Runs {
  Eigen::MatrixXd X;
  Eigen::VectorXd y;
};

Runs observed(const Case& c, Eigen::MatrixXd X, doe::Seed seed) {
  doe::RandomStream random(seed);
  Runs runs{std::move(X), {}};
  runs.y.resize(runs.X.rows());
  for (Eigen::Index i = 0; i < runs.y.size(); ++i) {
    const Eigen::VectorXd x = runs.X.row(i);
    const double w = 1.5 * std::sin(3 * x[0]) + 1.2 * x[1] - x[2] * x[2] + x[0] * x[1];
    runs.y[i] = c.response(w, random.normal());
  }
  return runs;
}

doe::Problem problem() {
  doe::Problem p{.variables = {}, .responses = {{"y", "1", doe::Goal::minimize}}};
  for (const char* name : {"a", "b", "c", "d"}) p.variables.push_back({name, "1", 0.0, 1.0});
  return p;
}

Eigen::MatrixXd anywhere(Eigen::Index points, doe::Seed seed) {
  doe::RandomStream random(seed);
  Eigen::MatrixXd X(points, 4);
  for (double& x : X.reshaped()) x = random.uniform();
  return X;
}

/// Predictions kept within the range: what a model gives to those who know the bounds.
double ranked_score(const Validation& v, const ResponseRange& range) {
  constexpr int levels = 200;
  double sum = 0;
  for (int k = 0; k < levels; ++k) {
    const double level = (k + 0.5) / levels;
    for (Eigen::Index i = 0; i < v.observed.size(); ++i) {
      const double q = std::clamp(predicted_quantile(v, i, level), range.lower, range.upper);
      sum += ((v.observed[i] < q ? 1.0 : 0.0) - level) * (q - v.observed[i]);
    }
  }
  return 2 * sum / levels / static_cast<double>(v.observed.size());
}

void measure(const Case& c, int runs, int seeds) {
  std::map<Scale, int> chosen;
  double gain = 0, worst = 0, best = 0, linear_within = 0, within = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto s = static_cast<doe::Seed>(seed);
    const Runs known = observed(c, doe::optimized_latin_hypercube(problem(), runs, {.seed = s}), 1000 + s);
    const Runs fresh = observed(c, anywhere(400, 2000 + s), 3000 + s);
    const FitChoice choice = choose_scale(known.X, known.y, c.range);
    ++chosen[choice.scale()];
    std::vector<double> score;
    for (const FitStanding& standing : choice.table) {
      const Scale scale = *doe::detail::enumerator_of<Scale>(standing.name);
      const auto model = fit_transformed(known.X, known.y, scale, c.range);
      const Validation v = validate(model, fresh.X, fresh.y);
      score.push_back(ranked_score(v, c.range));
      const double held = kriging::score(v, ErrorFunction::coverage) / seeds;
      if (score.size() == 1) linear_within += held;
      if (score.size() == choice.best + 1) within += held;
    }
    const double ratio = score[choice.best] / score[0];
    gain += std::log(ratio) / seeds;
    worst = std::max(worst, ratio);
    best += std::log(*std::min_element(score.begin(), score.end()) / score[0]) / seeds;
  }
  std::printf("| %-25s | %4d | %2d %2d %2d %2d | %.3f | %.2f | %.3f | %.0f, %.0f |\n", c.name.c_str(), runs,
              chosen[Scale::linear], chosen[Scale::square_root], chosen[Scale::logarithm],
              chosen[Scale::logit], std::exp(gain), worst, std::exp(best), 100 * linear_within, 100 * within);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> runs{40, 100};
  int seeds = 20;
  CLI::App app(help);
  app.add_option("--runs", runs, "of a design, with commas between")
      ->delimiter(',')
      ->check(CLI::Range(10, 2000))
      ->capture_default_str();
  app.add_option("--seeds", seeds, "designs of each kind")->check(CLI::Range(1, 1000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    std::printf(
        "| response | runs | linear, square root, logarithm, logit | chosen | worst | best | within |\n");
    for (const Case& c : cases())
      for (const int n : runs) measure(c, n, seeds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
