// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The front of a smooth function: what a search found, finished with gradients.
///
///     polished_front(f, problem, nsga2(f, problem))
///
/// Each point of the search is moved to an optimum by polish in the Chebyshev form, and those that do not
/// arrive again in the ε-constraint form, within the limits of the problem. The front is what is non-dominated
/// among all points met on the way, so none of it is worse than the search alone. Points within 1e-7 of the
/// range of a bound are put on it first; their certificates are kept, and off by as little. The gain is
/// measured with the worst values of the searched front plus a tenth of their ranges as the reference point.
/// Whole and categorical variables cannot follow a gradient, and the hypervolume of more than
/// most_polished_objectives objectives takes too long: such fronts stay as searched, and say why. One objective
/// leaves one point. Cost: polish once, and again for the points that did not arrive.

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/population.hpp>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/filter.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/minimised.hpp>
#include <drawpoint/pareto/polish.hpp>
#include <drawpoint/pareto/polishing.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto {

inline constexpr int most_polished_objectives = 5;

enum class PolishedFrontStatus {
  completed,
  not_polished,  ///< gradients do not help on this front: it is as it was searched
  empty_front    ///< there was nothing to polish
};

inline std::string_view to_string(PolishedFrontStatus status) {
  switch (status) {
    case PolishedFrontStatus::completed:
      return "completed";
    case PolishedFrontStatus::not_polished:
      return "not_polished";
    case PolishedFrontStatus::empty_front:
      return "empty_front";
  }
  return "unknown";
}

struct PolishedFront {
  Front front = {};          ///< rows in rising order of the minimised objectives
  Polishing polishing = {};  ///< residual of each point, gain
  PolishedFrontStatus status = PolishedFrontStatus::completed;
  std::string message = {};  ///< empty when completed
};

namespace detail {

/// Empty when the front can be polished.
inline std::string why_not(const doe::Problem& problem, const Front& front) {
  for (const auto& variable : problem.variables) {
    if (variable.kind == doe::VariableKind::real) continue;
    return "variable \"" + variable.name + "\" is " + std::string(to_string(variable.kind)) +
           ", and polishing follows gradients";
  }
  if (front.Y.cols() <= most_polished_objectives) return "";
  return std::to_string(front.Y.cols()) + " objectives, and the hypervolume of more than " +
         std::to_string(most_polished_objectives) + " takes too long";
}

inline PolishedFront joined(const PolishedFront& a, const PolishedFront& b) {
  PolishedFront all = a;
  all.front.X = stacked(a.front.X, b.front.X);
  all.front.Y = stacked(a.front.Y, b.front.Y);
  all.front.responses = stacked(a.front.responses, b.front.responses);
  all.polishing.residual = stacked(a.polishing.residual, b.polishing.residual);
  return all;
}

/// x with what lies within 1e-7 of the range of a bound on the bound.
inline Eigen::VectorXd on_bounds(Eigen::VectorXd x, const doe::Problem& problem) {
  for (std::size_t k = 0; k < problem.variables.size(); ++k) {
    const auto& v = problem.variables[k];
    double& value = x[static_cast<Eigen::Index>(k)];
    const double near = 1e-7 * (v.upper - v.lower);
    if (value - v.lower <= near) value = v.lower;
    if (v.upper - value <= near) value = v.upper;
  }
  return x;
}

/// Ipopt stays about 1e-8 of the range away from the bounds that hold it, and searches end as near. Nobody
/// wants to read that, or both beside each other.
template <class F>
void put_on_bounds(Front& front, const F& means, const doe::Problem& problem) {
  for (Eigen::Index i = 0; i < front.X.rows(); ++i) {
    const Eigen::VectorXd x = front.X.row(i).transpose(), there = on_bounds(x, problem);
    if (there == x) continue;
    const Eigen::VectorXd y = means(there).values;
    if (!pareto::meets_limits(problem, y)) continue;
    front.X.row(i) = there.transpose();
    front.responses.row(i) = y.transpose();
  }
  Eigen::Index column = 0;
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    if (doe::is_objective(problem.responses[j].goal))
      front.Y.col(column++) = front.responses.col(static_cast<Eigen::Index>(j));
  }
}

/// What no other dominates, in lexicographic order, equal points once. Of one objective the first point:
/// others that end at the same minimum differ from it by rounding.
inline PolishedFront best_of(const PolishedFront& all, const doe::Problem& problem) {
  Eigen::MatrixXd keys(all.front.X.rows(), all.front.Y.cols() + all.front.X.cols());
  keys << minimised(problem, all.front.Y), all.front.X;
  std::vector<int> rows = non_dominated(keys.leftCols(all.front.Y.cols()));
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) {
    return std::lexicographical_compare(keys.row(a).begin(), keys.row(a).end(), keys.row(b).begin(),
                                        keys.row(b).end());
  });
  const auto equal = [&](int a, int b) { return keys.row(a) == keys.row(b); };
  rows.erase(std::unique(rows.begin(), rows.end(), equal), rows.end());
  if (all.front.Y.cols() == 1) rows.resize(1);
  PolishedFront best{.front = part_of(all.front, rows), .polishing = {}};
  best.polishing.residual = all.polishing.residual(rows);
  return best;
}

/// The points that are not certified, and the ends of every response's range, by which polish scales.
inline std::vector<int> rows_to_try_again(const PolishedFront& polished) {
  std::vector<int> rows;
  for (Eigen::Index i = 0; i < polished.front.X.rows(); ++i) {
    if (!(polished.polishing.residual[i] <= certified_residual)) rows.push_back(static_cast<int>(i));
  }
  if (rows.empty()) return rows;
  for (Eigen::Index j = 0; j < polished.front.responses.cols(); ++j) {
    Eigen::Index least = 0, most = 0;
    polished.front.responses.col(j).minCoeff(&least);
    polished.front.responses.col(j).maxCoeff(&most);
    rows.insert(rows.end(), {static_cast<int>(least), static_cast<int>(most)});
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

inline PolishedFront arrived_points(const Polished& polished) {
  std::vector<int> rows;
  for (Eigen::Index i = 0; i < polished.residual.size(); ++i) {
    if (polished.residual[i] <= certified_residual) rows.push_back(static_cast<int>(i));
  }
  PolishedFront arrived{.front = part_of(polished.front, rows), .polishing = {}};
  arrived.polishing.residual = polished.residual(rows);
  return arrived;
}

/// All points met on the way from a searched front to the polished one.
template <class F>
PolishedFront polished_points(const Polished& first, const Front& searched, const F& means,
                              const doe::Problem& problem) {
  PolishedFront before{.front = searched, .polishing = {.residual = first.residual_before}};
  PolishedFront after{.front = first.front, .polishing = {.residual = first.residual}};
  put_on_bounds(before.front, means, problem);
  put_on_bounds(after.front, means, problem);
  const std::vector<int> rows = rows_to_try_again(after);
  if (rows.empty()) return joined(before, after);
  const Polished second = polish(means, problem, part_of(after.front, rows),
                                 {.form = ScalarForm::epsilon_constraint, .iterations = 40});
  PolishedFront arrived = arrived_points(second);
  put_on_bounds(arrived.front, means, problem);
  return joined(joined(before, after), arrived);
}

/// Added to the hypervolume up to the reference [%]; NaN when there was none.
inline double gain_of(const Front& before, const Front& after, const doe::Problem& problem,
                      const Eigen::VectorXd& reference) {
  const double was = hypervolume(problem, before.Y, reference);
  if (!(was > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return 100.0 * (hypervolume(problem, after.Y, reference) / was - 1.0);
}

}  // namespace detail

/// f: at x, the values of all responses and their Jacobian; searched: a front that a search found on f.
/// Deterministic. Throws std::invalid_argument as polish does.
template <class F>
PolishedFront polished_front(const F& f, const doe::Problem& problem, const Front& searched) {
  if (searched.X.rows() == 0)
    return {
        .front = searched, .status = PolishedFrontStatus::empty_front, .message = "the front has no points"};
  if (std::string reason = detail::why_not(problem, searched); !reason.empty())
    return {.front = searched, .status = PolishedFrontStatus::not_polished, .message = std::move(reason)};
  const Polished first = polish(f, problem, searched);
  PolishedFront result = detail::best_of(detail::polished_points(first, searched, f, problem), problem);
  if (searched.Y.cols() == 1)
    result.polishing.residual.resize(0);
  else
    result.polishing.gain = detail::gain_of(searched, result.front, problem, first.reference);
  return result;
}

}  // namespace drawpoint::pareto
