// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Where the first runs of a search for the optimum lie.

#include <Eigen/Core>
#include <cstdint>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/detail/optimum_search.hpp>
#include <stdexcept>

namespace drawpoint::kriging::detail {

DRAWPOINT_KRIGING_INLINE Eigen::MatrixXd first_design(const doe::Problem& problem, int runs, doe::Seed seed,
                                                      const doe::Allowed& allowed) {
  Eigen::MatrixXd X = doe::optimized_latin_hypercube(problem, runs, {.seed = seed});
  if (!allowed) return X;
  std::uint64_t counter = 0;
  const Eigen::MatrixXd others =
      doe::detail::allowed_points(problem, allowed, doe::run_seed(seed, 0, 3), runs, counter);
  if (others.rows() < runs)
    throw std::invalid_argument(
        "kriging::optimize: allowed holds at fewer than 1 of 1000 points of the box; narrow the bounds of "
        "the "
        "variables to the allowed part");
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    if (!allowed(X.row(i).transpose())) X.row(i) = others.row(i);
  return X;
}

}  // namespace drawpoint::kriging::detail
