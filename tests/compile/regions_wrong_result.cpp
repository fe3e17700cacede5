// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a region. Expected bool allowed(const Eigen::VectorXd& x) const
// times: 3

#include <drawpoint/doe/constrained.hpp>
#include <drawpoint/doe/constrained_latin_hypercube.hpp>

using namespace drawpoint;

// Each call has a predicate of its own, for the compiler complains once a type.
void design(const doe::Problem& problem, const Eigen::MatrixXd& X) {
  doe::feasible_sequence(problem, 10, [](const Eigen::VectorXd& x) { return x.norm(); });
  doe::feasible_replacement(problem, X, [](const Eigen::VectorXd& x) { return x.norm(); });
  doe::constrained_latin_hypercube(problem, 10, [](const Eigen::VectorXd& x) { return x.norm(); });
}
