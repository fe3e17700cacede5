// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/mean_paths.h>
#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/same_place.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/model/hauls.h>
#include <drawpoint/studies/model/recommendation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace drawpoint::studies {
namespace {

constexpr int draws = 2000;
constexpr std::size_t fewest_runs = 10;  // that models of loads and times want

doe::Problem problem_of_cycles(const ModelledStudy& study) {
  return {.variables = study.problem.variables,
          .responses = {{.name = "load", .unit = "1", .goal = doe::Goal::record, .lower = 0},
                        {.name = "seconds", .unit = "s", .goal = doe::Goal::record, .lower = 0}}};
}

doe::Evaluations cycles_of(const ModelledStudy& study, const doe::Evaluations& of,
                           const std::vector<WorkOfRun>& work) {
  doe::Evaluations table{.problem = problem_of_cycles(study), .rows = {}};
  std::set<std::int64_t> runs;
  for (const doe::Evaluation& e : of.rows)
    if (!e.outcome.failed()) runs.insert(e.run);
  for (const WorkOfRun& w : work)
    if (runs.contains(w.run))
      table.rows.push_back(
          {.run = w.run, .x = w.x, .outcome = doe::Outcome{w.mean_load(), w.mean_seconds()}});
  return table;
}

/// Models of load and seconds.
struct CycleModels {
  doe::Problem problem;
  std::vector<kriging::TransformedModel> of;

  double mean(std::size_t j, const Eigen::VectorXd& x) const {
    return doe::within_range(problem.responses[j], of[j].mean(x.transpose())[0]);
  }
};

/// The row of X where the models load most.
Eigen::VectorXd fullest_place(const ModelledStudy& study, const CycleModels& models) {
  Eigen::MatrixXd X = study.front.X;
  for (const doe::Evaluation& e : study.training.rows) {
    X.conservativeResize(X.rows() + 1, study.front.X.cols());
    X.bottomRows(1) = e.x.transpose();
  }
  Eigen::Index row = 0;
  models.of[0].mean(X).maxCoeff(&row);
  return X.row(row);
}

std::vector<Mark> places_of(const ModelledStudy& study, std::size_t response, const CycleModels& models) {
  std::vector<Mark> places;
  const auto add = [&](const std::string& name, const Eigen::VectorXd& x) {
    for (const Mark& other : places)
      if (is_same_place(study.problem, other.x, x)) return;
    places.push_back({name, x});
  };
  if (study.recommended) add("recommended", study.recommended->x);
  const auto objectives = detail::objectives(study.problem);
  const auto found = std::find(objectives.begin(), objectives.end(), response);
  if (found != objectives.end()) {
    Eigen::Index row = 0;
    study.front.Y.col(found - objectives.begin()).maxCoeff(&row);
    add("highest " + detail::pretty(study.problem.responses[response].name), study.front.X.row(row));
  }
  add("largest load", fullest_place(study, models));
  const Reference reference = reference_of(study.problem, study.marks);
  add(reference.name, reference.x);
  for (const Mark& mark : study.marks) add(mark.name, mark.x);
  return places;
}

std::vector<HauledStrategy> strategies_of(const ModelledStudy& study, std::size_t response,
                                          const CycleModels& models, const std::vector<WorkOfRun>& work) {
  std::vector<HauledStrategy> all;
  for (const Mark& place : places_of(study, response, models)) {
    HauledStrategy s{place.name, place.x, models.mean(0, place.x), models.mean(1, place.x)};
    for (const WorkOfRun& w : work)
      if (is_same_place(study.problem, w.x, place.x)) s.runs.push_back(w);
    all.push_back(std::move(s));
  }
  return all;
}

/// Load and seconds of the strategies, one draw per column.
struct Drawn {
  Eigen::MatrixXd load, seconds;
};

/// A draw's turn: infinity where `better` never is, 0 where it always is.
double drawn_turn(const Drawn& drawn, std::size_t better, std::size_t worse, Eigen::Index draw,
                  double longest) {
  const auto a = static_cast<Eigen::Index>(better), b = static_cast<Eigen::Index>(worse);
  const double load_a = drawn.load(a, draw), load_b = drawn.load(b, draw), seconds_a = drawn.seconds(a, draw),
               seconds_b = drawn.seconds(b, draw);
  const double turn = turning_haul(load_a, seconds_a, load_b, seconds_b, longest);
  const double end = std::isfinite(turn) ? 0.5 * (turn + longest) : longest;
  const bool ends_better = load_a / (seconds_a + end) > load_b / (seconds_b + end);
  if (!ends_better) return std::numeric_limits<double>::infinity();
  return std::isfinite(turn) ? turn : 0.0;
}

std::vector<HaulTurn> turns_of(const HaulChoice& choice, const std::optional<Drawn>& drawn) {
  std::vector<HaulTurn> turns;
  const auto& s = choice.strategies;
  for (std::size_t a = 0; a < s.size(); ++a)
    for (std::size_t b = a + 1; b < s.size(); ++b) {
      const double haul = turning_haul(s[a].load, s[a].seconds, s[b].load, s[b].seconds, choice.longest);
      if (!std::isfinite(haul)) continue;
      HaulTurn turn{haul, s[a].load > s[b].load ? a : b, s[a].load > s[b].load ? b : a};
      if (drawn) {
        std::vector<double> hauls;
        for (Eigen::Index k = 0; k < drawn->load.cols(); ++k)
          hauls.push_back(drawn_turn(*drawn, turn.better, turn.worse, k, choice.longest));
        const Ends ends = ends_of(std::move(hauls));
        turn.lower = ends.lower;
        turn.upper = ends.upper;
      }
      turns.push_back(turn);
    }
  std::sort(turns.begin(), turns.end(), [](const HaulTurn& a, const HaulTurn& b) { return a.haul < b.haul; });
  return turns;
}

std::optional<Drawn> drawn_of(const HaulChoice& choice, const CycleModels& models) {
  Eigen::MatrixXd X(static_cast<Eigen::Index>(choice.strategies.size()), choice.strategies.front().x.size());
  for (std::size_t k = 0; k < choice.strategies.size(); ++k)
    X.row(static_cast<Eigen::Index>(k)) = choice.strategies[k].x.transpose();
  if (!knows_error(models.of[0], X) || !knows_error(models.of[1], X)) return {};
  return Drawn{drawn_means(models.of[0], models.problem.responses[0], X, draws),
               drawn_means(models.of[1], models.problem.responses[1], X, draws)};
}

double largest_deviation(const std::vector<WorkOfRun>& work, double longest) {
  double most = 0;
  for (const WorkOfRun& w : work)
    for (const double haul : {0.0, 0.1 * longest, longest}) {
      const double rate = w.rate(haul), of_means = w.mean_load() / (w.mean_seconds() + haul);
      if (rate > 0) most = std::max(most, std::abs(of_means / rate - 1));
    }
  return most;
}

double error_on(const doe::Evaluations& validation, const CycleModels& models,
                const std::vector<WorkOfRun>& work, double haul) {
  double squares = 0, sum = 0;
  int runs = 0;
  for (const doe::Evaluation& e : validation.rows) {
    const auto w =
        std::find_if(work.begin(), work.end(), [&](const WorkOfRun& of) { return of.run == e.run; });
    const double rate = w->rate(haul), predicted = models.mean(0, e.x) / (models.mean(1, e.x) + haul);
    squares += (predicted - rate) * (predicted - rate);
    sum += rate;
    ++runs;
  }
  return runs == 0 ? std::nan("") : std::sqrt(squares / runs) / (sum / runs);
}

}  // namespace

std::optional<HaulChoice> choice_of_haul(const ModelledStudy& study, const std::string& rate, double haul,
                                         const std::vector<WorkOfRun>& work) {
  const int response = doe::response_index(study.problem, rate);
  if (response < 0 || study.front.X.rows() == 0) return {};
  const Tables tables{.training = cycles_of(study, study.training, work),
                      .validation = cycles_of(study, study.validation, work)};
  if (tables.training.rows.size() < fewest_runs) return {};
  CycleModels models{.problem = tables.training.problem, .of = {}};
  try {
    models.of = fit_models({.training = tables.training, .validation = {.problem = models.problem}}).models;
  } catch (const std::invalid_argument&) {  // the responses have models, these runs without some logs do not
    return {};
  }
  HaulChoice choice{.response = static_cast<std::size_t>(response), .haul = haul};
  choice.strategies = strategies_of(study, choice.response, models, work);
  choice.turns = turns_of(choice, drawn_of(choice, models));
  choice.deviation = largest_deviation(work, choice.longest);
  choice.error = error_on(tables.validation, models, work, haul);
  return choice;
}

}  // namespace drawpoint::studies
