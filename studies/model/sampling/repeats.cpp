// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/run_quantile.h>
#include <drawpoint/studies/model/sampling/repeats.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/kriging/replicates.hpp>
#include <drawpoint/kriging/run_gain.hpp>

#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

// A mean over so many places is known to some 6 % of its scatter over the box, the same places for all points.
constexpr int places_of_mean = 256;
constexpr double least_noise = 1e-3;  // standard deviation over the range of a response: less limits nothing

/// Distinct, and where runs do not fail.
Eigen::MatrixXd repeatable_points(const doe::Evaluations& runs, const Failures& failures) {
  const Eigen::MatrixXd X = runs.X();
  const std::vector<bool> avoided = failures.avoided(X);
  std::vector<Eigen::Index> rows;
  for (const auto& group : kriging::detail::sites_of(X))
    if (!avoided[static_cast<std::size_t>(group.front())]) rows.push_back(group.front());
  return X(rows, Eigen::all);
}

/// Noise variance of one run of response j at each of the points, on the scale of its model.
Eigen::VectorXd noise_of_runs(const std::vector<kriging::TransformedModel>& models,
                              const doe::Problem& problem, std::size_t j, const Eigen::MatrixXd& points) {
  const kriging::Model& model = models[j].model();
  if (!noise_differs(models[j])) return Eigen::VectorXd::Constant(points.rows(), model.noise_variance());
  Eigen::VectorXd noise = noise_expected_at(models, problem, j, points);
  const Eigen::VectorXd z = model.mean(points);
  for (Eigen::Index i = 0; i < noise.size(); ++i)
    noise[i] = kriging::noise_on_scale(models[j].transform(), z[i], noise[i]);
  return noise;
}

double range_on_scale(const kriging::TransformedModel& model) {
  const Eigen::VectorXd& z = model.model().state().observed;
  return z.size() == 0 ? 0.0 : z.maxCoeff() - z.minCoeff();
}

}  // namespace

Eigen::MatrixXd points_to_repeat(const doe::Evaluations& runs,
                                 const std::vector<kriging::TransformedModel>& models,
                                 const Failures& failures, const RepeatSettings& settings) {
  const doe::Problem& problem = runs.problem;
  if (settings.count <= 0) return Eigen::MatrixXd(0, static_cast<Eigen::Index>(problem.variables.size()));
  const Eigen::MatrixXd made = repeatable_points(runs, failures);
  if (made.rows() == 0) return made;
  const Eigen::MatrixXd places = doe::uniform_random(problem, places_of_mean, {.seed = settings.seed});
  Eigen::MatrixXd points(made.rows() + places.rows(), made.cols());
  points << made, places;
  std::vector<kriging::ResponseGain> responses;
  for (std::size_t j = 0; j < models.size(); ++j) {
    const double range = range_on_scale(models[j]);
    if (!(range > 0) || doe::is_standard_error(problem, j)) continue;
    const Eigen::VectorXd noise = noise_of_runs(models, problem, j, points) / settings.replicates;
    if (noise.maxCoeff() < least_noise * least_noise * range * range) continue;
    responses.push_back({kriging::RunGain(models[j].model(), points, places, noise), range});
  }
  if (responses.empty()) return Eigen::MatrixXd(0, made.cols());
  return made(kriging::runs_to_repeat(std::move(responses), {.made = made.rows(), .count = settings.count}),
              Eigen::all);
}

}  // namespace drawpoint::studies
