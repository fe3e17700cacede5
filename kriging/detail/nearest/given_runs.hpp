// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What fit_nearest is given: what is refused, and the order that its runs get.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/detail/training_data.hpp>
#include <drawpoint/kriging/nearest_model.hpp>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::kriging::detail {

inline void check_count(const std::string& name, int count, int least, int most) {
  if (count < least || count > most)
    throw std::invalid_argument("kriging::fit_nearest: " + name + " is " + std::to_string(count) +
                                "; allowed are " + std::to_string(least) + " to " + std::to_string(most) +
                                "; use the default");
}

inline void check_nearest(const NearestOptions& nearest, const FitOptions& options) {
  check_count("neighbours", nearest.neighbours, 8, 4000);
  check_count("neighbourhood", nearest.neighbourhood, 8, 4000);
  if (options.structure == Structure::additive)
    throw std::invalid_argument(
        "kriging::fit_nearest: structure is additive; allowed are product and isotropic, since in a sum far "
        "runs "
        "tell as much as near ones; choose one of them");
  if (options.trend == Trend::blind)
    throw std::invalid_argument(
        "kriging::fit_nearest: trend is blind; allowed are constant, linear, quadratic and user; use "
        "quadratic");
}

/// All that can be wrong with what fit_nearest is given, rows named as they were given.
inline void check_fit_nearest(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const FitOptions& options,
                              const NearestOptions& nearest) {
  check_nearest(nearest, options);
  check_runs(X, y);
  check_options(options, X.cols());
  check_noise(options, X.rows());
  require_levels("kriging::fit_nearest", X, options.levels);
}

/// More than half of a run's neighbours at its own point would tell nothing of the response elsewhere.
inline void check_repeats(const std::vector<std::vector<Index>>& sites, int neighbours) {
  for (const std::vector<Index>& site : sites)
    if (2 * static_cast<int>(site.size()) > std::max(neighbours, 2))
      throw std::invalid_argument("kriging::fit_nearest: " + std::to_string(site.size()) +
                                  " runs stand at the point of run " + std::to_string(site.front()) +
                                  "; allowed are half of neighbours, " + std::to_string(neighbours / 2) +
                                  "; average them with kriging::replicates, or raise neighbours");
}

/// Rows by their inputs, responses and noise, so that no order of the rows is better than another; then at
/// random.
inline std::vector<Index> order_of(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                                   const Eigen::VectorXd& noise, doe::Seed seed) {
  std::vector<Index> sorted(static_cast<std::size_t>(X.rows()));
  std::iota(sorted.begin(), sorted.end(), Index{0});
  const auto before = [&](Index a, Index b) {
    for (Index k = 0; k < X.cols(); ++k)
      if (X(a, k) != X(b, k)) return X(a, k) < X(b, k);
    if (y[a] != y[b]) return y[a] < y[b];
    return noise.size() > 0 && noise[a] < noise[b];
  };
  std::stable_sort(sorted.begin(), sorted.end(), before);
  doe::RandomStream random(seed);
  doe::detail::shuffle(sorted, random);
  return sorted;
}

}  // namespace drawpoint::kriging::detail
