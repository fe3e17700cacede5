// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Latin hypercube: in every variable, each of n equal strata holds exactly one run.
///
/// x_ij = (π_j(i) + u_ij) / n, π_j a random permutation (Fisher and Yates) and u_ij uniform in [0, 1), from
/// one random stream, variable by variable. McKay, Beckman, Conover 1979, "A comparison of three methods for
/// selecting values of input variables". With `corners` the 2^d corner points of the box come first, in
/// binary order with the last variable fastest, and the other runs form the Latin hypercube: a surrogate then
/// interpolates up to the corners. Cost O(n d).

#include <Eigen/Core>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/scaling.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

struct LatinHypercubeOptions {
  bool corners = false;  ///< the 2^d corners come first and count in `runs`
  Seed seed = 1;
};

namespace detail {

/// n x d in the unit box.
inline Eigen::MatrixXd unit_latin_hypercube(int n, Eigen::Index d, Seed seed) {
  RandomStream random(seed);
  Eigen::MatrixXd U(n, d);
  std::vector<int> stratum(n);
  for (auto column : U.colwise()) {
    std::iota(stratum.begin(), stratum.end(), 0);
    for (int i = n - 1; i >= 1; --i) std::swap(stratum[i], stratum[random.below(i + 1)]);
    for (int i = 0; i < n; ++i) column[i] = (stratum[i] + random.uniform()) / n;
  }
  return U;
}

/// The 2^d corners of the unit box, d below 31.
inline Eigen::MatrixXd unit_corners(Eigen::Index d) {
  Eigen::MatrixXd U(Eigen::Index{1} << d, d);
  for (Eigen::Index i = 0; i < U.rows(); ++i)
    for (Eigen::Index j = 0; j < d; ++j) U(i, j) = static_cast<double>((i >> (d - 1 - j)) & 1);
  return U;
}

}  // namespace detail

/// runs x d. Throws std::invalid_argument when runs < 1, or when corners are asked for and runs < 2^d.
inline Eigen::MatrixXd latin_hypercube(const Problem& problem, int runs,
                                       const LatinHypercubeOptions& options = {}) {
  detail::check_design("doe::latin_hypercube", problem, runs);
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  if (!options.corners)
    return detail::to_natural(detail::unit_latin_hypercube(runs, d, options.seed), problem);
  if (d > 30 || runs < (1 << d))
    throw std::invalid_argument("doe::latin_hypercube: runs is " + std::to_string(runs) +
                                ", fewer than the 2^" + std::to_string(d) + " corner points of " +
                                std::to_string(d) + " variables; ask for more runs or set corners = false");
  const int corners = 1 << d;
  Eigen::MatrixXd U(runs, d);
  U.topRows(corners) = detail::unit_corners(d);
  U.bottomRows(runs - corners) = detail::unit_latin_hypercube(runs - corners, d, options.seed);
  return detail::to_natural(std::move(U), problem);
}

}  // namespace drawpoint::doe
