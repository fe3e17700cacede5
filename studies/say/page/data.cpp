// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/model/fits/run_noise.h>
#include <drawpoint/studies/model/fits/run_quantile.h>
#include <drawpoint/studies/model/fits/stated_interval.h>
#include <drawpoint/studies/model/fits/surface.h>
#include <drawpoint/studies/model/fits/surface_error.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/model/fronts/limits.h>
#include <drawpoint/studies/say/page/answer.h>
#include <drawpoint/studies/say/page/data.h>
#include <drawpoint/studies/say/page/panels.h>
#include <drawpoint/studies/say/page/report_summary.h>
#include <drawpoint/doe/problem_json.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace drawpoint::studies::detail {

namespace {

using nlohmann::json;

json to_json(const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

json to_json(const Eigen::MatrixXd& rows) {
  json all = json::array();
  for (Eigen::Index i = 0; i < rows.rows(); ++i) all.push_back(to_json(Eigen::VectorXd(rows.row(i))));
  return all;
}

json to_json(const HaulChoice& choice) {
  json strategies = json::array(), turns = json::array();
  for (const HauledStrategy& s : choice.strategies) {
    json runs = json::array();
    for (const WorkOfRun& run : s.runs)
      runs.push_back({{"run", run.run}, {"loads", run.loads}, {"seconds", run.seconds}});
    strategies.push_back({{"name", s.name},
                          {"x", std::vector<double>(s.x.begin(), s.x.end())},
                          {"load", s.load},
                          {"seconds", s.seconds},
                          {"runs", std::move(runs)}});
  }
  for (const HaulTurn& t : choice.turns)
    turns.push_back(
        {{"haul", t.haul}, {"better", t.better}, {"worse", t.worse}, {"lower", t.lower}, {"upper", t.upper}});
  return {{"response", choice.response}, {"haul", choice.haul},
          {"longest", choice.longest},   {"strategies", std::move(strategies)},
          {"turns", std::move(turns)},   {"deviation", choice.deviation},
          {"error", choice.error}};
}

/// Places of the responses whose limits a run breaks.
json broken_limits(const doe::Problem& problem, const doe::Outcome& outcome) {
  json broken = json::array();
  for (std::size_t j = 0; !outcome.failed() && j < problem.responses.size(); ++j)
    if (breaks_limit(problem.responses[j], outcome.values()[static_cast<Eigen::Index>(j)]))
      broken.push_back(j);
  return broken;
}

json to_json(const doe::Evaluations& table, const ReportInput& input) {
  json rows = json::array();
  for (const doe::Evaluation& e : table.rows) {
    const auto kind = input.kinds.find(e.run);
    json y = e.outcome.failed() ? json() : to_json(e.outcome.values());
    rows.push_back({{"run", e.run},
                    {"kind", kind == input.kinds.end() ? "" : kind->second},
                    {"x", to_json(e.x)},
                    {"y", std::move(y)},
                    {"breaks", broken_limits(input.problem, e.outcome)},
                    {"reason", e.outcome.reason()},
                    {"seconds", e.seconds}});
  }
  return {{"rows", std::move(rows)}};
}

json to_json(const Surface& s) {
  json terms = json::array();
  for (const kriging::TrendTerm& term : s.terms) terms.push_back({term.a, term.b});
  return {{"centre", to_json(s.centre)},
          {"factor", to_json(s.factor)},
          {"correlation", to_string(s.correlation.family)},
          {"theta", to_json(s.correlation.theta)},
          {"exponent", to_json(s.correlation.exponent)},
          {"levels", s.correlation.levels},
          {"X", to_json(s.X)},
          {"weights", to_json(s.weights)},
          {"terms", std::move(terms)},
          {"coefficients", to_json(s.coefficients)},
          {"constant", s.constant},
          {"scale", to_string(s.transform.scale)},
          {"lower", s.transform.lower},
          {"upper", s.transform.upper},
          {"offset", s.transform.offset},
          {"upper_offset", s.transform.upper_offset},
          {"noise", to_json(s.noise)},
          {"noise_weights", to_json(s.noise_weights)}};
}

json to_json(const SurfaceError& e) {
  return {{"noise", to_json(e.noise)},
          {"process_variance", e.process_variance},
          {"B", to_json(e.B)},
          {"T", to_json(e.T)},
          {"theta_spread", to_json(e.theta_spread)},
          {"exponent_spread", to_json(e.exponent_spread)},
          {"alpha_effects", to_json(e.alpha_effects)},
          {"beta_effects", to_json(e.beta_effects)}};
}

/// With what it knows of its error, and another explanation that this holds (kriging/model.hpp).
json formula_of(const kriging::TransformedModel& fitted, const std::optional<Surface>& s) {
  json formula;
  if (s) formula = to_json(*s);
  if (const auto error = surface_error(fitted); s && error) formula["error"] = to_json(*error);
  const kriging::Model& model = fitted.model();
  if (!s || model.doubt() == 0) return formula;
  const kriging::TransformedModel other(kriging::Model(*model.state().other), fitted.transform(),
                                        fitted.observed());
  formula["other"] = {{"probability", model.doubt()}, {"surface", formula_of(other, surface(other))}};
  return formula;
}

json to_json(const kriging::TransformedModel& fitted, const std::optional<Surface>& s) {
  const kriging::Model& model = fitted.model();
  return {{"scale", to_string(fitted.transform().scale)},
          {"theta", to_json(model.theta())},
          {"nugget", model.nugget()},
          {"process_variance", model.process_variance()},
          {"log_likelihood", model.log_likelihood()},
          {"message", model.message()},
          {"surface", formula_of(fitted, s)}};
}

json to_json(const kriging::Validation& v, const kriging::MeanError& error, const doe::Response& response) {
  if (v.observed.size() == 0) return json();
  json predicted = json::array(), lower = json::array(), upper = json::array();
  for (Eigen::Index i = 0; i < v.observed.size(); ++i) {
    const Interval interval = stated_interval(v, i, response);
    predicted.push_back(doe::within_range(response, v.predicted[i]));
    lower.push_back(interval.lower);
    upper.push_back(interval.upper);
  }
  json noise;
  if (error.noise > 0) noise = error.noise;
  return {{"rmse", v.rmse},
          {"noise", std::move(noise)},
          {"rmse_without_noise", {error.rmse, error.lower, error.upper}},
          {"nrmse", v.nrmse},
          {"mean_nrmse", {error.nrmse(), error.share(error.lower), error.share(error.upper)}},
          {"range", v.observed.maxCoeff() - v.observed.minCoeff()},
          {"observed", to_json(v.observed)},
          {"predicted", std::move(predicted)},
          {"lower", std::move(lower)},
          {"upper", std::move(upper)}};
}

json to_json(const std::vector<Finding>& findings) {
  json rows = json::array();
  for (const Finding& f : findings) rows.push_back({f.id, f.claim, to_string(f.verdict), f.grounds});
  return rows;
}

json to_json(const CheckedRuns& checked) {
  json rows = json::array();
  for (const CheckedRun& c : checked.runs)
    rows.push_back({{"run", c.run},
                    {"x", to_json(c.x)},
                    {"y", c.outcome.failed() ? json() : to_json(c.outcome.values())},
                    {"reason", c.outcome.reason()},
                    {"predicted", to_json(c.predicted)},
                    {"lower", to_json(c.lower)},
                    {"upper", to_json(c.upper)},
                    {"within", c.within},
                    {"round", c.round},
                    {"named", c.named},
                    {"breaks_limit", c.breaks_limit},
                    {"dominated", c.dominated}});
  return {{"rows", std::move(rows)},
          {"text", text(checked)},
          {"agree", checked.runs.empty() || checked.last_round().agree()}};
}

/// A residual is null where it is unknown.
json to_json(const pareto::Polishing& polishing, const std::string& not_polished) {
  return {{"residual", to_json(polishing.residual)},
          {"certified", polishing.certified()},
          {"tolerance", pareto::certified_residual},
          {"gain", polishing.gain},
          {"skipped", not_polished}};
}

/// One end of the 95 % interval of one run at each point of the front, one column per objective; no rows
/// without models.
Eigen::MatrixXd ends_of_intervals(const ReportInput& input, double probability) {
  const auto chosen = objectives(input.problem);
  if (input.models.empty() || input.front.X.rows() == 0) return {};
  Eigen::MatrixXd all(input.front.X.rows(), static_cast<Eigen::Index>(chosen.size()));
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    all.col(static_cast<Eigen::Index>(k)) =
        run_quantile(input.models, input.problem, chosen[k], input.front.X, probability);
  }
  return all;
}

/// What is infinite becomes null.
json to_json(const std::vector<PairBand>& bands) {
  json all = json::array();
  for (const PairBand& band : bands)
    all.push_back({{"first", band.first},
                   {"second", band.second},
                   {"at", to_json(band.at)},
                   {"optimistic", to_json(band.optimistic)},
                   {"median", to_json(band.median)},
                   {"pessimistic", to_json(band.pessimistic)}});
  return all;
}

json front_json(const ReportInput& input) {
  const pareto::Front& front = input.front;
  return {{"objectives", objectives(input.problem)},
          {"lower", to_json(ends_of_intervals(input, 0.5 - 0.5 * stated_level))},
          {"upper", to_json(ends_of_intervals(input, 0.5 + 0.5 * stated_level))},
          {"X", to_json(front.X)},
          {"Y", to_json(front.Y)},
          {"success", to_json(input.success)},
          {"non_dominated", to_json(input.uncertainty.non_dominated)},
          {"bands", to_json(input.uncertainty.bands)},
          {"balanced", balanced_point(input.problem, front)},
          {"evaluations", front.evaluations}};
}

/// The two variables with the largest total effect on any response, in the problem's order; twice the only
/// one.
json main_pair(const doe::Problem& problem, const std::vector<FlatResponse>& flat,
               const std::vector<Eigen::VectorXd>& influence) {
  const std::size_t variables = problem.variables.size();
  std::vector<std::size_t> order(variables);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto weight = [&](std::size_t k) {
    double most = 0.0;
    for (std::size_t j = 0; j < influence.size(); ++j)
      if (!doe::is_standard_error(problem, j) && !is_flat(flat, j))
        most = std::max(most, influence[j][static_cast<Eigen::Index>(k)]);
    return most;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return weight(a) > weight(b); });
  const std::size_t a = order.front(), b = order[std::min<std::size_t>(1, variables - 1)];
  return {std::min(a, b), std::max(a, b)};
}

[[noreturn]] void reject(const std::string& what) {
  throw std::invalid_argument("studies::write_report: " + what);
}

void check_tables(const ReportInput& input) {
  for (const auto* table : {&input.training, &input.validation})
    for (const doe::Evaluation& e : table->rows) {
      const std::string run = "run " + std::to_string(e.run);
      if (e.x.size() != static_cast<Eigen::Index>(input.problem.variables.size()))
        reject(run + " has " + std::to_string(e.x.size()) + " inputs; give one per variable");
      if (!e.outcome.failed() &&
          e.outcome.values().size() != static_cast<Eigen::Index>(input.problem.responses.size()))
        reject(run + " has " + std::to_string(e.outcome.values().size()) + " values; give one per response");
    }
}

void check_results(const ReportInput& input) {
  const std::size_t responses = input.problem.responses.size();
  if (!input.models.empty() && input.models.size() != responses)
    reject(std::to_string(input.models.size()) + " models for " + std::to_string(responses) +
           " responses; give one each or none");
  if (!input.validations.empty() && input.validations.size() != input.models.size())
    reject(std::to_string(input.validations.size()) + " validations for " +
           std::to_string(input.models.size()) + " models; give one each or none");
  for (const kriging::Validation& v : input.validations)
    if (v.predicted.size() != v.observed.size() || v.observation_variance.size() != v.observed.size())
      reject(
          "a validation has unequal numbers of observed, predicted and variance; give what validate "
          "returned");
  const pareto::Front& f = input.front;
  const bool empty = f.X.rows() == 0 && f.Y.rows() == 0;
  if (!empty && (f.X.rows() != f.Y.rows() ||
                 f.Y.cols() != static_cast<Eigen::Index>(objectives(input.problem).size()) ||
                 f.X.cols() != static_cast<Eigen::Index>(input.problem.variables.size())))
    reject("the front does not belong to the problem; give what the search on this problem returned");
  if (input.success.size() != 0 && input.success.size() != f.X.rows())
    reject(std::to_string(input.success.size()) + " probabilities of success for " +
           std::to_string(f.X.rows()) + " points of the front; give one each or none");
  const Eigen::Index known = input.uncertainty.non_dominated.size();
  if (known != 0 && known != f.X.rows())
    reject(std::to_string(known) + " probabilities of being non-dominated for " + std::to_string(f.X.rows()) +
           " points of the front; give one each or none");
  const Eigen::Index residuals = input.polishing.residual.size();
  if (residuals != 0 && residuals != f.X.rows())
    reject(std::to_string(residuals) + " residuals for " + std::to_string(f.X.rows()) +
           " points of the front; give one each or none");
}

std::vector<kriging::MeanError> mean_errors_of(const ReportInput& input) {
  std::vector<kriging::MeanError> errors;
  for (std::size_t j = 0; j < input.validations.size(); ++j)
    errors.push_back(mean_error_of(input.validations[j], input.models[j], input.training, input.validation,
                                   input.problem.responses[j]));
  return errors;
}

json marks_json(const std::vector<Mark>& marks) {
  json all = json::array();
  for (const Mark& mark : marks) all.push_back({{"name", mark.name}, {"x", to_json(mark.x)}});
  return all;
}

/// Per response null, or what is said of one that is flat.
json flat_json(const ReportInput& input) {
  json all = json::array();
  for (std::size_t j = 0; j < input.problem.responses.size(); ++j) all.push_back(json());
  for (const FlatResponse& flat : input.flat) all[flat.response] = flat_text(flat, input.problem);
  return all;
}

}  // namespace

json described(const doe::Problem& problem) {
  json all = to_json(problem);
  for (std::size_t i = 0; i < problem.variables.size(); ++i)
    all["variables"][i]["description"] = problem.variables[i].description;
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    all["responses"][j]["description"] = problem.responses[j].description;
    if (doe::is_standard_error(problem, j)) all["responses"][j]["is_error"] = true;
  }
  return all;
}

json report_data(const ReportInput& input) {
  doe::check(input.problem);
  check_marks(input.problem, input.marks);
  check_tables(input);
  check_results(input);
  ReportInput known = input;
  known.training.problem = known.validation.problem = input.problem;
  if (known.mean_errors.size() != known.validations.size()) known.mean_errors = mean_errors_of(known);
  json models = json::array(), validations = json::array(), shares = json::array();
  const std::vector<Eigen::VectorXd> effects = influence(input.models, input.problem);
  for (std::size_t j = 0; j < input.models.size(); ++j) {
    const kriging::TransformedModel& model = input.models[j];
    const auto formula = surface(model);
    const bool own = !doe::is_standard_error(input.problem, j);
    if (!formula && own)
      known.warnings.push_back(
          "The response surface of " + pretty(input.problem.responses[j].name) +
          " is not drawn: its model has a trend or a correlation that this page does not know.");
    models.push_back(to_json(model, formula));
    validations.push_back(j < known.validations.size() ? to_json(known.validations[j], known.mean_errors[j],
                                                                 input.problem.responses[j])
                                                       : json());
    shares.push_back(own && !is_flat(input.flat, j) ? to_json(effects[j]) : json());
  }
  json panels = without_repeated(checked_panels(input.illustrations, known.warnings));
  json contrasts = checked_panels(input.contrasts, known.warnings);
  return {{"study", input.study},
          {"about", input.about},
          {"command", input.command},
          {"confirming", input.confirming},
          {"problem", described(as_asked(input.problem, input.flat))},
          {"training", to_json(input.training, input)},
          {"validation", to_json(input.validation, input)},
          {"models", std::move(models)},
          {"validations", std::move(validations)},
          {"front", front_json(input)},
          {"no_front", input.no_front},
          {"flat", flat_json(input)},
          {"confirmations", to_json(input.confirmations)},
          {"polishing", to_json(input.polishing, input.not_polished)},
          {"influence", std::move(shares)},
          {"main_pair", main_pair(input.problem, input.flat, effects)},
          {"findings", to_json(input.findings)},
          {"illustrations", std::move(panels)},
          {"contrasts", std::move(contrasts)},
          {"facts", input.facts},
          {"shown", input.shown},
          {"marks", marks_json(input.marks)},
          {"answer", answer_json(known)},
          {"hauls", input.hauls ? to_json(*input.hauls) : json()},
          {"summary", summary(known, effects)}};
}

}  // namespace drawpoint::studies::detail
