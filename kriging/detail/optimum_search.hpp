// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The steps of a search for the optimum that know the runs and not the simulator: where the first runs lie
/// (first_design.hpp), where the next one goes (next_run.hpp), what was found (optimum_found.hpp).

#include <Eigen/Core>
#include <cstdint>
#include <drawpoint/doe/allowed.hpp>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/detail/compiled.hpp>
#include <optional>
#include <vector>

namespace drawpoint::kriging {

/// A point with its responses, in the order and the units of the problem.
struct OptimalPoint {
  std::int64_t run = -1;   ///< of the table; −1: the models expect it, no run was made there
  Eigen::VectorXd x = {};  ///< d, natural units
  Eigen::VectorXd y = {};  ///< of an exact simulator what the run gave, else the response without its noise
  /// Between which y lies with a probability of 95 %, by the models. Both are y for an exact simulator's run,
  /// and for a recorded response, which has no model.
  Eigen::VectorXd lower = {}, upper = {};
};

namespace detail {

/// What the next run is chosen by.
struct NextRun {
  doe::Seed seed = 1;
  doe::Allowed allowed = {};
  std::int64_t after_first = 0;  ///< runs begun after the first design
  std::int64_t left = 1;         ///< runs to begin, this one included
};

struct OptimumFound {
  std::vector<OptimalPoint> best;
  std::optional<OptimalPoint> expected;
  bool feasible = false, exact = false;
};

/// A Latin hypercube in the allowed part of the box: rows elsewhere give way to random ones.
Eigen::MatrixXd first_design(const doe::Problem& problem, int runs, doe::Seed seed,
                             const doe::Allowed& allowed);

/// The point of the next run; nothing where every point has been run. ended: the runs so far; pending: k x d.
std::optional<Eigen::VectorXd> next_run(const doe::Evaluations& ended, const Eigen::MatrixXd& pending,
                                        const NextRun& by);

OptimumFound optimum_found(const doe::Evaluations& runs, const NextRun& by);

}  // namespace detail
}  // namespace drawpoint::kriging
