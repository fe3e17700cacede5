// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/models/front.h>
#include <drawpoint/studies/models/models.h>
#include <drawpoint/studies/runs/settings.h>
#include <drawpoint/studies/sampling/criteria.h>
#include <drawpoint/doe/lola_voronoi.hpp>
#include <drawpoint/kriging/acquisition_hypervolume.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace drawpoint::studies {
namespace {

constexpr const char* repeat = "repeat";
constexpr std::array<const char*, 7> criterion_names = {"lola_voronoi", "voronoi",     "distance", "error",
                                                        "variance",     "improvement", repeat};

[[noreturn]] void refuse_criterion(const std::string& part) {
  std::string names;
  for (const char* name : criterion_names) names += (names.empty() ? "" : ", ") + std::string(name);
  throw UsageError(
      "\"" + part +
      "\" is no criterion and weight; give NAME=WEIGHT with commas between, weights above 0, of " + names);
}

CriterionShare share_from(const std::string& part) {
  const auto sign = part.find('=');
  const std::string name = part.substr(0, sign);
  if (std::find(criterion_names.begin(), criterion_names.end(), name) == criterion_names.end())
    refuse_criterion(part);
  if (sign == std::string::npos) return {name, 1.0};
  const std::string number = part.substr(sign + 1);
  char* end = nullptr;
  const double weight = std::strtod(number.c_str(), &end);
  if (number.empty() || *end != '\0' || !std::isfinite(weight) || weight <= 0.0) refuse_criterion(part);
  return {name, weight};
}

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

/// Of the ways to fit each response on the scale of its model.
doe::Criterion disagreement_of_ways(const doe::Evaluations& runs,
                                    const std::vector<kriging::TransformedModel>& models) {
  std::vector<std::pair<doe::Criterion, double>> scores;
  for (std::size_t j = 0; j < models.size(); ++j) {
    const doe::Response& response = runs.problem.responses[j];
    const Eigen::VectorXd y = runs.y(response.name);
    std::vector<doe::Criterion> means;
    for (const auto& way : ways_to_fit(runs.problem, response, models[j].transform().scale)) {
      means.push_back([model = way.fitter(runs.X(), y)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
        return model.mean(X);
      });
    }
    scores.emplace_back(doe::disagreement(std::move(means)), range_of(y));
  }
  return largest_of(std::move(scores));
}

doe::Criterion deviation_of(const doe::Evaluations& runs,
                            const std::vector<kriging::TransformedModel>& models) {
  std::vector<std::pair<doe::Criterion, double>> scores;
  for (std::size_t j = 0; j < models.size(); ++j) {
    scores.emplace_back(
        [model = models[j]](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
          return model.predict(X).variance.cwiseMax(0.0).cwiseSqrt();
        },
        range_of(runs.y(runs.problem.responses[j].name)));
  }
  return largest_of(std::move(scores));
}

doe::Sampler sampler_named(const std::string& name, const std::vector<kriging::TransformedModel>& models,
                           doe::Seed seed) {
  if (name == "lola_voronoi") return doe::LolaVoronoi({.seed = seed});
  if (name == "voronoi") return doe::voronoi_sampler({.seed = seed});
  if (name == "distance") return doe::distance_to_runs;
  if (name == "error")
    return [models](const doe::Evaluations& runs) { return disagreement_of_ways(runs, models); };
  if (name == "variance")
    return [models](const doe::Evaluations& runs) { return deviation_of(runs, models); };
  return [models](const doe::Evaluations& runs) {
    return kriging::constrained_hypervolume_improvement(runs.problem, models);
  };
}

/// Scores times the probability of success; scores of every sampler here are 0 or more.
doe::Sampler where_runs_succeed(doe::Sampler sampler, const Failures& failures) {
  if (failures.none()) return sampler;
  return [sampler = std::move(sampler), failures](const doe::Evaluations& runs) {
    return kriging::product_of_criteria(
        {sampler(runs), [failures](const Eigen::MatrixXd& X) { return failures.probability_of_success(X); }});
  };
}

}  // namespace

std::vector<CriterionShare> criteria_from(const std::string& text) {
  std::vector<CriterionShare> shares;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) shares.push_back(share_from(part));
  if (shares.empty() || text.back() == ',') refuse_criterion(text);
  return shares;
}

CriteriaTurns turns_of(const std::vector<CriterionShare>& shares, int made, int count) {
  CriteriaTurns turns;
  std::vector<double> weights = {0.0, 0.0};  // of repeats, of new points
  for (const CriterionShare& share : shares) {
    weights[share.name == repeat ? 0 : 1] += share.weight;
    if (share.name != repeat) turns.new_ones.push_back(share);
  }
  turns.may_repeat = weights.front() > 0.0;
  turns.repeats = doe::turns_by_weight(weights, made, count).front();
  return turns;
}

void check_criteria(const std::string& text, const doe::Problem& problem) {
  if (has_objective(problem)) return;
  for (const auto& share : criteria_from(text)) {
    if (share.name == "improvement")
      throw UsageError(
          "--criteria: improvement needs a response that is minimized or maximized; take another criterion");
  }
}

doe::Mix mix_of(const std::vector<CriterionShare>& shares,
                const std::vector<kriging::TransformedModel>& models, const Failures& failures,
                doe::Seed seed) {
  std::vector<doe::Share> parts;
  for (const auto& share : shares)
    parts.push_back({share.weight, where_runs_succeed(sampler_named(share.name, models, seed), failures)});
  return doe::Mix(std::move(parts));
}

}  // namespace drawpoint::studies
