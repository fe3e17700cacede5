// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Evaluated points as the search sees them, and their order by constrained dominance.
///
/// A feasible point comes before an infeasible one, an infeasible one before a failed one. Feasible points
/// are ordered by Pareto dominance, infeasible ones by Σ_c v_c / w_c, where v_c >= 0 is the violation of
/// constraint c and w_c the largest that the search has met: no unit and no weight enters (Deb 2000, "An
/// efficient constraint handling method").

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/pareto/detail/roles.hpp>
#include <drawpoint/pareto/dominance.hpp>

namespace drawpoint::pareto::detail {

/// One point per row: place in the unit box, responses in natural units, minimised objectives, constraint
/// violations. The rows of a failed point hold zeros beyond U.
struct Population {
  Eigen::MatrixXd U, responses, Y, violations;
  std::vector<char> failed;

  Eigen::Index size() const { return U.rows(); }
  bool feasible(Eigen::Index i) const { return !failed[i] && (violations.row(i).array() == 0.0).all(); }
};

inline Population assess(const doe::Problem& problem, Eigen::MatrixXd U,
                         const std::vector<doe::Outcome>& outcomes) {
  const Roles role = roles(problem);
  const Eigen::Index n = U.rows();
  Population p{std::move(U), Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(problem.responses.size())),
               Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(role.objectives.size())),
               Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(role.constraints.size())),
               std::vector<char>(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    p.failed[i] = outcomes[i].failed();
    if (p.failed[i]) continue;
    const Eigen::VectorXd& values = outcomes[i].values();
    p.responses.row(i) = values;
    for (std::size_t j = 0; j < role.objectives.size(); ++j)
      p.Y(i, j) = role.signs[j] * values[role.objectives[j]];
    for (std::size_t c = 0; c < role.constraints.size(); ++c) {
      const int k = role.constraints[c];
      p.violations(i, c) = violation(problem.responses[k], values[k]);
    }
  }
  return p;
}

inline Population selected(const Population& from, const std::vector<int>& rows) {
  Population p{from.U(rows, Eigen::all),
               from.responses(rows, Eigen::all),
               from.Y(rows, Eigen::all),
               from.violations(rows, Eigen::all),
               {}};
  for (const int i : rows) p.failed.push_back(from.failed[i]);
  return p;
}

inline Eigen::MatrixXd stacked(const Eigen::MatrixXd& top, const Eigen::MatrixXd& bottom) {
  Eigen::MatrixXd all(top.rows() + bottom.rows(), top.cols());
  all.topRows(top.rows()) = top;
  all.bottomRows(bottom.rows()) = bottom;
  return all;
}

inline Population joined(const Population& a, const Population& b) {
  Population p{stacked(a.U, b.U), stacked(a.responses, b.responses), stacked(a.Y, b.Y),
               stacked(a.violations, b.violations), a.failed};
  p.failed.insert(p.failed.end(), b.failed.begin(), b.failed.end());
  return p;
}

/// Fronts from the best; the first `feasible` of them hold the feasible points, sorted by dominance.
struct Ranking {
  std::vector<std::vector<int>> fronts;
  std::size_t feasible = 0;
};

/// Appends the infeasible points, the least violating first; equally violating ones share a front.
inline void rank_infeasible(const Population& p, const Eigen::RowVectorXd& largest,
                            std::vector<int> infeasible, Ranking& ranking) {
  const Eigen::RowVectorXd scale = largest.cwiseMax(std::numeric_limits<double>::min());
  const Eigen::VectorXd total = (p.violations.array().rowwise() / scale.array()).rowwise().sum();
  std::stable_sort(infeasible.begin(), infeasible.end(), [&](int a, int b) { return total[a] < total[b]; });
  double last = -1.0;
  for (const int i : infeasible) {
    if (total[i] != last) ranking.fronts.emplace_back();
    ranking.fronts.back().push_back(i);
    last = total[i];
  }
}

/// largest: by constraint, the scale of its violations.
inline Ranking rank(const Population& p, const Eigen::RowVectorXd& largest) {
  std::vector<int> feasible, infeasible, failed;
  for (int i = 0; i < static_cast<int>(p.size()); ++i)
    (p.failed[i] ? failed : p.feasible(i) ? feasible : infeasible).push_back(i);
  Ranking ranking;
  ranking.fronts = non_dominated_sort(p.Y(feasible, Eigen::all));
  ranking.feasible = ranking.fronts.size();
  for (auto& front : ranking.fronts)
    for (int& i : front) i = feasible[i];
  rank_infeasible(p, largest, std::move(infeasible), ranking);
  if (!failed.empty()) ranking.fronts.push_back(std::move(failed));
  return ranking;
}

/// As `rank`, of feasible points, none of which dominates another, and one more in the last row: what the
/// sort would find, in one look at each point.
inline Ranking rank_with_newcomer(const Population& p) {
  const auto last = static_cast<int>(p.size()) - 1;
  const auto newcomer = p.Y.row(last);
  std::vector<int> level, beaten;  // with the newcomer, and what it dominates
  bool is_beaten = !p.feasible(last);
  for (int i = 0; i < last; ++i) {
    is_beaten = is_beaten || dominates(p.Y.row(i), newcomer);
    (!is_beaten && dominates(newcomer, p.Y.row(i)) ? beaten : level).push_back(i);
  }
  if (is_beaten) return {{std::move(level), {last}}, p.feasible(last) ? std::size_t{2} : std::size_t{1}};
  level.push_back(last);
  if (beaten.empty()) return {{std::move(level)}, 1};
  return {{std::move(level), std::move(beaten)}, 2};
}

/// The feasible points that no other point of the population dominates.
inline Population best_of(const Population& population) {
  std::vector<int> feasible;
  for (int i = 0; i < static_cast<int>(population.size()); ++i)
    if (population.feasible(i)) feasible.push_back(i);
  std::vector<int> rows = non_dominated(population.Y(feasible, Eigen::all));
  for (int& i : rows) i = feasible[i];
  return selected(population, rows);
}

}  // namespace drawpoint::pareto::detail
