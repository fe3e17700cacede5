// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/run_quantile.h>
#include <drawpoint/studies/model/fits/same_place.h>
#include <drawpoint/studies/model/fits/stated_interval.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/model/recommendation.h>
#include <drawpoint/studies/model/trust.h>
#include <drawpoint/studies/say/page/answer.h>
#include <drawpoint/studies/say/page/cautions.h>
#include <drawpoint/studies/say/page/trust_texts.h>
#include <drawpoint/pareto/filter.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace drawpoint::studies {
namespace {

using detail::counted;
using detail::listed;
using detail::number;
using detail::number_with_unit;
using detail::objectives;
using detail::point_text;
using detail::pretty;
using nlohmann::json;

constexpr double two_sided = 1.96;  // standard errors, 95 %

std::string range_text(double lower, double upper, const std::string& unit = "1") {
  return number(lower) + " to " + number_with_unit(upper, unit);
}

/// "production 712 kg/s and joint damage 1.2 s", of values of all responses.
std::string values_text(const ReportInput& input, const Eigen::VectorXd& values) {
  std::vector<std::string> parts;
  for (const std::size_t j : objectives(input.problem)) {
    const doe::Response& r = input.problem.responses[j];
    parts.push_back(pretty(r.name) + " " + number_with_unit(values[static_cast<Eigen::Index>(j)], r.unit));
  }
  return listed(parts);
}

std::string simulated_text(const ReportInput& input, const Recommendation& r) {
  if (r.simulated.empty())
    return "predicted and not simulated yet; " + confirming_point(input, r.x) + " simulates it";
  const doe::Evaluation& last = r.simulated.front();
  return "simulated" +
         (r.simulated.size() > 1 ? " by " + counted(r.simulated.size(), "run") : std::string()) + ": run " +
         std::to_string(last.run) + " gave " + values_text(input, last.outcome.values());
}

std::string with_sign(double value) {
  return (value > 0 ? "+" : value < 0 ? "\u2212" : "") + number(std::abs(value));
}

/// "production +23 kg/s (−152 to +201)"
std::string gain_text(const doe::Response& r, const Gain& gain) {
  std::string text = pretty(r.name) + " " + with_sign(gain.difference()) +
                     (r.unit.empty() || r.unit == "1" ? "" : " " + r.unit);
  if (!std::isfinite(gain.lower)) return text;
  return text + " (" + with_sign(gain.lower) + " to " + with_sign(gain.upper) + ")";
}

/// Where the strategy surely gives less than another from some haul on, which the runs do not count.
std::string haul_text(const ReportInput& input) {
  if (!input.hauls) return "";
  const HaulChoice& hauls = *input.hauls;
  for (const HaulTurn& turn : hauls.turns) {
    if (hauls.strategies[turn.worse].name != "recommended" || turn.haul <= hauls.haul ||
        !(turn.upper <= hauls.longest))
      continue;
    return "; from a haul of " + number(turn.haul) + " s on (" + range_text(turn.lower, turn.upper) +
           "), where " + number(hauls.haul) + " s are counted, \u201c" + hauls.strategies[turn.better].name +
           "\u201d gives more " + pretty(input.problem.responses[hauls.response].name);
  }
  return "";
}

/// "; the middle of the box itself breaks a limit: strength 105 MPa", by the models' means.
std::string limits_of_reference(const ReportInput& input, const Recommendation& r) {
  const Eigen::VectorXd means = predicted_means(input, r.reference.x.transpose()).row(0).transpose();
  std::vector<std::string> broken;
  for (std::size_t j = 0; j < input.problem.responses.size(); ++j) {
    const doe::Response& response = input.problem.responses[j];
    const double y = means[static_cast<Eigen::Index>(j)];
    if (doe::is_constraint(response.goal) && doe::sign_of(response.goal) * (y - response.limit) > 0)
      broken.push_back(pretty(response.name) + " " + number_with_unit(y, response.unit));
  }
  if (broken.empty()) return "";
  return "; " + r.reference.name + " itself breaks " + (broken.size() > 1 ? "limits: " : "a limit: ") +
         listed(broken);
}

std::string what_it_gains(const ReportInput& input, const Recommendation& r) {
  if (is_same_place(input.problem, r.x, r.reference.x))
    return "That is " + r.reference.name + " itself" + haul_text(input) + ".";
  std::vector<std::string> parts;
  for (const Gain& gain : r.gains) parts.push_back(gain_text(input.problem.responses[gain.response], gain));
  return "Against " + r.reference.name + " the models expect " + listed(parts) + haul_text(input) +
         "; in brackets with 95 %" + limits_of_reference(input, r) + ".";
}

bool is_better(const ReportInput& input, const Gain& gain) {
  return doe::sign_of(input.problem.responses[gain.response].goal) * gain.difference() < 0;
}

/// Responses that are better than the reference with 95 %, worse with 95 %, and not told apart from it.
struct Judged {
  std::vector<std::string> better, worse, open;
};

Judged judged(const ReportInput& input, const Recommendation& r) {
  Judged names;
  for (const Gain& gain : r.gains) {
    const std::string name = pretty(input.problem.responses[gain.response].name);
    if (!gain.is_sure())
      names.open.push_back(name);
    else
      (is_better(input, gain) ? names.better : names.worse).push_back(name);
  }
  return names;
}

/// What is better than the reference in no response is favoured, not recommended: noise alone has a best place, too.
std::string what_to_do(const ReportInput& input, const Recommendation& r) {
  const std::string point = point_text(input.problem, r.x),
                    values = values_text(input, predicted_means(input, r.x.transpose()).row(0).transpose()),
                    simulated = simulated_text(input, r);
  if (judged(input, r).better.empty() && limits_of_reference(input, r).empty() &&
      !is_same_place(input.problem, r.x, r.reference.x))
    return "The models favour " + point + ", where they expect " + values + ", " + simulated +
           "; it is not told to be better than " + r.reference.name + ".";
  return "Take " + point + ": the models expect " + values + " there, " + simulated + ".";
}

/// What one run there may give.
std::string one_run_text(const ReportInput& input, const Recommendation& r) {
  std::vector<std::string> parts;
  for (const Gain& gain : r.gains) {
    const doe::Response& response = input.problem.responses[gain.response];
    const auto end = [&](double p) {
      return run_quantile(input.models, input.problem, gain.response, r.x.transpose(), p)[0];
    };
    const double lower = end(0.5 - 0.5 * stated_level), upper = end(0.5 + 0.5 * stated_level);
    if (!std::isfinite(lower) || number(lower) == number(upper)) continue;
    parts.push_back(pretty(response.name) + " " + range_text(lower, upper, response.unit));
  }
  return parts.empty() ? "" : "; 95 of 100 single runs there give " + listed(parts);
}

std::string how_sure(const ReportInput& input, const Recommendation& r) {
  const Judged names = judged(input, r);
  std::vector<std::string> said;
  if (!names.better.empty()) said.push_back("better in " + listed(names.better));
  if (!names.worse.empty()) said.push_back("worse in " + listed(names.worse));
  if (!names.open.empty()) said.push_back("perhaps better, perhaps worse in " + listed(names.open));
  const std::string by =
      input.validations.empty() ? "by models that no validation run has checked" : "by the models";
  return "How sure: " + by + ", the mean of many runs is with 95 % " + listed(said) + one_run_text(input, r) +
         ".";
}

/// The most frequent reason of the runs that failed.
std::string main_reason(const ReportInput& input) {
  std::map<std::string, int> counts;
  for (const auto* table : {&input.training, &input.validation})
    for (const doe::Evaluation& e : table->rows)
      if (e.outcome.failed()) ++counts[e.outcome.reason()];
  if (counts.empty()) return "";
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

std::vector<std::string> nothing_yet(const ReportInput& input) {
  const doe::Problem asked = as_asked(input.problem, input.flat);
  const std::string begin = "Nothing can be recommended: ";
  const std::size_t runs = input.training.rows.size() + input.validation.rows.size();
  const auto failed = static_cast<std::size_t>(input.training.failed() + input.validation.failed());
  if (objectives(asked).empty()) return {begin + "the study names no response to minimize or maximize."};
  if (runs == 0) return {begin + "no run that counts has ended yet."};
  if (failed == runs)
    return {begin + "all " + counted(runs, "run") + " failed, for example because " + main_reason(input) +
            "."};
  if (input.models.empty()) {
    std::string best;
    for (const std::size_t j : objectives(asked))
      if (const std::string lucky = detail::luckiest_run(input, j); !lucky.empty())
        best += " Of " + pretty(asked.responses[j].name) + lucky.substr(1) + ".";
    return {begin + counted(runs - failed, "run") + " that succeeded are too few for a model." + best};
  }
  if (objectives(input.problem).empty())
    return {begin + "no objective (" + flat_objectives(input.flat, input.problem) +
            ") differs between strategies by clearly more than the error of its model."};
  return {begin + (input.no_front.empty() ? "the models have not been searched" : input.no_front) + "."};
}

std::string trust_line(const ReportInput& input) {
  std::vector<std::string> parts;
  const json verdicts = detail::trust(input);
  std::size_t next = 0, others = 0;
  for (std::size_t j = 0; j < input.problem.responses.size(); ++j) {
    if (doe::is_standard_error(input.problem, j)) continue;
    const json& verdict = verdicts[next++];
    if (as_asked(input.problem, input.flat).responses[j].goal == doe::Goal::record)
      ++others;
    else
      parts.push_back(verdict["response"].get<std::string>() + " " + verdict["grade"].get<std::string>());
  }
  return listed(parts) +
         (others > 0 ? "; and " + counted(others, "response") + " that the study only records" : "");
}

}  // namespace

std::string command_text(const ReportInput& input, const std::string& command) {
  const std::string& program = input.going_on.program;
  return (program.empty() ? "" : program + " ") + command + input.going_on.folder;
}

std::string confirming_point(const ReportInput& input, const Eigen::VectorXd& x) {
  if (input.confirming != "confirm") return command_text(input, input.confirming);  // runs are made elsewhere
  return command_text(input, "confirm --points 0 --rounds 1 --x=" + typed_values(x));
}

std::vector<std::string> answer_sentences(const ReportInput& input) {
  if (!input.recommended) return nothing_yet(input);
  const Recommendation& recommended = *input.recommended;
  return {what_to_do(input, recommended), what_it_gains(input, recommended), how_sure(input, recommended)};
}

namespace detail {

json answer_json(const ReportInput& input) {
  const std::optional<Recommendation>& found = input.recommended;
  json answer{{"sentences", answer_sentences(input)},
              {"x", nullptr},
              {"row", -1},
              {"command", nullptr},
              {"simulated", json::array()},
              {"reference", nullptr},
              {"trust", trust_line(input)},
              {"cautions", cautions(input).size()}};
  if (!found) return answer;
  const auto list = [](const Eigen::VectorXd& x) { return std::vector<double>(x.begin(), x.end()); };
  answer["x"] = list(found->x);
  answer["row"] = found->row;
  answer["reference"] = {{"name", found->reference.name}, {"x", list(found->reference.x)}};
  answer["means"] = list(predicted_means(input, found->x.transpose()).row(0).transpose());
  answer["reference"]["means"] =
      list(predicted_means(input, found->reference.x.transpose()).row(0).transpose());
  if (found->simulated.empty()) answer["command"] = confirming_point(input, found->x);
  for (const doe::Evaluation& run : found->simulated) answer["simulated"].push_back(run.run);
  return answer;
}

std::string luckiest_run(const ReportInput& input, std::size_t j) {
  const doe::Response& response = input.problem.responses[j];
  const doe::Problem asked = as_asked(input.problem, input.flat);
  const double sign = doe::sign_of(asked.responses[j].goal);
  const doe::Evaluation* best = nullptr;
  std::size_t runs = 0;
  const auto value = [&](const doe::Evaluation& e) {
    return e.outcome.values()[static_cast<Eigen::Index>(j)];
  };
  for (const auto* table : {&input.training, &input.validation})
    for (const doe::Evaluation& e : table->rows) {
      if (e.outcome.failed() || !pareto::meets_limits(input.problem, e.outcome.values())) continue;
      ++runs;
      if (!best || sign * value(e) < sign * value(*best)) best = &e;
    }
  if (!best) return "";
  const double scatter = scatter_of_run(input, j, *best), y = value(*best);
  const auto end = [&](double side) {
    return number_with_unit(doe::within_range(response, y + side * two_sided * scatter),
                            side > 0 ? response.unit : "1");
  };
  const bool scatters = scatter > 0,
             limited = std::any_of(asked.responses.begin(), asked.responses.end(),
                                   [](const doe::Response&r) { return doe::is_constraint(r.goal); });
  std::string text = std::string("; the ") + (scatters ? "luckiest" : "best") + " of " +
                     counted(runs, "single run") + (limited ? " within the limits" : "") + ", run " +
                     std::to_string(best->run) + ", gave " + number_with_unit(y, response.unit);
  if (scatters) text += " (" + end(-1) + " to " + end(1) + " with 95 %)";
  if (j < input.models.size())
    text += ", where the model expects " +
            number_with_unit(predicted_means(input, best->x.transpose())(0, static_cast<Eigen::Index>(j)),
                             response.unit) +
            " in the mean of many";
  return text;
}

}  // namespace detail
}  // namespace drawpoint::studies
