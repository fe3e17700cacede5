// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/run_quantile.h>
#include <drawpoint/studies/model/fits/suspects.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/outliers.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace drawpoint::studies {
namespace {

std::string sentence(const kriging::Outlier& outlier, const doe::Response& response, std::int64_t run) {
  const std::string unit = response.unit.empty() || response.unit == "1" ? "" : " " + response.unit;
  const auto bounded = [&](double y) { return doe::within_range(response, y); };
  char text[256];
  std::snprintf(text, sizeof text,
                "Run %lld has a %s of %.3g%s where the other runs put %.3g%s (95 of 100 runs: %.3g to %.3g)",
                static_cast<long long>(run), response.name.c_str(), outlier.observed, unit.c_str(),
                bounded(outlier.expected), unit.c_str(), bounded(outlier.lower), bounded(outlier.upper));
  return std::string(text) +
         ", and the model predicts them worse with it. Look at its log, and make it again "
         "with evaluate --run " +
         std::to_string(run) + ": a fault of the simulator, or a place where the response jumps.";
}

/// A sentence for each response with a standard error above what is allowed, which names the run with the largest.
std::vector<std::string> absurd_errors(const Tables& tables) {
  const std::vector<std::int64_t> runs = runs_with_values(tables.training);
  std::vector<std::string> sentences;
  for (const doe::Response& response : tables.training.problem.responses) {
    const Eigen::VectorXd variance = tables.training.noise_variance(response.name);
    Eigen::Index largest = 0;
    if (variance.size() == 0 || variance.maxCoeff(&largest) <= most_told_variance) continue;
    const std::string run = std::to_string(runs[static_cast<std::size_t>(largest)]);
    sentences.push_back("Run " + run + " tells " + response.standard_error + " as " +
                        doe::detail::with_unit(std::sqrt(variance[largest]), response.unit) +
                        "; allowed is 1e75 at most. What the runs tell of the noise of " + response.name +
                        " is left out; make the run again with evaluate --run " + run + ".");
  }
  return sentences;
}

}  // namespace

std::vector<std::string> suspects(const Models& fitted, const Tables& tables) {
  const doe::Problem& problem = tables.training.problem;
  const Eigen::MatrixXd X = tables.training.X();
  const std::vector<std::int64_t> runs = runs_with_values(tables.training);
  std::vector<std::string> sentences = absurd_errors(tables);
  for (std::size_t j = 0; j < fitted.models.size(); ++j) {
    if (doe::is_standard_error(problem, j)) continue;
    const doe::Response& response = problem.responses[j];
    const kriging::TransformedModel& model = fitted.models[j];
    const kriging::RunNoise noise = told_noise(tables.training, response);
    const auto ways = ways_to_fit(tables.training, response, model.transform().scale, fitted.noise[j]);
    const auto way =
        std::find_if(ways.begin(), ways.end(), [&](const StudyWay& w) { return w.name == fitted.ways[j]; });
    if (way == ways.end()) continue;
    kriging::OutlierOptions options;
    if (knows_noise(model)) options.noise_variance = noise.variance;
    options.noise = way->noise;
    for (const kriging::Outlier& outlier :
         kriging::find_outliers(model, X, tables.training.y(response.name), way->fitter, options))
      sentences.push_back(sentence(outlier, response, runs[static_cast<std::size_t>(outlier.run)]));
  }
  return sentences;
}

}  // namespace drawpoint::studies
