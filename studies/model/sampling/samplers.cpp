// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/sampling/samplers.h>
#include <drawpoint/doe/lola_voronoi.hpp>
#include <drawpoint/kriging/acquisition_gradient.hpp>
#include <drawpoint/kriging/acquisition_hypervolume.hpp>
#include <drawpoint/kriging/acquisition_joint.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace drawpoint::studies {
namespace {

/// The largest of several scores, each divided by its scale; a scale of 0 leaves its score out.
doe::Criterion largest_of(std::vector<std::pair<doe::Criterion, double>> scores) {
  return [scores = std::move(scores)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    Eigen::VectorXd largest = Eigen::VectorXd::Zero(X.rows());
    for (const auto& [score, scale] : scores) {
      if (scale > 0.0) largest = largest.cwiseMax(score(X) / scale);
    }
    return largest;
  };
}

double range_of(const Eigen::VectorXd& y) { return y.size() == 0 ? 0.0 : y.maxCoeff() - y.minCoeff(); }

/// Disagreement of the ways to fit a response on its model's scale, over its range: the largest over all responses.
doe::Criterion disagreement_of_ways(const doe::Evaluations& runs,
                                    const std::vector<kriging::TransformedModel>& models) {
  std::vector<std::pair<doe::Criterion, double>> scores;
  for (std::size_t j = 0; j < models.size(); ++j) {
    if (doe::is_standard_error(runs.problem, j)) continue;
    const doe::Response& response = runs.problem.responses[j];
    const Eigen::VectorXd y = runs.y(response.name);
    std::vector<doe::Criterion> means;
    const kriging::RunNoise noise = told_noise(runs, response);
    const kriging::Scale scale = models[j].transform().scale;
    for (const auto& way : ways_to_fit(runs, response, scale, first_source(noise)))
      means.push_back([model = way.fitter(runs.X(), y, noise.variance)](
                          const Eigen::MatrixXd& X) -> Eigen::VectorXd { return model.mean(X); });
    scores.emplace_back(doe::disagreement(std::move(means)), range_of(y));
  }
  return largest_of(std::move(scores));
}

doe::Criterion deviation_of(const doe::Evaluations& runs,
                            const std::vector<kriging::TransformedModel>& models) {
  std::vector<std::pair<doe::Criterion, double>> scores;
  for (std::size_t j = 0; j < models.size(); ++j) {
    if (doe::is_standard_error(runs.problem, j)) continue;
    scores.emplace_back(
        [model = models[j]](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
          return model.predict(X).variance.cwiseMax(0.0).cwiseSqrt();
        },
        range_of(runs.y(runs.problem.responses[j].name)));
  }
  return largest_of(std::move(scores));
}

/// |leave-one-out error| of the nearest run, on the scales of the models.
doe::Criterion error_of_the_nearest_run(const doe::Problem& problem,
                                        const std::vector<kriging::TransformedModel>& models) {
  std::vector<std::pair<doe::Criterion, double>> scores;
  for (std::size_t j = 0; j < models.size(); ++j)
    if (!doe::is_standard_error(problem, j))
      scores.emplace_back(kriging::cross_validation_error(models[j].model()),
                          range_of(models[j].model().state().observed));
  return largest_of(std::move(scores));
}

/// Index of the first response that is minimised or maximised.
std::size_t objective_of(const doe::Problem& problem) {
  const auto found = std::find_if(problem.responses.begin(), problem.responses.end(),
                                  [](const doe::Response& r) { return doe::is_objective(r.goal); });
  return static_cast<std::size_t>(found - problem.responses.begin());
}

/// By how much the mean at a point is better than the worst mean of the runs: 0 or more.
doe::Criterion predicted_gain(const kriging::Model& model, doe::Goal goal) {
  const double worst = (kriging::fitted_values(model) * doe::sign_of(goal)).maxCoeff();
  return [predicted = kriging::predicted_value(model, goal),
          worst](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    return (predicted(X).array() + worst).cwiseMax(0.0);
  };
}

doe::Sampler knowledge_gradient(const std::vector<kriging::TransformedModel>& models) {
  return [models](const doe::Evaluations& runs) {
    const std::size_t j = objective_of(runs.problem);
    return kriging::knowledge_gradient(models[j].model(), runs.problem.responses[j].goal);
  };
}

doe::Sampler predicted_within_limits(const std::vector<kriging::TransformedModel>& models) {
  return [models](const doe::Evaluations& runs) {
    const std::size_t j = objective_of(runs.problem);
    return kriging::product_of_criteria({predicted_gain(models[j].model(), runs.problem.responses[j].goal),
                                         kriging::probability_of_feasibility(runs.problem, models)});
  };
}

doe::Sampler sampler_named(const std::string& name, const std::vector<kriging::TransformedModel>& models,
                           doe::Seed seed) {
  if (name == "lola_voronoi") return doe::LolaVoronoi({.seed = seed});
  if (name == "voronoi") return doe::voronoi_sampler({.seed = seed});
  if (name == "distance") return doe::distance_to_runs;
  if (name == "error")
    return [models](const doe::Evaluations& runs) { return disagreement_of_ways(runs, models); };
  if (name == "cross_validation")
    return [models](const doe::Evaluations& runs) { return error_of_the_nearest_run(runs.problem, models); };
  if (name == "variance")
    return [models](const doe::Evaluations& runs) { return deviation_of(runs, models); };
  if (name == "feasibility")
    return [models](const doe::Evaluations& runs) {
      return kriging::probability_of_feasibility(runs.problem, models);
    };
  if (name == "knowledge_gradient") return knowledge_gradient(models);
  if (name == "predicted") return predicted_within_limits(models);
  return [models](const doe::Evaluations& runs) {
    return kriging::constrained_hypervolume_improvement(runs.problem, models);
  };
}

/// Scores, 0 or more, times the probability of success.
doe::Criterion where_runs_succeed(doe::Criterion criterion, const Failures& failures) {
  if (failures.none()) return criterion;
  return kriging::product_of_criteria({std::move(criterion), [failures](const Eigen::MatrixXd& X) {
                                         return failures.probability_of_success(X);
                                       }});
}

}  // namespace

doe::Mix mix_of(const std::vector<CriterionShare>& shares,
                const std::vector<kriging::TransformedModel>& models, const Failures& failures,
                doe::Seed seed) {
  std::vector<doe::Share> parts;
  for (const auto& share : shares)
    parts.push_back({share.weight, [sampler = sampler_named(share.name, models, seed),
                                    failures](const doe::Evaluations& runs) {
                       return where_runs_succeed(sampler(runs), failures);
                     }});
  return doe::Mix(std::move(parts));
}

doe::JointSampler joint_improvement_beside(const Eigen::MatrixXd& others,
                                           const std::vector<kriging::TransformedModel>& models,
                                           const Failures& failures) {
  return [others, models, failures](const doe::Evaluations& runs) -> doe::JointCriterion {
    const std::size_t j = objective_of(runs.problem);
    const doe::JointCriterion improvement =
        kriging::joint_improvement(models[j].model(), runs.problem.responses[j].goal, {.logarithm = false});
    return [others, improvement, failures](const Eigen::MatrixXd& chosen) {
      Eigen::MatrixXd before(others.rows() + chosen.rows(), others.cols());
      before << others, chosen;
      return where_runs_succeed(improvement(before), failures);
    };
  };
}

}  // namespace drawpoint::studies
