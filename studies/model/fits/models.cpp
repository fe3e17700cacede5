// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/run_quantile.h>
#include <drawpoint/studies/model/fits/stated_interval.h>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/kriging/noise_model.hpp>
#include <drawpoint/kriging/replicates.hpp>

#include <cstdio>
#include <stdexcept>
#include <utility>

namespace drawpoint::studies {
namespace {

/// With noise that is estimated, or what the runs tell of theirs together.
kriging::FitOptions default_fit(const doe::Evaluations& runs, const kriging::RunNoise& noise = {}) {
  const doe::Problem& problem = runs.problem;
  kriging::FitOptions options;
  if (problem.deterministic) options.noise = kriging::Noise::none;
  options.may_be_exact =
      !doe::tells_noise(problem) && kriging::repeats_say(runs) != kriging::RepeatsSay::noisy;
  if (noise.noise == kriging::Noise::known) {
    options.noise = kriging::Noise::pooled;
    options.noise_variance = noise.variance;
  }
  options.threads = 0;
  options.lower = doe::lower_bounds(problem);
  options.upper = doe::upper_bounds(problem);
  options.levels = doe::level_counts(problem);
  return options;
}

std::string name_of(kriging::Scale scale) {
  switch (scale) {
    case kriging::Scale::linear:
      return "";
    case kriging::Scale::square_root:
      return ", of the square root";
    case kriging::Scale::logarithm:
      return ", of the logarithm";
    case kriging::Scale::logit:
      return ", of the logit";
  }
  return "";
}

kriging::ResponseRange range_of(const doe::Response& response) { return {response.lower, response.upper}; }

std::string name_of(kriging::NoiseSource noise) {
  switch (noise) {
    case kriging::NoiseSource::estimated:
      return "";
    case kriging::NoiseSource::pooled:
      return ", noise as the runs tell it together";
    case kriging::NoiseSource::told:
      return ", noise as each run tells it beside all";
    case kriging::NoiseSource::modelled:
      return ", noise as a model of what the runs tell";
  }
  return "";
}

StudyWay way_to_fit(const kriging::FitOptions& options, const doe::Response& response, kriging::Scale scale,
                    kriging::NoiseSource noise) {
  const std::string slope = options.trend == kriging::Trend::linear ? ", linear trend" : "";
  const std::string name =
      std::string(to_string(options.correlation)) + slope + name_of(scale) + name_of(noise);
  return {kriging::way_with_noise(name, scale, range_of(response), options, noise,
                                  response.standard_error_freedom),
          noise};
}

/// Of response j on runs that the models have not seen, by the noise that these tell, or are expected to
/// have, where the model was fitted with such noise.
kriging::Validation validation_of(const Models& fitted, const Tables& tables, std::size_t j) {
  const doe::Evaluations& runs = tables.validation;
  const doe::Response& response = runs.problem.responses[j];
  const Eigen::MatrixXd X = runs.X();
  const Eigen::VectorXd y = runs.y(response.name);
  switch (fitted.noise[j]) {
    case kriging::NoiseSource::estimated:
    case kriging::NoiseSource::pooled:
      return kriging::validate(fitted.models[j], X, y);
    case kriging::NoiseSource::told:
      return kriging::validate(
          fitted.models[j], X, y,
          kriging::expected_noise(kriging::NoiseSource::told, {}, response.standard_error_freedom)(
              tables.training.X(), tables.training.noise_variance(response.name), X,
              runs.noise_variance(response.name)));
    case kriging::NoiseSource::modelled:
      break;
  }
  return kriging::validate(fitted.models[j], X, y, noise_expected_at(fitted.models, runs.problem, j, X));
}

}  // namespace

kriging::RunNoise told_noise(const doe::Evaluations& runs, const doe::Response& response) {
  const Eigen::VectorXd variance = runs.noise_variance(response.name);
  if (variance.size() == 0 || !(variance.maxCoeff() > 0) || !(variance.maxCoeff() <= most_told_variance))
    return {};
  return {kriging::Noise::known, variance};
}

std::vector<StudyWay> ways_to_fit(const doe::Evaluations& runs, const doe::Response& response,
                                  kriging::Scale scale, kriging::NoiseSource source) {
  std::vector<StudyWay> ways;
  for (const kriging::FitOptions& options : kriging::usual_kinds(default_fit(runs)))
    ways.push_back(way_to_fit(options, response, scale, source));
  return ways;
}

kriging::NoiseSource first_source(const kriging::RunNoise& noise) {
  return noise.noise == kriging::Noise::known ? kriging::NoiseSource::pooled
                                              : kriging::NoiseSource::estimated;
}

namespace {

struct Fitted {
  StudyWay way;
  kriging::TransformedModel model;
};

/// Where noise that the runs tell may be taken from, the first to be kept without a reason. On a scale that is not
/// linear it has one size: what a run has in the mean is the median and the noise about it, and noise of another size
/// at every point would leave out what it adds where it is large beside the response. A run's own word counts where
/// the problem says of how many samples it is: of two or three cycles some runs seem quiet by chance, and a fit that
/// took their word would go through them. Where one tells 0 beside others that do not, such as rock that is lost now
/// and then, its samples are not those of a normal variable, and no number of them makes its word good.
std::vector<kriging::NoiseSource> sources_for(const kriging::RunNoise& noise, kriging::Scale scale,
                                              double freedom) {
  using kriging::NoiseSource;
  if (scale != kriging::Scale::linear) return {NoiseSource::pooled, NoiseSource::estimated};
  if (freedom == 0 || noise.variance.minCoeff() == 0)
    return {NoiseSource::pooled, NoiseSource::estimated, NoiseSource::modelled};
  return {NoiseSource::pooled, NoiseSource::estimated, NoiseSource::told, NoiseSource::modelled};
}

Fitted fit_response(const doe::Evaluations& runs, const doe::Response& response) {
  const Eigen::MatrixXd X = runs.X();
  const Eigen::VectorXd y = runs.y(response.name);
  const kriging::ResponseRange range = range_of(response);
  const kriging::RunNoise noise = told_noise(runs, response);
  const kriging::Scale scale = kriging::choose_scale(X, y, range, default_fit(runs, noise)).scale();
  const std::vector<StudyWay> kinds = ways_to_fit(runs, response, scale, first_source(noise));
  kriging::FitChoice kind = kriging::choose_fit(X, y, range, {kinds.begin(), kinds.end()}, noise);
  if (noise.noise != kriging::Noise::known) return {kinds[kind.best], std::move(kind.model)};
  std::vector<StudyWay> sources;
  for (const kriging::NoiseSource source : sources_for(noise, scale, response.standard_error_freedom))
    sources.push_back(ways_to_fit(runs, response, scale, source)[kind.best]);
  kriging::FitChoice choice = kriging::choose_refitted(X, y, range, {sources.begin(), sources.end()}, noise);
  return {sources[choice.best], std::move(choice.model)};
}

}  // namespace

Models fit_models(const Tables& tables) {
  const doe::Problem& problem = tables.training.problem;
  Models fitted;
  for (const auto& response : problem.responses) {
    Fitted best = fit_response(tables.training, response);
    fitted.ways.push_back(best.way.name);
    fitted.noise.push_back(best.way.noise_source);
    fitted.models.push_back(std::move(best.model));
  }
  if (tables.validation.X().rows() == 0) return fitted;
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    fitted.validations.push_back(validation_of(fitted, tables, j));
    fitted.mean_errors.push_back(mean_error_of(fitted.validations[j], fitted.models[j], tables.training,
                                               tables.validation, problem.responses[j]));
  }
  return fitted;
}

Models models_or_reason(const Tables& tables) {
  try {
    return fit_models(tables);
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error("studies: there are no models: " + std::string(e.what()) +
                             "; make more runs with the command run, or ask and tell");
  }
}

namespace {

std::string share_text(const kriging::Validation& v, const kriging::MeanError& error) {
  char text[96];
  if (error.noise > 0)
    std::snprintf(text, sizeof text, "%.3g of the mean (%.3g of runs)", error.nrmse(), v.nrmse);
  else
    std::snprintf(text, sizeof text, "%.3g", v.nrmse);
  return text;
}

}  // namespace

std::string nrmse_text(const Models& fitted, const doe::Problem& problem) {
  std::string text;
  for (std::size_t j = 0; j < fitted.validations.size(); ++j) {
    if (doe::is_standard_error(problem, j)) continue;
    text += (text.empty() ? "NRMSE " : ", ") + problem.responses[j].name + " " +
            share_text(fitted.validations[j], fitted.mean_errors[j]);
  }
  return text;
}

PlannedPoints with_predictions(const std::vector<kriging::TransformedModel>& models,
                               const doe::Problem& problem, const Eigen::MatrixXd& X) {
  const Eigen::MatrixXd none(X.rows(), static_cast<Eigen::Index>(models.size()));
  PlannedPoints points{X, none, none, none};
  for (std::size_t j = 0; j < models.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    const auto bounded = [&](double y) { return doe::within_range(problem.responses[j], y); };
    points.predicted.col(column) = models[j].mean(X).unaryExpr(bounded);
    points.lower.col(column) = run_quantile(models, problem, j, X, 0.5 - 0.5 * stated_level);
    points.upper.col(column) = run_quantile(models, problem, j, X, 0.5 + 0.5 * stated_level);
  }
  return points;
}

}  // namespace drawpoint::studies
