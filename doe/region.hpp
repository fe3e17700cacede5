// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The part of the box in which runs are allowed: a predicate on points, bool p(const Eigen::VectorXd& x), x
/// in natural units.
///
/// Anything callable so will do, a lambda that asks a quick simulator as well as `LinearConstraints`, A x <=
/// b. A predicate must give the same answer each time. `feasible_points` draws from a sequence of the problem
/// and keeps what is allowed. Cost: one call of the predicate a point.

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <drawpoint/doe/halton.hpp>
#include <drawpoint/doe/uniform.hpp>

namespace drawpoint::doe {

/// The result must be bool itself: a response function, whose double would convert, is no predicate.
template <class P>
concept PointPredicate = requires(const P& p, const Eigen::VectorXd& x) {
  { p(x) } -> std::same_as<bool>;
};

template <class P>
constexpr void require_point_predicate() {
  static_assert(
      PointPredicate<P>,
      "drawpoint: not a region. Expected bool allowed(const Eigen::VectorXd& x) const, true where a run is "
      "allowed; a lambda without 'mutable' that returns bool, or doe::LinearConstraints.");
}

/// A x <= b, row by row; A: m x d, b: m, natural units. Equality counts as allowed.
struct LinearConstraints {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;

  bool operator()(const Eigen::VectorXd& x) const {
    if (A.cols() != x.size() || A.rows() != b.size())
      throw std::invalid_argument("doe::LinearConstraints: A is " + std::to_string(A.rows()) + " x " +
                                  std::to_string(A.cols()) + ", b has " + std::to_string(b.size()) +
                                  ", x has " + std::to_string(x.size()) +
                                  " entries; A has a row for each entry of b and a column for each variable");
    return ((A * x).array() <= b.array()).all();
  }
};

enum class RegionStatus {
  complete,   ///< every run is allowed and asked-for properties hold
  not_latin,  ///< every run is allowed, but some left their strata
  too_small   ///< fewer runs than asked for: the region, or the share of it that was found, is too small
};

inline std::string_view to_string(RegionStatus status) {
  switch (status) {
    case RegionStatus::complete:
      return "complete";
    case RegionStatus::not_latin:
      return "not_latin";
    case RegionStatus::too_small:
      return "too_small";
  }
  return "unknown";
}

struct ConstrainedDesign {
  Eigen::MatrixXd X;  ///< n x d, natural units, every row allowed
  RegionStatus status = RegionStatus::complete;
  std::string message = {};     ///< empty when complete
  double feasible_share = 1.0;  ///< of the points that were asked about at random; NaN: none was
  int replaced = 0;             ///< runs that do not stand where the unconstrained design has them
};

namespace detail {

/// Points that are allowed, and the share of those tried.
struct FeasiblePoints {
  Eigen::MatrixXd X;   ///< at most the wanted rows
  double share = 0.0;  ///< allowed / tried
};

/// Runs first..first+count-1 of a scrambled Halton sequence, or of independent points beyond 100 variables.
inline Eigen::MatrixXd sequence_part(const Problem& problem, int first, int count, Seed seed) {
  const auto d = static_cast<int>(problem.variables.size());
  if (d > halton_max_dimensions)
    return uniform_random(problem, count, {.seed = run_seed(seed, static_cast<std::uint64_t>(first), 0)});
  Eigen::MatrixXd U(count, d);
  for (int j = 0; j < d; ++j) U.col(j) = halton_column(first, count, j, seed, HaltonKind::scrambled);
  return to_natural(std::move(U), problem);
}

/// The first `wanted` allowed points of the sequence, of at most `tries`.
template <class P>
FeasiblePoints feasible_points(const Problem& problem, int wanted, int tries, const P& allowed, Seed seed) {
  Eigen::MatrixXd found(wanted, static_cast<Eigen::Index>(problem.variables.size()));
  int count = 0, tried = 0;
  while (tried < tries && count < wanted) {
    const int part = std::min(tries - tried, std::max(wanted, tried));  // twice as many each time
    const Eigen::MatrixXd X = sequence_part(problem, tried, part, seed);
    for (int i = 0; i < part && count < wanted; ++i, ++tried)
      if (allowed(Eigen::VectorXd(X.row(i)))) found.row(count++) = X.row(i);
  }
  return {found.topRows(count), tried > 0 ? static_cast<double>(count) / tried : 0.0};
}

inline ConstrainedDesign too_small(ConstrainedDesign design, int runs) {
  design.status = RegionStatus::too_small;
  design.message =
      "only " + std::to_string(design.X.rows()) + " of " + std::to_string(runs) +
      " runs: distinct allowed points ran out, " + number_text(design.feasible_share) +
      " of those tried are allowed; widen the region, shrink the bounds around it, or raise tries";
  return design;
}

}  // namespace detail

}  // namespace drawpoint::doe
