// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// What polishing adds to a front that a search found on Kriging surrogates, and how sure that front is.
///
/// Four variables in the ranges of the study lhd_loading and three responses that behave as the loading study
/// found (findings F1 to F9 of Lindmark (2016): production has its optimum near alpha = 1.1, damage a ridge near 1 and
/// at kappa = 0.4, spill grows with alpha and beta), as smooth formulas. 120 runs of an optimised design, exact and
/// with noise of 5 % of each range; then fit, NSGA-II 250 x 100, polish in both forms, certify by the residual of the
/// first-order conditions. Gains are measured on the surrogate, the function that is searched. Times are CPU seconds of
/// the process, hypervolumes in ranges: reference (0 kg/s, 40 s, 0.4).

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/sample_paths.hpp>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/pareto/filter.hpp>
#include <drawpoint/pareto/knees.hpp>
#include <drawpoint/pareto/local_trade_off.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/pareto/polish.hpp>
#include <drawpoint/pareto/sharpening.hpp>
#include <drawpoint/pareto/vorobev.hpp>

namespace {

using namespace drawpoint;

const doe::Problem problem{.variables = {{"alpha", "1", 0.2, 2.0},
                                         {"beta", "1", 0.0, 1.0},
                                         {"gamma", "1", 0.0, 1.0},
                                         {"kappa", "1", 0.0, 1.0}},
                           .responses = {{"production", "kg/s", doe::Goal::maximize},
                                         {"joint_damage", "s", doe::Goal::minimize},
                                         {"rock_spill", "1", doe::Goal::minimize}}};
const Eigen::Vector3d reference(0.0, 40.0, 0.4), ranges(500.0, 35.0, 0.25);

Eigen::Vector3d loading(const Eigen::VectorXd& x) {
  const double alpha = x[0], beta = x[1], gamma = x[2], kappa = x[3];
  const double fill = std::exp(-std::pow((alpha - 1.1 - 0.1 * beta) / 0.5, 2));
  const double load = std::exp(-std::pow((alpha - 1.0) / 0.6, 2));
  return {50.0 + 400.0 * fill * (0.75 + 0.25 * beta) * (1.0 + 0.06 * gamma * beta) * (1.0 - 0.12 * kappa),
          2.0 + 30.0 * load * (0.25 + 0.75 * beta * beta) * (1.0 - 1.5 * std::pow(kappa - 0.4, 2)) +
              std::sin(std::numbers::pi * gamma),
          0.08 + 0.14 * std::tanh(alpha) * (0.5 + 0.5 * beta) * (1.0 - 0.6 * kappa) + 0.03 * alpha * beta};
}

double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Call>
auto timed(double& seconds, const Call& call) {
  const double start = cpu_seconds();
  auto result = call();
  seconds = cpu_seconds() - start;
  return result;
}

std::vector<kriging::Model> fitted(double noise) {
  const Eigen::MatrixXd X = doe::optimized_latin_hypercube(problem, 120);
  doe::RandomStream random(120);
  Eigen::MatrixXd Y(X.rows(), 3);
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    Y.row(i) = loading(X.row(i).transpose()).transpose();
    for (Eigen::Index j = 0; j < 3; ++j) Y(i, j) += noise * ranges[j] * random.normal();
  }
  std::vector<kriging::Model> models;
  for (Eigen::Index j = 0; j < 3; ++j) models.push_back(kriging::fit(X, Y.col(j)));
  return models;
}

/// Joint paths of the models, independent between the responses.
struct Paths {
  const std::vector<kriging::Model>& models;

  pareto::Draws operator()(const Eigen::MatrixXd& X, const pareto::DrawOptions& options) const {
    std::vector<Eigen::MatrixXd> paths;
    for (std::size_t j = 0; j < models.size(); ++j)
      paths.push_back(
          kriging::sample_paths(models[j], X, options.draws, {.seed = doe::run_seed(options.seed, j, 0)}));
    return pareto::draws_of_paths(paths);
  }
};

double volume_in_ranges(const Eigen::MatrixXd& Y) {
  return pareto::hypervolume(problem, Y * ranges.cwiseInverse().asDiagonal(),
                             reference.cwiseQuotient(ranges));
}

double median(Eigen::VectorXd values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

pareto::Front search(const std::vector<kriging::Model>& models, int generations, int population,
                     doe::Seed seed, double& seconds) {
  return timed(seconds, [&] {
    return pareto::nsga2(
        kriging::Surrogates(models), problem,
        {.search = {.population = population, .stopping = {.generations = generations}, .seed = seed}});
  });
}

void polish_row(const std::vector<kriging::Model>& models, const pareto::Front& front, const char* name,
                pareto::ScalarForm form) {
  double seconds = 0.0;
  const kriging::Surrogates f(models);
  const pareto::Polished p = timed(
      seconds, [&] { return pareto::polish(f, problem, front, {.form = form, .reference = reference}); });
  const double before = volume_in_ranges(front.Y), after = volume_in_ranges(p.front.Y);
  const auto certified = (p.residual.array() <= 1e-6).count();
  const auto count = [&](pareto::PolishedPoint s) { return std::count(p.points.begin(), p.points.end(), s); };
  std::printf(
      "  %-18s hypervolume %.6f -> %.6f (+%.3f %%), median residual %.1e -> %.1e, %ld of %ld below 1e-6, "
      "%ld improved, %ld unchanged, %ld failed; %d evaluations, %.2f s CPU\n",
      name, before, after, 100.0 * (after / before - 1.0), median(p.residual_before), median(p.residual),
      static_cast<long>(certified), static_cast<long>(front.X.rows()),
      static_cast<long>(count(pareto::PolishedPoint::improved)),
      static_cast<long>(count(pareto::PolishedPoint::unchanged)),
      static_cast<long>(count(pareto::PolishedPoint::failed)), p.evaluations, seconds);
}

void longer_searches(const std::vector<kriging::Model>& models, doe::Seed seed) {
  for (const auto& [generations, population] : {std::pair{1000, 100}, {4000, 100}}) {
    double seconds = 0.0;
    const pareto::Front front = search(models, generations, population, seed, seconds);
    std::printf("  nsga2 %4d x %d    hypervolume %.6f, %.2f s CPU\n", generations, population,
                volume_in_ranges(front.Y), seconds);
  }
}

void answers(const std::vector<kriging::Model>& models, const pareto::Front& front) {
  const pareto::Choice choice =
      pareto::best(problem, front, "production", {pareto::at_most("joint_damage", 12.0)});
  const pareto::LocalTradeOff local =
      pareto::local_trade_off(kriging::Surrogates(models), problem, front, choice.row);
  std::printf(
      "  best production with damage at most 12 s: %.1f kg/s; there 1 s of damage buys %.2f kg/s, 0.01 of "
      "spill %.2f kg/s (residual %.1e); %zu knee(s)\n",
      choice.value, local.rates(0, 1), 0.01 * local.rates(0, 2), local.residual,
      pareto::knees(problem, front).rows.size());
}

void certainty(const std::vector<kriging::Model>& models, const pareto::Front& front) {
  double drawing = 0.0, measuring = 0.0;
  const pareto::Draws draws =
      timed(drawing, [&] { return pareto::draws_at(Paths{models}, front.X, {.draws = 1024}); });
  const pareto::Vorobev v =
      timed(measuring, [&] { return pareto::vorobev(problem, draws, {.reference = reference}); });
  const pareto::NextSimulations next = pareto::next_simulations(problem, draws, 4);
  std::printf(
      "  probability of being on the front: median %.2f, least %.2f; Vorob'ev deviation %.2f %% of the "
      "volume; paths %.2f s, deviation %.2f s CPU; next runs at rows",
      median(next.probability), next.probability.minCoeff(), 100.0 * v.deviation / v.expected_volume, drawing,
      measuring);
  for (const int row : next.rows) std::printf(" %d", row);
  std::printf("\n");
}

}  // namespace

int main() {
  for (const double noise : {0.0, 0.05}) {
    double fitting = 0.0;
    const std::vector<kriging::Model> models = timed(fitting, [&] { return fitted(noise); });
    std::printf("Noise %.0f %%, 120 runs: three fits %.2f s CPU\n", 100.0 * noise, fitting);
    for (doe::Seed seed = 1; seed <= 3; ++seed) {
      double seconds = 0.0;
      const pareto::Front front = search(models, 250, 100, seed, seconds);
      std::printf(" seed %d: nsga2 250 x 100, %.2f s CPU\n", static_cast<int>(seed), seconds);
      polish_row(models, front, "chebyshev", pareto::ScalarForm::chebyshev);
      polish_row(models, front, "epsilon_constraint", pareto::ScalarForm::epsilon_constraint);
      if (seed > 1) continue;
      longer_searches(models, seed);
      const pareto::Polished polished =
          pareto::polish(kriging::Surrogates(models), problem, front, {.reference = reference});
      answers(models, polished.front);
      certainty(models, polished.front);
    }
  }
}
