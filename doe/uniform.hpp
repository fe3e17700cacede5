// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Independent uniform points in the box of a problem: the plainest design, for validation sets and for
/// comparison. Run after run from one stream, so that the first n rows of a longer design are the design of n
/// runs. Cost O(n d).

#include <Eigen/Core>
#include <utility>

#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

struct UniformOptions {
  Seed seed = 1;
};

/// runs x d. Throws std::invalid_argument when runs < 1.
inline Eigen::MatrixXd uniform_random(const Problem& problem, int runs, const UniformOptions& options = {}) {
  detail::check_design("doe::uniform_random", problem, runs);
  RandomStream random(options.seed);
  Eigen::MatrixXd U(runs, static_cast<Eigen::Index>(problem.variables.size()));
  for (auto row : U.rowwise())
    for (double& u : row) u = random.uniform();
  return detail::to_natural(std::move(U), problem);
}

}  // namespace drawpoint::doe
