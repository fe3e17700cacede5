// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/mean_paths.h>
#include <drawpoint/studies/model/fronts/front_uncertainty.h>
#include <drawpoint/kriging/error_correlation.hpp>
#include <drawpoint/kriging/sample_paths.hpp>
#include <drawpoint/pareto/attainment.hpp>
#include <drawpoint/pareto/non_domination.hpp>

#include <algorithm>
#include <utility>

namespace drawpoint::studies {
namespace {

constexpr int draws_of_a_front = 1024;
constexpr int places_of_a_band = 61;
constexpr double confidence_of_a_band = 0.9;

bool counts_on_front(const doe::Response& response) {
  return doe::is_objective(response.goal) || doe::is_constraint(response.goal);
}

/// Sampled paths of each response's mean at the front's points, n x draws, in order; 0 for those that do not count.
std::vector<Eigen::MatrixXd> paths_of_responses(const pareto::Front& front,
                                                const std::vector<kriging::TransformedModel>& models,
                                                const doe::Problem& problem, doe::Seed seed) {
  std::vector<kriging::Validation> left_out;
  for (std::size_t j = 0; j < models.size(); ++j)
    if (counts_on_front(problem.responses[j])) left_out.push_back(leave_one_out(models[j]));
  const std::vector<Eigen::MatrixXd> normals = kriging::correlated_normals(
      kriging::error_correlation(left_out), front.X.rows(), draws_of_a_front, seed);
  std::vector<Eigen::MatrixXd> paths;
  std::size_t next = 0;
  for (std::size_t j = 0; j < models.size(); ++j)
    paths.push_back(counts_on_front(problem.responses[j])
                        ? means_of(models[j], problem.responses[j],
                                   kriging::sample_paths(models[j].model(), front.X, normals[next++]))
                        : Eigen::MatrixXd::Zero(front.X.rows(), draws_of_a_front));
  return paths;
}

/// The problem with these two objectives alone; limits stay.
doe::Problem with_pair(doe::Problem problem, std::size_t a, std::size_t b) {
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    doe::Goal& goal = problem.responses[j].goal;
    if (doe::is_objective(goal) && j != a && j != b) goal = doe::Goal::record;
  }
  return problem;
}

PairBand band_of_pair(const pareto::Front& front, const doe::Problem& problem, const pareto::Draws& draws,
                      std::pair<std::size_t, std::size_t> columns) {
  std::vector<std::size_t> objectives;
  for (std::size_t j = 0; j < problem.responses.size(); ++j)
    if (doe::is_objective(problem.responses[j].goal)) objectives.push_back(j);
  const auto [a, b] = columns;
  const auto y = front.Y.col(static_cast<Eigen::Index>(a));
  PairBand band{.first = a, .second = b};
  band.at = Eigen::VectorXd::LinSpaced(places_of_a_band, y.minCoeff(), y.maxCoeff());
  Eigen::MatrixXd at = Eigen::MatrixXd::Zero(places_of_a_band, 2);
  at.col(0) = band.at;
  const pareto::FrontBand found =
      pareto::front_band(with_pair(problem, objectives[a], objectives[b]), draws, at, confidence_of_a_band);
  band.optimistic = found.optimistic.col(1);
  band.median = found.median.col(1);
  band.pessimistic = found.pessimistic.col(1);
  return band;
}

bool variances_are_known(const std::vector<kriging::TransformedModel>& models, const Eigen::MatrixXd& X) {
  return std::all_of(models.begin(), models.end(), [&](const kriging::TransformedModel& model) {
    return knows_error(model, X.topRows(1));
  });
}

}  // namespace

FrontUncertainty uncertainty_of(const pareto::Front& front,
                                const std::vector<kriging::TransformedModel>& models,
                                const doe::Problem& problem, doe::Seed seed) {
  if (front.X.rows() == 0 || models.empty() || !variances_are_known(models, front.X)) return {};
  const pareto::Draws draws = pareto::draws_of_paths(paths_of_responses(front, models, problem, seed));
  FrontUncertainty result{.non_dominated = pareto::probability_non_dominated(problem, draws).probability};
  const auto columns = static_cast<std::size_t>(front.Y.cols());
  for (std::size_t a = 0; a < columns; ++a)
    for (std::size_t b = a + 1; b < columns; ++b)
      result.bands.push_back(band_of_pair(front, problem, draws, {a, b}));
  return result;
}

}  // namespace drawpoint::studies
