// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What all searches for a front share: when they stop, what they report, what they return.
///
/// A search stops at the first of
/// * `generations` generations after the first population;
/// * the next generation would need more than `evaluations` evaluations in all;
/// * H(g) - H(g - w) <= stall_gain · H(g), w = stall_generations, H the hypervolume of the best points so far
///   (of the archive where the search has one), with the worst value in each objective of the first
///   population that had a feasible point, plus a tenth of its range, as the reference point;
/// * `progress` returns false.

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/doe/problem.hpp>

namespace drawpoint::pareto {

struct Stopping {
  int generations = 250;      ///< after the first population, 0 or more
  int evaluations = 0;        ///< in all, the first population included; 0: no limit
  int stall_generations = 0;  ///< w, 0 or more; 0: never. 20 to 50 is usual; costs a hypervolume a generation
  double stall_gain = 1e-4;   ///< share of the hypervolume, 0 or more; below it no plot shows the difference
};

/// State after a generation; 0 is the first population.
struct Progress {
  int generation = 0, evaluations = 0, failed = 0;
  int front = 0;                                                  ///< feasible non-dominated points so far
  double hypervolume = std::numeric_limits<double>::quiet_NaN();  ///< H; NaN unless stall_generations > 0
};

/// Called after each generation; returning false stops the search.
using ProgressFunction = std::function<bool(const Progress&)>;

enum class SearchStatus { completed, no_feasible_point, all_failed };
enum class StopReason { generations, evaluations, stall, progress };

struct Front {
  Eigen::MatrixXd X;  ///< n x d, natural units
  Eigen::MatrixXd Y;  ///< n x m objectives, natural units and sign, in the order of the problem's responses
  Eigen::MatrixXd responses;            ///< n x r, all responses at X
  std::vector<std::string> objectives;  ///< names of the columns of Y
  int evaluations = 0, failed = 0, generations = 0;
  StopReason stopped_by = StopReason::generations;
  SearchStatus status = SearchStatus::completed;
  std::string message;  ///< empty when completed
};

namespace detail {

/// Options are refused in the name of the search that they belong to ("pareto::nsga2: ").
inline void check_range(const std::string& place, const char* name, double value, bool allowed,
                        const char* range) {
  if (!allowed)
    throw std::invalid_argument(place + name + " is " + doe::detail::number_text(value) + "; allowed is " +
                                range);
}

inline void check(const std::string& place, const Stopping& s) {
  check_range(place, "generations", s.generations, s.generations >= 0, "0 or more");
  check_range(place, "evaluations", s.evaluations, s.evaluations >= 0, "0 (no limit) or more");
  check_range(place, "stall_generations", s.stall_generations, s.stall_generations >= 0, "0 (never) or more");
  check_range(place, "stall_gain", s.stall_gain, s.stall_gain >= 0.0, "0 or more");
}

}  // namespace detail
}  // namespace drawpoint::pareto
