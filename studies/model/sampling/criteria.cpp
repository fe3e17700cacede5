// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/sampling/criteria.h>
#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/joined.h>
#include <drawpoint/doe/criterion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace drawpoint::studies {
namespace {

constexpr const char* repeat = "repeat";
constexpr const char* together = "joint_improvement";
constexpr std::array<const char*, 12> criterion_names = {
    "lola_voronoi", "voronoi",     "distance",    "error",  "cross_validation",
    "variance",     "feasibility", "improvement", together, "knowledge_gradient",
    "predicted",    repeat};

[[noreturn]] void refuse_criterion(const std::string& part) {
  throw UsageError(
      "\"" + part +
      "\" is no criterion and weight; give NAME=WEIGHT with commas between, weights above 0, of " +
      joined(criterion_names));
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

void check_criterion(const std::string& name, int objectives, bool limits) {
  if (name == "improvement" && objectives == 0)
    throw UsageError(
        "--criteria: improvement needs a response that is minimized or maximized; take another criterion");
  if (name == "feasibility" && !limits)
    throw UsageError(
        "--criteria: feasibility needs a response with a limit, at_most or at_least; take another criterion");
  const bool of_one_best = name == together || name == "knowledge_gradient";
  if ((of_one_best || name == "predicted") && objectives != 1)
    throw UsageError(
        "--criteria: " + name + " needs one response that is minimized or maximized, and there are " +
        std::to_string(objectives) +
        (objectives > 1 ? "; take improvement, which weighs several" : "; take another criterion"));
  if (of_one_best && limits)
    throw UsageError("--criteria: " + name +
                     " knows no limits, and its best run may break one; take improvement, which keeps them");
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
  std::vector<double> weights(3, 0.0);  // of repeats, of points chosen together, of the others
  for (const CriterionShare& share : shares) {
    const std::size_t kind = share.name == repeat ? 0 : share.name == together ? 1 : 2;
    weights[kind] += share.weight;
    if (kind == 2) turns.new_ones.push_back(share);
  }
  turns.may_repeat = weights[0] > 0.0;
  turns.may_join = weights[1] > 0.0;
  const std::vector<int> dealt = doe::turns_by_weight(weights, made, count);
  turns.repeats = dealt[0];
  turns.together = dealt[1];
  return turns;
}

void check_criteria(const std::string& text, const doe::Problem& problem) {
  int objectives = 0;
  bool limits = false;
  for (const doe::Response& response : problem.responses) {
    objectives += doe::is_objective(response.goal) ? 1 : 0;
    limits = limits || doe::is_constraint(response.goal);
  }
  for (const auto& share : criteria_from(text)) check_criterion(share.name, objectives, limits);
}

}  // namespace drawpoint::studies
