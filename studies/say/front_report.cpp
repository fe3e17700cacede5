// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/same_place.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/decision_points.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/run/store/joined.h>
#include <drawpoint/studies/say/front_report.h>
#include <drawpoint/studies/say/number_or_null.h>
#include <drawpoint/studies/say/page/cautions.h>
#include <drawpoint/studies/say/study_summary.h>
#include <drawpoint/studies/say/text_table.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

using Cells = std::vector<std::string>;

/// All that is said of a front, row by row.
struct FrontView {
  explicit FrontView(const ReportInput& in)
      : input(in),
        points(with_predictions(in.models, in.problem, in.front.X)),
        decision(decision_points(in.front, in.problem)),
        recommended(in.recommended ? in.recommended->row : -1) {}

  Eigen::VectorXd place(int row) const { return input.front.X.row(row).transpose(); }

  const ReportInput& input;
  PlannedPoints points;
  DecisionPoints decision;
  int recommended;  ///< -1: none, or a place that was simulated
};

std::vector<int> rows_shown(const FrontView& view, int most) {
  return points_to_confirm(view.input.front, view.input.problem, view.input.front.X.topRows(0), most,
                           view.recommended);
}

std::vector<int> every_row(const ReportInput& input) {
  std::vector<int> rows(static_cast<std::size_t>(input.front.X.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// (row, what it is), the most important first.
std::vector<std::pair<int, std::string>> marks_of(const FrontView& view) {
  std::vector<std::pair<int, std::string>> marks;
  if (view.recommended >= 0) marks.emplace_back(view.recommended, "recommended");
  const auto objectives = detail::objectives(view.input.problem);
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    const doe::Response& response = view.input.problem.responses[objectives[k]];
    const char* best = response.goal == doe::Goal::maximize ? "highest " : "lowest ";
    marks.emplace_back(view.decision.best[k], best + response.name);
  }
  marks.emplace_back(view.decision.balanced, "balanced choice");
  for (const int row : view.decision.knees) marks.emplace_back(row, "knee");
  return marks;
}

/// The row that stands for a row: itself, or the first one shown in its place; -1: none.
int shown_for(const FrontView& view, int row, const std::vector<int>& shown) {
  if (std::find(shown.begin(), shown.end(), row) != shown.end()) return row;
  for (const int other : shown) {
    if (is_same_place(view.input.problem, view.place(row), view.place(other))) return other;
  }
  return -1;
}

std::string marks_text(const FrontView& view, int row, const std::vector<int>& shown) {
  Cells told;
  for (const auto& [marked, mark] : marks_of(view)) {
    if (shown_for(view, marked, shown) != row) continue;
    if (std::find(told.begin(), told.end(), mark) == told.end()) told.push_back(mark);
  }
  return joined(told);
}

/// Simulations in the place of a row.
std::vector<const CheckedRun*> simulations_at(const FrontView& view, int row) {
  std::vector<const CheckedRun*> there;
  for (const CheckedRun& run : view.input.confirmations.runs) {
    if (is_same_place(view.input.problem, run.x, view.place(row))) there.push_back(&run);
  }
  return there;
}

bool is_told(const doe::Response& response) { return response.goal != doe::Goal::record; }

Cells front_heads(const ReportInput& input) {
  const doe::Problem& problem = input.problem;
  Cells heads = {"point"};
  for (const auto& variable : problem.variables)
    heads.push_back(detail::labelled(variable.name, variable.unit));
  for (const auto& response : problem.responses) {
    if (is_told(response)) heads.push_back(detail::labelled(response.name, response.unit));
  }
  if (input.uncertainty.non_dominated.size() > 0) heads.push_back("non-dominated");
  if (input.success.size() > 0) heads.push_back("a run succeeds");
  heads.push_back("what it is");
  return heads;
}

Cells predicted_cells(const FrontView& view, int row, const std::vector<int>& shown) {
  const doe::Problem& problem = view.input.problem;
  Cells cells = {std::to_string(row + 1)};
  for (std::size_t k = 0; k < problem.variables.size(); ++k)
    cells.push_back(
        detail::setting(problem.variables[k], view.input.front.X(row, static_cast<Eigen::Index>(k))));
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    if (!is_told(problem.responses[j])) continue;
    cells.push_back(detail::number(view.points.predicted(row, column)) + " (" +
                    detail::number(view.points.lower(row, column)) + " to " +
                    detail::number(view.points.upper(row, column)) + ")");
  }
  const Eigen::VectorXd& non_dominated = view.input.uncertainty.non_dominated;
  if (non_dominated.size() > 0) cells.push_back(detail::percent(non_dominated[row]));
  if (view.input.success.size() > 0) cells.push_back(detail::percent(view.input.success[row]));
  cells.push_back(marks_text(view, row, shown));
  return cells;
}

std::string simulation_note(const CheckedRun& run) {
  std::string note = "simulated";
  if (run.breaks_limit) note += ", breaks a limit";
  if (run.dominated) note += ", dominated by an earlier run";
  return run.outcome.failed() ? "failed: " + run.outcome.reason() : note;
}

/// What was simulated there, under what is predicted.
Cells simulated_cells(const FrontView& view, const CheckedRun& run) {
  const doe::Problem& problem = view.input.problem;
  Cells cells = {" run " + std::to_string(run.run)};
  for (std::size_t k = 0; k < problem.variables.size(); ++k)
    cells.push_back(detail::setting(problem.variables[k], run.x[static_cast<Eigen::Index>(k)]));
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    if (!is_told(problem.responses[j])) continue;
    const bool failed = run.outcome.failed();
    cells.push_back(failed ? ""
                           : detail::number(run.outcome.values()[static_cast<Eigen::Index>(j)]) +
                                 (run.within[j] ? "" : " outside"));
  }
  if (view.input.uncertainty.non_dominated.size() > 0) cells.emplace_back();
  if (view.input.success.size() > 0) cells.emplace_back();
  cells.push_back(simulation_note(run));
  return cells;
}

/// Which of the points shown have been simulated.
std::string places_text(const FrontView& view, const std::vector<int>& shown) {
  if (view.input.confirmations.runs.empty()) return "";
  const bool any =
      std::any_of(shown.begin(), shown.end(), [&](int row) { return !simulations_at(view, row).empty(); });
  return any ? "Under a point: its simulation, within 2 % of each range; outside: of what was predicted "
               "before it.\n"
             : "No point shown has been simulated: the models know more now, and their front has moved.\n";
}

/// Where a simulated place is recommended, which is no point of the table.
std::string recommended_text(const FrontView& view) {
  if (!view.input.recommended || view.input.recommended->row >= 0) return "";
  const Recommendation& found = *view.input.recommended;
  std::string text = "Recommended is a simulated place: " + detail::point_text(view.input.problem, found.x);
  if (!found.simulated.empty()) text += ", run " + std::to_string(found.simulated.front().run);
  return text + ".\n";
}

std::string non_dominated_text(const ReportInput& input) {
  if (input.uncertainty.non_dominated.size() == 0) return "";
  return "Non-dominated: how likely the mean of many runs there keeps every limit while no other\n"
         "point of the front is at least as good in all objectives and better in one, as sure as the "
         "models are.\n";
}

std::string confirmation_text(const ReportInput& input) {
  const CheckedRuns& checked = input.confirmations;
  if (checked.runs.empty())
    return "Confirmed by simulation: nothing yet; the command " + input.confirming +
           " has the points that matter simulated.\n";
  const bool agree = checked.last_round().agree();
  return "Confirmed by simulation: " + text(checked) + "; the last round " +
         (agree ? "agrees with its predictions.\n" : "does not agree with its predictions.\n");
}

nlohmann::ordered_json predicted_json(const FrontView& view, int row) {
  nlohmann::ordered_json predicted = nlohmann::ordered_json::object();
  for (std::size_t j = 0; j < view.input.problem.responses.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    predicted[view.input.problem.responses[j].name] = {
        {"mean", number_or_null(view.points.predicted(row, column))},
        {"lower", number_or_null(view.points.lower(row, column))},
        {"upper", number_or_null(view.points.upper(row, column))}};
  }
  return predicted;
}

/// Null where it is unknown.
nlohmann::ordered_json non_dominated_json(const ReportInput& input, int row) {
  const Eigen::VectorXd& known = input.uncertainty.non_dominated;
  return known.size() > 0 ? nlohmann::ordered_json(known[row]) : nlohmann::ordered_json();
}

bool holds(const std::vector<int>& rows, int row) {
  return std::find(rows.begin(), rows.end(), row) != rows.end();
}

nlohmann::ordered_json point_json(const FrontView& view, int row, const std::vector<int>& shown) {
  const doe::Problem& problem = view.input.problem;
  nlohmann::ordered_json x = nlohmann::ordered_json::object(), best = nlohmann::ordered_json::array(),
                         runs = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < problem.variables.size(); ++k)
    x[problem.variables[k].name] = view.input.front.X(row, static_cast<Eigen::Index>(k));
  const auto objectives = detail::objectives(problem);
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    if (view.decision.best[k] == row) best.push_back(problem.responses[objectives[k]].name);
  }
  for (const CheckedRun* run : simulations_at(view, row)) runs.push_back(run->run);
  return {{"point", row + 1},
          {"x", std::move(x)},
          {"predicted", predicted_json(view, row)},
          {"non_dominated", non_dominated_json(view.input, row)},
          {"success", view.input.success.size() > 0 ? view.input.success[row] : 1.0},
          {"best", std::move(best)},
          {"balanced", view.decision.balanced == row},
          {"knee", holds(view.decision.knees, row)},
          {"chosen", holds(shown, row)},
          {"simulated", std::move(runs)}};
}

}  // namespace

std::string front_points_text(const ReportInput& input, int most, bool every_point) {
  const FrontView view(input);
  const std::vector<int> shown = every_point ? every_row(input) : rows_shown(view, most);
  std::vector<Cells> table = {front_heads(input)};
  for (const int row : shown) {
    table.push_back(predicted_cells(view, row, shown));
    for (const CheckedRun* run : simulations_at(view, row)) table.push_back(simulated_cells(view, *run));
  }
  std::string text = input.study + ": Pareto front of " +
                     detail::counted(static_cast<std::size_t>(input.front.X.rows()), "point") +
                     ", predicted by the models; " + std::to_string(shown.size()) + " shown" +
                     (every_point ? ".\n\n" : " (--limit, --all).\n\n");
  text += text_table(table);
  text += "\nIn brackets: the interval that should hold 95 of 100 runs there, noise included.\n";
  for (const auto& [response, why] : texts_of(input.flat, input.problem))
    text += response + ": " + why + ".\n";
  text += recommended_text(view);
  text += non_dominated_text(input);
  text += places_text(view, shown);
  text += confirmation_text(input);
  for (const std::string& sentence : detail::cautions(input)) text += "Caution: " + sentence + "\n";
  return text;
}

nlohmann::ordered_json front_points_json(const ReportInput& input, int most) {
  const FrontView view(input);
  const std::vector<int> shown = rows_shown(view, most);
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const int row : every_row(input)) points.push_back(point_json(view, row, shown));
  return {{"points", std::move(points)},
          {"flat", flat_json(texts_of(input.flat, input.problem))},
          {"confirmed", confirmed_json(input.confirmations)},
          {"cautions", detail::cautions(input)}};
}

}  // namespace drawpoint::studies
