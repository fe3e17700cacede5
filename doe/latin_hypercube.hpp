// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Latin hypercube: in every variable, each of n equal strata holds exactly one run.
///
/// x_ij = (π_j(i) + u_ij) / n, π_j a random permutation (Fisher and Yates) and u_ij uniform in [0, 1), from
/// one random stream, variable by variable. McKay, Beckman, Conover 1979, "A comparison of three methods for
/// selecting values of input variables". With `corners` the 2^d corner points of the box come first, in
/// binary order with the last variable fastest, and the other runs form the Latin hypercube: a surrogate then
/// interpolates up to the corners. `centred` puts each run in the middle of its strata, u_ij = 1/2. Integer
/// and categorical variables take each of their values equally often, to within one. Cost O(n d).

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

struct LatinHypercubeOptions {
  Seed seed = 1;
  bool corners = false;  ///< the 2^d corners come first and count in `runs`
  bool centred = false;  ///< u_ij = 1/2: even spacing, but no estimate from it is unbiased
};

namespace detail {

/// n x d in the unit box.
inline Eigen::MatrixXd unit_latin_hypercube(int n, Eigen::Index d, Seed seed) {
  RandomStream random(seed);
  Eigen::MatrixXd U(n, d);
  for (auto column : U.colwise()) {
    const std::vector<int> stratum = permutation(n, random);
    for (int i = 0; i < n; ++i) column[i] = (stratum[i] + random.uniform()) / n;
  }
  return U;
}

/// Each number of U moved to the middle of its stratum of U.rows().
inline Eigen::MatrixXd stratum_centres(Eigen::MatrixXd U) {
  const auto n = static_cast<double>(U.rows());
  for (double& u : U.reshaped()) u = (std::floor(u * n) + 0.5) / n;
  return U;
}

/// The 2^d corners of the unit box, d below 31.
inline Eigen::MatrixXd unit_corners(Eigen::Index d) {
  Eigen::MatrixXd U(Eigen::Index{1} << d, d);
  for (Eigen::Index i = 0; i < U.rows(); ++i)
    for (Eigen::Index j = 0; j < d; ++j) U(i, j) = static_cast<double>((i >> (d - 1 - j)) & 1);
  return U;
}

/// 2^d, or 0 without corners; throws std::invalid_argument when they exceed the runs.
inline int corner_count(const char* place, const Problem& problem, int runs, bool corners) {
  if (!corners) return 0;
  const std::size_t d = problem.variables.size();
  if (d <= 30 && runs >= (1 << d)) return 1 << d;
  throw std::invalid_argument(std::string(place) + ": runs is " + std::to_string(runs) +
                              ", fewer than the 2^" + std::to_string(d) + " corner points of " +
                              std::to_string(d) + " variables; ask for more runs or set corners = false");
}

}  // namespace detail

/// runs x d. Throws std::invalid_argument when runs < 1, or when corners are asked for and runs < 2^d.
inline Eigen::MatrixXd latin_hypercube(const Problem& problem, int runs,
                                       const LatinHypercubeOptions& options = {}) {
  detail::check_design("doe::latin_hypercube", problem, runs);
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  const int corners = detail::corner_count("doe::latin_hypercube", problem, runs, options.corners);
  Eigen::MatrixXd U = detail::unit_latin_hypercube(runs - corners, d, options.seed);
  if (options.centred) U = detail::stratum_centres(std::move(U));
  Eigen::MatrixXd X(runs, d);
  if (corners > 0) X.topRows(corners) = detail::to_natural(detail::unit_corners(d), problem);
  X.bottomRows(runs - corners) = detail::latin_to_natural(std::move(U), problem);
  return X;
}

}  // namespace drawpoint::doe
