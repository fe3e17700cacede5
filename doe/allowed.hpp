// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The part of the box in which runs may be made, and points that are uniform in it.

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

/// Whether a point (natural units) may be run; empty: everywhere.
using Allowed = std::function<bool(const Eigen::VectorXd&)>;

namespace detail {

/// Draws `count` rows after the draw `counter` (which moves on), uniform in the part of the problem's box
/// that is allowed, natural units. Fewer rows when `count` · 1000 draws were not enough.
inline Eigen::MatrixXd allowed_points(const Problem& problem, const Allowed& allowed, Seed seed,
                                      Eigen::Index count, std::uint64_t& counter) {
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  Eigen::MatrixXd X(count, d);
  Eigen::Index kept = 0;
  for (Eigen::Index tries = 0; kept < count && tries < 1000 * count; ++tries, ++counter) {
    RandomStream random(run_seed(seed, counter, 0));
    Eigen::RowVectorXd u(d);
    for (double& value : u) value = random.uniform();
    X.row(kept) = to_natural(Eigen::MatrixXd(u), problem);
    kept += !allowed || allowed(X.row(kept).transpose());
  }
  X.conservativeResize(kept, d);
  return X;
}

}  // namespace detail

}  // namespace drawpoint::doe
