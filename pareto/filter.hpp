// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Questions with limits: "joint damage at most 5 s: what is the best production?"
///
///   const Choice c = best(problem, front, "production", {at_most("joint_damage", 5.0)});
///
/// Conditions and answers are in natural units and may name any response of the problem, also a recorded one;
/// conditions_of(problem) are the limits that the problem itself sets. Only the points of the front are
/// asked: what lies between two of them is not known here. When none meets the conditions the answer is the
/// point of least Σ_c v_c/range_c, v_c how far condition c is missed, range_c that of its response on the
/// front. O(n).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/pareto/choice.hpp>
#include <drawpoint/pareto/detail/normalized.hpp>

namespace drawpoint::pareto {

/// goal: at_most or at_least; limit: finite, in the response's unit.
struct Condition {
  std::string response;
  doe::Goal goal = doe::Goal::at_most;
  double limit = 0.0;
};

inline Condition at_most(std::string response, double limit) {
  return {std::move(response), doe::Goal::at_most, limit};
}

inline Condition at_least(std::string response, double limit) {
  return {std::move(response), doe::Goal::at_least, limit};
}

inline std::vector<Condition> conditions_of(const doe::Problem& problem) {
  std::vector<Condition> conditions;
  for (const doe::Response& r : problem.responses)
    if (doe::is_constraint(r.goal)) conditions.push_back({r.name, r.goal, r.limit});
  return conditions;
}

/// Whether a point meets the problem's own limits; y: r, all responses in natural units.
inline bool meets_limits(const doe::Problem& problem, const Eigen::VectorXd& y) {
  const detail::Roles role = detail::roles(problem);
  return std::all_of(role.constraints.begin(), role.constraints.end(), [&](int c) {
    return detail::violation(problem.responses[static_cast<std::size_t>(c)], y[c]) == 0.0;
  });
}

namespace detail {

inline void check(const std::string& place, const std::vector<Condition>& conditions) {
  for (const Condition& c : conditions)
    if (!doe::is_constraint(c.goal) || !std::isfinite(c.limit))
      throw std::invalid_argument(
          place + "condition on \"" + c.response + "\" is " + std::string(doe::to_string(c.goal)) + " " +
          doe::detail::number_text(c.limit) + "; allowed is at_most or at_least a finite limit");
}

/// n x conditions: by how much each row misses each, 0 where it is met; natural units.
inline Eigen::MatrixXd misses(const doe::Problem& problem, const Front& front,
                              const std::vector<Condition>& conditions) {
  Eigen::MatrixXd missed(front.Y.rows(), static_cast<Eigen::Index>(conditions.size()));
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const int column = doe::response_index(problem, conditions[c].response);
    const double sign = doe::sign_of(conditions[c].goal);
    missed.col(static_cast<Eigen::Index>(c)) =
        (sign * (front.responses.col(column).array() - conditions[c].limit)).max(0.0);
  }
  return missed;
}

inline std::vector<int> rows_without(const Eigen::MatrixXd& missed) {
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(missed.rows()); ++i)
    if ((missed.row(i).array() == 0.0).all()) rows.push_back(i);
  return rows;
}

/// 1 when less of the response is better, -1 when more is.
inline double direction(const std::string& place, const doe::Response& r) {
  if (r.goal == doe::Goal::record)
    throw std::invalid_argument(place + "response \"" + r.name +
                                "\" is only recorded, so no value of it is better than another; give it a "
                                "goal or ask with a condition");
  return doe::sign_of(r.goal);
}

/// "joint_damage is 7.5 s at best" for each condition that no row meets alone, or that they exclude each
/// other.
inline std::string why_none(const doe::Problem& problem, const Front& front,
                            const std::vector<Condition>& conditions, const Eigen::MatrixXd& missed) {
  std::string text;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    if (missed.col(static_cast<Eigen::Index>(c)).minCoeff() == 0.0) continue;
    const int column = doe::response_index(problem, conditions[c].response);
    const auto y = front.responses.col(column);
    const double best = conditions[c].goal == doe::Goal::at_most ? y.minCoeff() : y.maxCoeff();
    text += (text.empty() ? "" : ", ") + conditions[c].response + " is " +
            doe::detail::with_unit(best, problem.responses[static_cast<std::size_t>(column)].unit) +
            " at best";
  }
  return "no point of the front meets the conditions: " +
         (text.empty() ? "each is met somewhere, but nowhere all" : text) + "; relax them";
}

inline Choice nearest_to_meeting(const doe::Problem& problem, const Front& front,
                                 const std::vector<Condition>& conditions, const Eigen::MatrixXd& missed) {
  Eigen::VectorXd total = Eigen::VectorXd::Zero(missed.rows());
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const auto y = front.responses.col(doe::response_index(problem, conditions[c].response));
    const double range = y.maxCoeff() - y.minCoeff();
    total += missed.col(static_cast<Eigen::Index>(c)) / (range > 0.0 ? range : 1.0);
  }
  Choice choice = cheapest(total);
  choice.status = ChoiceStatus::none_meets;
  choice.ranking.clear();
  choice.message = why_none(problem, front, conditions, missed);
  return choice;
}

}  // namespace detail

/// The rows that meet all conditions, in rising order. This and `best` throw std::invalid_argument for a
/// front of another problem, a response that does not exist and a condition that is none.
inline std::vector<int> meeting(const doe::Problem& problem, const Front& front,
                                const std::vector<Condition>& conditions) {
  detail::check_front("pareto::meeting: ", problem, front);
  detail::check("pareto::meeting: ", conditions);
  return front.Y.rows() == 0 ? std::vector<int>{}
                             : detail::rows_without(detail::misses(problem, front, conditions));
}

/// The best value of one response among the points that meet the conditions. value: that response in natural
/// units; when none meets them, how far the nearest point misses, in ranges.
inline Choice best(const doe::Problem& problem, const Front& front, const std::string& response,
                   const std::vector<Condition>& conditions = {}) {
  const std::string place = "pareto::best: ";
  detail::check_front(place, problem, front);
  detail::check(place, conditions);
  const int column = doe::response_index(problem, response);
  const double sign = detail::direction(place, problem.responses[static_cast<std::size_t>(column)]);
  if (front.Y.rows() == 0) return detail::nothing_to_choose();
  const Eigen::MatrixXd missed = detail::misses(problem, front, conditions);
  Choice choice;
  choice.ranking = detail::ranked(detail::rows_without(missed), sign * front.responses.col(column));
  if (choice.ranking.empty()) return detail::nearest_to_meeting(problem, front, conditions, missed);
  choice.row = choice.ranking.front();
  choice.value = front.responses(choice.row, column);
  return choice;
}

/// Some rows of a front as a front of their own; counts and status stay.
inline Front part_of(const Front& front, const std::vector<int>& rows) {
  Front part = front;
  part.X = front.X(rows, Eigen::all);
  part.Y = front.Y(rows, Eigen::all);
  part.responses = front.responses(rows, Eigen::all);
  return part;
}

}  // namespace drawpoint::pareto
