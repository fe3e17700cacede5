// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Inputs that are categories: their values are the indices 0, 1, ... of levels without an order.
///
/// `levels` has one entry per input: 0 for a number, L >= 2 for a category of L levels; empty: all inputs are
/// numbers. Two different levels are as far from each other as the ends of the range of a number, 2 on the
/// scale of [-1, 1], whichever they are: L levels are the corners of a regular simplex. A correlation of
/// numbers is one of levels then, positive definite because it is that of points in space.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/detail/dense.hpp>

namespace drawpoint::kriging::detail {

inline constexpr double level_distance = 2.0;

inline bool is_category(const std::vector<int>& levels, Index k) {
  return !levels.empty() && levels[static_cast<std::size_t>(k)] > 0;
}

/// The distance between two scaled values of input k.
inline double distance_between(const std::vector<int>& levels, Index k, double a, double b) {
  if (is_category(levels, k)) return a == b ? 0.0 : level_distance;
  return std::abs(a - b);
}

/// Whether all runs have one value of input k.
inline bool never_varies(const Eigen::MatrixXd& X, Index k) {
  const double* x = column(X, k);
  return std::all_of(x, x + X.rows(), [=](double value) { return value == x[0]; });
}

/// Throws std::invalid_argument that begins with `place` for an entry of X that is no level of its category.
inline void require_levels(const std::string& place, const Eigen::MatrixXd& X,
                           const std::vector<int>& levels) {
  for (Index k = 0; k < X.cols(); ++k) {
    if (!is_category(levels, k)) continue;
    const int count = levels[static_cast<std::size_t>(k)];
    for (Index i = 0; i < X.rows(); ++i)
      if (const double x = X(i, k); !(x >= 0 && x < count && x == std::floor(x)))
        throw std::invalid_argument(place + ": X(" + std::to_string(i) + ", " + std::to_string(k) + ") is " +
                                    doe::detail::number_text(x) + "; input " + std::to_string(k) +
                                    " is a category; allowed are its levels, whole numbers from 0 to " +
                                    std::to_string(count - 1) + "; give the index of a level");
  }
}

/// Throws std::invalid_argument that begins with `place` where `levels` does not fit d inputs.
inline void check_level_counts(const std::string& place, const std::vector<int>& levels, Index d) {
  if (levels.empty()) return;
  if (static_cast<Index>(levels.size()) != d)
    throw std::invalid_argument(place + ": levels has " + std::to_string(levels.size()) +
                                " entries but X has " + std::to_string(d) +
                                " columns; give one per input, 0 for a number, or none");
  for (std::size_t k = 0; k < levels.size(); ++k)
    if (levels[k] < 0 || levels[k] == 1)
      throw std::invalid_argument(
          place + ": levels[" + std::to_string(k) + "] is " + std::to_string(levels[k]) +
          "; allowed are 0 for a number and 2 or more for a category; count its levels");
}

/// Empty where no input is a category.
inline std::vector<int> categories_of(const std::vector<int>& levels) {
  const bool none = std::all_of(levels.begin(), levels.end(), [](int count) { return count == 0; });
  return none ? std::vector<int>{} : levels;
}

/// Levels of input k without a run, "1, 3"; empty: none.
inline std::string levels_without_runs(const Eigen::MatrixXd& X, const std::vector<int>& levels, Index k) {
  std::string missing;
  for (int level = 0; level < levels[static_cast<std::size_t>(k)]; ++level)
    if (std::count(column(X, k), column(X, k) + X.rows(), static_cast<double>(level)) == 0)
      missing += (missing.empty() ? "" : ", ") + std::to_string(level);
  return missing;
}

}  // namespace drawpoint::kriging::detail
