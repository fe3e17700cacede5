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

/// One point per row: place in the unit box (contiguous, for places are most of what is copied), responses
/// in natural units, minimised objectives, constraint violations. The rows of a failed point hold zeros
/// beyond U.
struct Population {
  RowMajor U;
  Eigen::MatrixXd responses, Y, violations;
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

/// Neighbours are copied as one block.
inline RowMajor selected_places(const RowMajor& U, const std::vector<int>& rows) {
  RowMajor result(rows.size(), U.cols());
  for (std::size_t k = 0, next; k < rows.size(); k = next) {
    for (next = k + 1; next < rows.size() && rows[next] == rows[next - 1] + 1;) ++next;
    const auto count = static_cast<Eigen::Index>(next - k);
    result.middleRows(static_cast<Eigen::Index>(k), count) = U.middleRows(rows[k], count);
  }
  return result;
}

inline Population selected(const Population& from, const std::vector<int>& rows) {
  Population p{selected_places(from.U, rows),
               from.responses(rows, Eigen::all),
               from.Y(rows, Eigen::all),
               from.violations(rows, Eigen::all),
               {}};
  p.failed.reserve(rows.size());
  for (const int i : rows) p.failed.push_back(from.failed[i]);
  return p;
}

template <class Matrix>
Matrix stacked(const Matrix& top, const Matrix& bottom) {
  Matrix all(top.rows() + bottom.rows(), top.cols());
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
