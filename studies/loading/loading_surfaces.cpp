// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_noise.h>
#include <drawpoint/studies/loading/loading_surfaces.h>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/pareto/dominance.hpp>

#include <array>
#include <filesystem>
#include <limits>
#include <utility>

namespace drawpoint::studies {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int points_of_a_surface = 512;
constexpr int drawn_surfaces = 400;
constexpr Index fewest_runs = 10;
constexpr doe::Seed seed_of_draws = 1;
constexpr double least_agreement = 0.5;

/// The three responses; standard errors may come after them.
doe::Problem without_errors(doe::Problem problem) {
  problem.responses.resize(3);
  for (doe::Response& response : problem.responses) response.forget_standard_error();
  return problem;
}

MatrixXd below(const MatrixXd& upper, const MatrixXd& lower) {
  MatrixXd both(upper.rows() + lower.rows(), upper.cols());
  both.topRows(upper.rows()) = upper;
  both.bottomRows(lower.rows()) = lower;
  return both;
}

std::array<KnownNoise, 3> noise_of_runs(const StudyResults& results) {
  std::vector<std::filesystem::path> logs = results.logs;
  logs.resize(static_cast<std::size_t>(results.X.rows()));
  logs.insert(logs.end(), results.logs_new.begin(), results.logs_new.end());
  logs.resize(static_cast<std::size_t>(results.X.rows() + results.X_new.rows()));
  return noise_of_logs(logs, results.options);
}

/// The part of response r that the draws agree on, 0 to 1 (loading_surfaces.h).
double agreement(const std::vector<MatrixXd>& draws, Index r) {
  if (draws.empty()) return 0;
  VectorXd sum = VectorXd::Zero(draws.front().rows());
  for (const MatrixXd& means : draws)
    sum += (means.col(r).array() - means.col(r).mean()).matrix().normalized();
  return (sum / static_cast<double>(draws.size())).squaredNorm();
}

}  // namespace

LoadingSurface::LoadingSurface(const doe::Problem& problem, const MatrixXd& points, MatrixXd means)
    : problem_(&problem),
      points_(&points),
      means_(std::move(means)),
      front_(pareto::non_dominated(problem, means_)) {}

double LoadingSurface::level(Index r, Index v, double from, double to) const {
  double sum = 0, count = 0;
  for (Index i = 0; i < points_->rows(); ++i)
    if ((*points_)(i, v) >= from && (*points_)(i, v) < to) {
      sum += means_(i, r);
      ++count;
    }
  return (sum / count - means_.col(r).mean()) / deviation_of(y(r));
}

double LoadingSurface::explained(Index r, Index v) const {
  return explained_share(x(v), y(r), lower(v), upper(v));
}

double LoadingSurface::profile_range(Index r, Index v) const {
  const Eigen::Vector3d means = means_of_thirds(x(v), y(r), lower(v), upper(v));
  return (means.maxCoeff() - means.minCoeff()) / deviation_of(y(r));
}

LoadingSurfaces::LoadingSurfaces(doe::Problem problem, MatrixXd points, const std::vector<MatrixXd>& draws)
    : problem_(std::move(problem)), points_(std::move(points)) {
  for (const MatrixXd& means : draws) draws_.emplace_back(problem_, points_, means);
  for (std::size_t r = 0; r < 3; ++r) agreement_[r] = agreement(draws, static_cast<Index>(r));
}

LoadingSurfaces draw_surfaces(const StudyResults& results) {
  const doe::Problem problem = without_errors(results.problem);
  const MatrixXd points = doe::scrambled_sobol(problem, points_of_a_surface),
                 X = below(results.X, results.X_new), Y = below(results.Y, results.Y_new);
  if (X.rows() < fewest_runs) return {problem, points, {}};
  const std::array<KnownNoise, 3> noise = noise_of_runs(results);
  std::vector<MatrixXd> draws(drawn_surfaces, MatrixXd(points_of_a_surface, 3));
  for (std::size_t r = 0; r < 3; ++r) {
    const auto column = static_cast<Index>(r);
    const MatrixXd drawn = draw_means(problem, {X, Y.col(column), noise[r]}, points, drawn_surfaces,
                                      doe::run_seed(seed_of_draws, r, 0));
    for (std::size_t k = 0; k < draws.size(); ++k) draws[k].col(column) = drawn.col(static_cast<Index>(k));
  }
  return {problem, points, draws};
}

Criterion LoadingSurfaces::criterion(const std::string& name, const std::vector<Index>& responses,
                                     const Effect& effect, double least) const {
  if (draws_.empty()) return {name, {}, least};
  for (const Index r : responses)
    if (!(agreement_[static_cast<std::size_t>(r)] > least_agreement))
      return {name,
              {},
              least,
              "the runs do not show that " + problem_.responses[static_cast<std::size_t>(r)].name +
                  " depends on the variables"};
  std::vector<double> values;
  for (const LoadingSurface& surface : draws_) values.push_back(effect(surface));
  return {name, estimate_of(std::move(values)), least};
}

std::vector<Criterion> LoadingSurfaces::ridge(Index r, Index v, double from, double to) const {
  constexpr double end = std::numeric_limits<double>::infinity();
  const auto over = [=](double lower, double upper) {
    return [=](const LoadingSurface& s) { return s.level(r, v, from, to) - s.level(r, v, lower, upper); };
  };
  return {criterion("middle over lower, in standard deviations", {r}, over(-end, from), small_difference),
          criterion("middle over upper", {r}, over(to, end), small_difference)};
}

Criterion LoadingSurfaces::explains_more(Index r, Index more, Index less) const {
  const auto name = [&](Index v) { return problem_.variables[static_cast<std::size_t>(v)].name; };
  return criterion("share of variance of " + problem_.responses[static_cast<std::size_t>(r)].name + ", " +
                       name(more) + " less " + name(less),
                   {r}, [=](const LoadingSurface& s) { return s.explained(r, more) - s.explained(r, less); });
}

}  // namespace drawpoint::studies
