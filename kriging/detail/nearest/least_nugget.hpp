// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What the diagonal of a block needs beyond 1, so that it can be factored whatever its points and length
/// scales.
///
/// Cholesky's factorisation of a matrix of k rows with ones on its diagonal succeeds where the least
/// eigenvalue, here the nugget or more, is above k γ_{k+1}, γ_k = k u/(1 − k u), u = 2⁻⁵³: 9e-12 for 400
/// rows. The limit is twice that, for the round-off of the correlations themselves, a few u each, k of them
/// in a row. Source: Higham 2002, "Accuracy and Stability of Numerical Algorithms", theorem 10.7.

#include <Eigen/Core>
#include <algorithm>
#include <drawpoint/kriging/detail/least_squares.hpp>
#include <limits>

namespace drawpoint::kriging::detail {

/// λ of blocks of k rows, at least.
inline double least_nugget(Index k) {
  const auto rows = static_cast<double>(k);
  return rows * (rows + 1.0) * std::numeric_limits<double>::epsilon();
}

/// What is added beside noise that runs report, which may be 0; without such λ itself is bounded.
inline double block_floor(bool reported, Index k) {
  return reported ? std::max(noise_floor, least_nugget(k)) : 0.0;
}

}  // namespace drawpoint::kriging::detail
