// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Designs inside a region (region.hpp): three ways to honour input constraints.
///
/// * `feasible_sequence`: rejection; the first allowed points of a scrambled Halton sequence. Uniform over
/// the region.
/// * `feasible_maximin`: runs spread over the region by farthest-point choice among many allowed candidates
/// (Gonzalez
///   1985: at least half the best smallest distance that the candidates admit), then one run of the closest
///   pair moves to the candidate farthest from the others as long as the smallest distance grows.
/// * `feasible_replacement`: any design; its allowed runs stay, each other one is replaced by the candidate
/// farthest from
///   all runs.
/// Distances are in the unit box. Where candidates run out the status is `too_small` and X has the runs that
/// there are. Cost O(candidates·runs·d) and one call of the predicate a candidate.

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <drawpoint/doe/quality.hpp>
#include <drawpoint/doe/region.hpp>

namespace drawpoint::doe {

struct RegionOptions {
  Seed seed = 1;
  /// Allowed points to choose from, 1 or more; empty: 20 per run, at least 1000.
  std::optional<int> candidates = {};
  int tries = 1'000'000;  ///< calls of the predicate at most, 1 or more
};

namespace detail {

inline void check_region(const char* place, const RegionOptions& options) {
  const auto check = [&](const char* name, int value) {
    if (value < 1)
      throw std::invalid_argument(std::string(place) + ": " + name + " is " + std::to_string(value) +
                                  "; allowed is 1 or more");
  };
  check("candidates", options.candidates.value_or(1));
  check("tries", options.tries);
}

inline int candidate_count(const RegionOptions& options, int runs) {
  return options.candidates ? std::max(*options.candidates, runs) : std::max(20 * runs, 1000);
}

/// Squared distances of every row of U to one point.
inline Eigen::ArrayXd squared_distances(const Eigen::MatrixXd& U, const Eigen::RowVectorXd& point) {
  Eigen::ArrayXd D = Eigen::ArrayXd::Zero(U.rows());
  for (Eigen::Index j = 0; j < U.cols(); ++j) D += (U.col(j).array() - point[j]).square();
  return D;
}

/// Rows of the candidates C (unit box), each the farthest from `kept` and from those chosen before; fewer
/// than `count` when the rest coincide with them.
inline std::vector<Eigen::Index> farthest_points(const Eigen::MatrixXd& C, const Eigen::MatrixXd& kept,
                                                 int count) {
  std::vector<Eigen::Index> chosen;
  if (C.rows() == 0) return chosen;
  Eigen::ArrayXd nearest = Eigen::ArrayXd::Constant(C.rows(), std::numeric_limits<double>::infinity());
  for (Eigen::Index i = 0; i < kept.rows(); ++i) nearest = nearest.min(squared_distances(C, kept.row(i)));
  while (static_cast<int>(chosen.size()) < count) {
    Eigen::Index farthest = 0;
    if (nearest.maxCoeff(&farthest) <= 0.0) break;
    chosen.push_back(farthest);
    nearest = nearest.min(squared_distances(C, C.row(farthest)));
  }
  return chosen;
}

/// One row of the closest pair of U moves to the candidate farthest from the others while that helps; at most
/// `moves`.
inline void move_apart(Eigen::MatrixXd& U, const Eigen::MatrixXd& C, int moves) {
  for (int move = 0; move < moves && U.rows() > 1; ++move) {
    double least = std::numeric_limits<double>::infinity();
    Eigen::Index row = 0;
    for_squared_distances(U, [&](Eigen::Index i, const auto& D) {
      if (const double closest = D.minCoeff(); closest < least) std::tie(least, row) = std::pair(closest, i);
    });
    Eigen::ArrayXd nearest = Eigen::ArrayXd::Constant(C.rows(), std::numeric_limits<double>::infinity());
    for (Eigen::Index i = 0; i < U.rows(); ++i)
      if (i != row) nearest = nearest.min(squared_distances(C, U.row(i)));
    Eigen::Index farthest = 0;
    if (nearest.maxCoeff(&farthest) <= least) return;
    U.row(row) = C.row(farthest);
  }
}

/// As many moves as rows, fewer where they would cost more than some 2e9 operations.
inline int move_budget(const Eigen::MatrixXd& U, const Eigen::MatrixXd& C) {
  const double rows = static_cast<double>(U.rows()), elements = rows * static_cast<double>(U.cols());
  return static_cast<int>(std::min(rows, 2e9 / (elements * static_cast<double>(C.rows() + U.rows()))));
}

}  // namespace detail

/// The first `runs` allowed points of a sequence. Throws std::invalid_argument when runs < 1 or an option is
/// out of range.
template <class P>
ConstrainedDesign feasible_sequence(const Problem& problem, int runs, const P& allowed,
                                    const RegionOptions& options = {}) {
  require_point_predicate<P>();
  detail::check_design("doe::feasible_sequence", problem, runs);
  detail::check_region("doe::feasible_sequence", options);
  detail::FeasiblePoints found = detail::feasible_points(problem, runs, options.tries, allowed, options.seed);
  ConstrainedDesign design{std::move(found.X), RegionStatus::complete, "", found.share, 0};
  return design.X.rows() == runs ? design : detail::too_small(std::move(design), runs);
}

/// `runs` points spread over the region. Throws std::invalid_argument when runs < 1 or an option is out of
/// range.
template <class P>
ConstrainedDesign feasible_maximin(const Problem& problem, int runs, const P& allowed,
                                   const RegionOptions& options = {}) {
  require_point_predicate<P>();
  const char* place = "doe::feasible_maximin";
  detail::check_design(place, problem, runs);
  detail::check_region(place, options);
  const auto found = detail::feasible_points(problem, detail::candidate_count(options, runs), options.tries,
                                             allowed, options.seed);
  const Eigen::MatrixXd C = detail::to_unit_box(found.X, problem, place);
  const auto chosen = detail::farthest_points(C, Eigen::MatrixXd(0, C.cols()), runs);
  Eigen::MatrixXd U = C(chosen, Eigen::all);
  const bool complete = U.rows() == runs;
  if (complete) detail::move_apart(U, C, detail::move_budget(U, C));
  ConstrainedDesign design{detail::to_natural(std::move(U), problem), RegionStatus::complete, "", found.share,
                           0};
  return complete ? design : detail::too_small(std::move(design), runs);
}

/// X (n x d) with each row that is not allowed replaced; the allowed rows keep their places. Throws
/// std::invalid_argument when X does not fit the problem or an option is out of range.
template <class P>
ConstrainedDesign feasible_replacement(const Problem& problem, const Eigen::MatrixXd& X, const P& allowed,
                                       const RegionOptions& options = {}) {
  require_point_predicate<P>();
  const char* place = "doe::feasible_replacement";
  detail::check_inside(X, problem, place);
  detail::check_region(place, options);
  std::vector<Eigen::Index> kept, lost;
  for (Eigen::Index i = 0; i < X.rows(); ++i) (allowed(Eigen::VectorXd(X.row(i))) ? kept : lost).push_back(i);
  ConstrainedDesign design{X, RegionStatus::complete, "", 1.0, static_cast<int>(lost.size())};
  if (lost.empty()) {
    design.feasible_share = std::numeric_limits<double>::quiet_NaN();
    return design;
  }
  const auto runs = static_cast<int>(X.rows());
  const auto found = detail::feasible_points(problem, detail::candidate_count(options, runs), options.tries,
                                             allowed, options.seed);
  design.feasible_share = found.share;
  const Eigen::MatrixXd C = detail::to_unit_box(found.X, problem, place),
                        U = detail::to_unit_box(X(kept, Eigen::all), problem, place);
  const auto chosen = detail::farthest_points(C, U, static_cast<int>(lost.size()));
  for (std::size_t k = 0; k < chosen.size(); ++k) design.X.row(lost[k]) = found.X.row(chosen[k]);
  if (chosen.size() == lost.size()) return design;
  kept.insert(kept.end(), lost.begin(), lost.begin() + static_cast<std::ptrdiff_t>(chosen.size()));
  std::sort(kept.begin(), kept.end());
  design.X = Eigen::MatrixXd(design.X(kept, Eigen::all));
  design.replaced = static_cast<int>(chosen.size());
  return detail::too_small(std::move(design), runs);
}

}  // namespace drawpoint::doe
