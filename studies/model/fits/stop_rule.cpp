// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/stop_rule.h>
#include <drawpoint/studies/run/settings.h>

#include <cmath>
#include <cstdio>
#include <regex>

namespace drawpoint::studies {
namespace {

constexpr const char* way_to_write_rules =
    "write MEASURE(RESPONSE) < NUMBER, several with \" and \" between, such as --until 'nrmse(";

[[noreturn]] void refuse_rule(const std::string& what, const doe::Problem& problem) {
  throw UsageError("--until: " + what + "; " + way_to_write_rules + problem.responses.front().name +
                   ") < 0.1'");
}

std::string name_of(ErrorMeasure measure) { return measure == ErrorMeasure::nrmse ? "nrmse" : "mean_error"; }

ErrorMeasure measure_named(const std::string& name, const doe::Problem& problem) {
  for (const auto measure : {ErrorMeasure::nrmse, ErrorMeasure::mean_error})
    if (name == name_of(measure)) return measure;
  refuse_rule("there is no measure \"" + name +
                  "\"; there are nrmse (of single runs) and mean_error (of the mean of many runs)",
              problem);
}

std::size_t response_named(const std::string& name, const doe::Problem& problem) {
  std::string names;
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    if (doe::is_standard_error(problem, j)) continue;
    if (problem.responses[j].name == name) return j;
    names += (names.empty() ? "" : ", ") + problem.responses[j].name;
  }
  refuse_rule("there is no response \"" + name + "\"; there are " + names, problem);
}

double bound_of(const std::string& text, const doe::Problem& problem) {
  const double bound = std::strtod(text.c_str(), nullptr);
  if (bound > 0.0 && bound <= 1.0) return bound;
  refuse_rule("an error of " + text + " is no share of the range; allowed is above 0 up to 1", problem);
}

StopCondition condition_from(const std::string& text, const doe::Problem& problem) {
  static const std::regex form(R"(\s*(\w+)\s*\(\s*([^()]*?)\s*\)\s*<\s*([0-9.]+(?:[eE][-+]?[0-9]+)?)\s*)");
  std::smatch part;
  if (!std::regex_match(text, part, form)) refuse_rule("\"" + text + "\" is no condition", problem);
  return {measure_named(part[1], problem), response_named(part[2], problem), bound_of(part[3], problem)};
}

std::string share_of_range(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", share);
  return std::isfinite(share) ? text : "unknown";
}

}  // namespace

StopRule stop_rule_from(const std::string& text, const doe::Problem& problem) {
  constexpr std::size_t longest = 1000;
  if (text.size() > longest)
    refuse_rule("it has " + std::to_string(text.size()) + " characters, and 1000 are allowed", problem);
  StopRule rule;
  if (text.empty()) return rule;
  static const std::string between = " and ";
  for (std::size_t from = 0;;) {
    const std::size_t to = text.find(between, from);
    rule.push_back(condition_from(text.substr(from, to == text.npos ? to : to - from), problem));
    if (to == text.npos) return rule;
    from = to + between.size();
  }
}

double error_that_counts(const kriging::MeanError& error) {
  return error.lower > 0 || !std::isfinite(error.upper) ? error.nrmse() : error.share(error.upper);
}

StopState stop_state(const StopRule& rule, const doe::Problem& problem,
                     const std::vector<kriging::Validation>& validations,
                     const std::vector<kriging::MeanError>& mean_errors) {
  StopState state{.met = !rule.empty() && !validations.empty()};
  for (const StopCondition& condition : rule) {
    const std::size_t j = condition.response;
    const bool of_runs = condition.measure == ErrorMeasure::nrmse;
    const double error = validations.empty() ? std::nan("")
                         : of_runs           ? validations[j].nrmse
                                             : error_that_counts(mean_errors[j]);
    if (!(error < condition.bound)) state.met = false;
    state.text += (state.text.empty() ? "" : "; ") + name_of(condition.measure) + "(" +
                  problem.responses[j].name + ") " + share_of_range(error) + ", wanted < " +
                  share_of_range(condition.bound);
    if (!of_runs || validations.empty()) continue;
    const double noise = mean_errors[j].share(mean_errors[j].noise);
    if (noise >= condition.bound)
      state.text += " (the noise of a run alone is " + share_of_range(noise) + ": ask for mean_error)";
  }
  return state;
}

}  // namespace drawpoint::studies
