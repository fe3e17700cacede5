// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// hypervolume_table [SEEDS [CASE]]: how much of a known front few runs find, by expected hypervolume
/// improvement, one run or four at a time, and by a maximin Latin hypercube of as many runs; without noise and
/// with noise of 5 and 20 % of each response's standard deviation over the box, with limits and without.
///
/// The front is what a user would take: that of the last models' means by SMS-EMOA, simulated without noise;
/// beside it the runs that were made, simulated without noise. Both as shares of the exact front's
/// hypervolume, of the points that keep every limit to a hundredth of that response's standard deviation: on a
/// limit half of all predictions would else be refused for their last digit. So a share may exceed 1, and one
/// of a hundred points cannot reach it otherwise. Worst, quartiles and median over the seeds, 11 unless told.
/// Fits by default, but from 4 starts and 64 candidates.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <drawpoint/benchmarks/toolkit/cpu_time.hpp>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/acquisition_hypervolume.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/sms_emoa.hpp>
#include <drawpoint/tests/pareto/known_fronts.hpp>
#include <exception>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace drawpoint;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using support::KnownFront;

struct Case {
  KnownFront known;
  int first, runs;
};

std::vector<Case> cases() {
  using namespace support;
  return {{two_objectives("ZDT1", zdt1, unit_problem(4, 2), on_zdt1), 20, 60},
          {two_objectives("ZDT3", zdt3, unit_problem(4, 2), on_zdt3), 20, 60},
          {{"DTLZ2", dtlz2, unit_problem(4, 3), Eigen::Vector3d::Constant(1.1),
            1.1 * 1.1 * 1.1 - std::numbers::pi / 6.0},
           20,
           60},
          {two_objectives("BNH", bnh, bnh_problem(), on_bnh), 10, 40},
          {two_objectives("OSY", osy, osy_problem(), on_osy), 30, 90}};
}

/// Standard deviation of each response over the box.
VectorXd deviations(const KnownFront& known) {
  const MatrixXd X = doe::latin_hypercube(known.problem, 4096);
  MatrixXd Y(X.rows(), static_cast<Eigen::Index>(known.problem.responses.size()));
  for (Eigen::Index i = 0; i < X.rows(); ++i) Y.row(i) = known.f(X.row(i).transpose()).values().transpose();
  const MatrixXd off = Y.rowwise() - Y.colwise().mean();
  return (off.colwise().squaredNorm() / static_cast<double>(X.rows() - 1)).cwiseSqrt().transpose();
}

/// Of the points X, simulated without noise.
double share_of(const KnownFront& known, const VectorXd& deviation, const MatrixXd& X) {
  const Eigen::Index m = known.reference.size();
  std::vector<Eigen::RowVectorXd> kept;
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    const VectorXd y = known.f(X.row(i).transpose()).values();
    const Eigen::Index limits = y.size() - m;
    if ((y.tail(limits).array() <= 0.01 * deviation.tail(limits).array()).all())
      kept.emplace_back(y.head(m).transpose());
  }
  MatrixXd Y(static_cast<Eigen::Index>(kept.size()), m);
  for (std::size_t i = 0; i < kept.size(); ++i) Y.row(static_cast<Eigen::Index>(i)) = kept[i];
  return pareto::hypervolume(Y, known.reference) / known.volume;
}

std::vector<kriging::Model> models_of(const doe::Evaluations& runs) {
  kriging::FitOptions options;
  options.starts = 4;
  options.candidates = 64;
  std::vector<kriging::Model> models;
  for (const doe::Response& r : runs.problem.responses)
    models.push_back(kriging::fit(runs.X(), runs.y(r.name), options));
  return models;
}

struct Shares {
  double expected, runs;
};

/// batch: runs at a time after the first design; 0: all of them planned at once.
Shares shares_of(const Case& c, const VectorXd& deviation, double noise, int batch, doe::Seed seed) {
  const doe::Problem& problem = c.known.problem;
  const auto simulate = [&](const VectorXd& x, doe::Seed draw) -> doe::Outcome {
    VectorXd y = c.known.f(x).values();
    doe::RandomStream random(draw);
    for (Eigen::Index j = 0; j < y.size(); ++j) y[j] += noise * deviation[j] * random.normal();
    return y;
  };
  const auto next = [&](const doe::Evaluations& runs) {
    return kriging::constrained_hypervolume_improvement(problem, models_of(runs));
  };
  doe::RefineOptions options;
  options.max_points = c.runs;
  options.propose.batch = std::max(batch, 1);
  options.propose.seed = seed;
  options.evaluate.seed = seed;
  const int first = batch == 0 ? c.runs : c.first;
  const doe::Evaluations runs =
      doe::refine(simulate, problem, doe::optimized_latin_hypercube(problem, first, {.seed = seed}), next,
                  options)
          .runs;
  const pareto::Front front = pareto::sms_emoa(
      kriging::Surrogates(models_of(runs)), problem,
      {.search = {.population = 100, .stopping = {.generations = 150}, .seed = seed}, .children = 100});
  return {share_of(c.known, deviation, front.X), share_of(c.known, deviation, runs.X())};
}

/// All of them, or the one of this name.
std::vector<Case> chosen(const std::string& name) {
  std::vector<Case> all = cases();
  if (name.empty()) return all;
  std::string names;
  for (const Case& c : all) {
    if (c.known.name == name) return {c};
    names += (names.empty() ? "" : ", ") + c.known.name;
  }
  throw std::invalid_argument("CASE is \"" + name + "\"; choose one of " + names);
}

void row(const Case& c, const VectorXd& deviation, double noise, int batch, int seeds) {
  const double begin = benchmarks::cpu_seconds();
  std::vector<double> expected, runs;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Shares shares = shares_of(c, deviation, noise, batch, static_cast<doe::Seed>(seed));
    expected.push_back(shares.expected);
    runs.push_back(shares.runs);
  }
  std::sort(expected.begin(), expected.end());
  std::sort(runs.begin(), runs.end());
  const std::size_t n = expected.size();
  const double seconds = (benchmarks::cpu_seconds() - begin) / seeds;
  const std::string way = batch == 0 ? "planned at once" : "improvement, " + std::to_string(batch);
  std::printf("| %s | %d, %d | %.0f %% | %s | %.3f | %.3f | %.3f | %.3f | %.3f | %.1f |\n",
              c.known.name.c_str(), c.first, c.runs, 100 * noise, way.c_str(), expected[0], expected[n / 4],
              expected[n / 2], expected[3 * n / 4], runs[n / 2], seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 11;
    if (seeds < 1) throw std::invalid_argument("SEEDS is below 1; give a whole number such as 11");
    const std::vector<Case> wanted = chosen(argc > 2 ? argv[2] : "");
    std::puts(
        "| front | first, all runs | noise | the others | worst | quarter | median | three q. | of the runs "
        "| CPU s |");
    std::puts("|---|---|---|---|---|---|---|---|---|---|");
    for (const Case& c : wanted) {
      const VectorXd deviation = deviations(c.known);
      for (const double noise : {0.0, 0.05, 0.2})
        for (const int batch : {0, 4, 1}) row(c, deviation, noise, batch, seeds);
    }
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "hypervolume_table: %s\n", e.what());
    return 1;
  }
}
