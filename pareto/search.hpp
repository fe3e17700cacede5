// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What all searches for a front share: their options, what they report, what they return.
///
/// A search stops at the first of
/// * `generations` generations after the first population;
/// * the next generation would need more than `evaluations` evaluations in all;
/// * H(g) - H(g - w) <= stall_gain · H(g), w = stall_generations, H the hypervolume of the best points so far
///   (of the archive where the search has one), with the worst value in each objective of the first
///   population that had a feasible point, plus a tenth of its range, as the reference point;
/// * `stop` is requested: no evaluation is begun any more, a population that is not complete is dropped, and
///   the front is that of the populations before.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::pareto {

struct Stopping {
  int generations = 250;             ///< after the first population, 0 or more
  std::optional<int> evaluations{};  ///< in all, the first population included, 1 or more; none: no limit
  /// w, 1 or more; none: never. 20 to 50 is usual. Costs a hypervolume per generation.
  std::optional<int> stall_generations{};
  double stall_gain = 1e-4;  ///< share of the hypervolume, 0 or more; below it no plot shows the difference
};

/// How children come from parents (detail/variation.hpp). None: what the search's authors advise.
struct Variation {
  std::optional<double> crossover_probability{};  ///< of a pair of parents, 0 to 1
  std::optional<double> crossover_index{};        ///< η_c >= 0: larger keeps children nearer to the parents
  std::optional<double> mutation_probability{};  ///< of a variable, 0 to 1; none: 1/d, one variable per child
  double mutation_index = 20.0;                  ///< η_m >= 0: larger makes smaller steps; Deb's value
};

/// State after a generation; 0 is the first population.
struct SearchProgress {
  int generation = 0, evaluations = 0, failed = 0;
  int front = 0;                        ///< feasible non-dominated points so far
  std::optional<double> hypervolume{};  ///< H; none unless stall_generations is given
};

struct SearchOptions {
  /// Points per generation, 2 or more; also the most points of the front. None: 200 for NSGA-II, 100 for the
  /// others.
  std::optional<int> population{};
  /// k x d, natural units: points that the first population begins with, such as the best runs so far or the
  /// front of an earlier search. Fewer than the population: a Latin hypercube fills up. More: all of them are
  /// the first population, and the search keeps those that it ranks best. None: a Latin hypercube alone.
  Eigen::MatrixXd start{};
  Stopping stopping{};
  Variation variation{};
  doe::Seed seed = 1;
  /// Evaluations at once, 1 or more; 0: as many as the machine has cores. The result has the same bits for
  /// every number. A batch function gets each population in one call and ignores it.
  int threads = 1;
  std::stop_token stop{};                                 ///< requested: the search ends as said above
  std::function<void(const SearchProgress&)> progress{};  ///< called after each generation
};

enum class SearchStatus {
  completed,
  no_feasible_point,  ///< no evaluation met every limit
  all_failed,         ///< no evaluation gave values
  nothing_evaluated   ///< stopped before the first population was complete
};

enum class StopReason {
  generations,
  evaluations,
  stall,
  stopped  ///< by the token; also of a front that is asked for before the end
};

inline std::string_view to_string(SearchStatus status) {
  switch (status) {
    case SearchStatus::completed:
      return "completed";
    case SearchStatus::no_feasible_point:
      return "no_feasible_point";
    case SearchStatus::all_failed:
      return "all_failed";
    case SearchStatus::nothing_evaluated:
      return "nothing_evaluated";
  }
  return "unknown";
}

inline std::string_view to_string(StopReason reason) {
  switch (reason) {
    case StopReason::generations:
      return "generations";
    case StopReason::evaluations:
      return "evaluations";
    case StopReason::stall:
      return "stall";
    case StopReason::stopped:
      return "stopped";
  }
  return "unknown";
}

struct Front {
  Eigen::MatrixXd X;  ///< n x d, natural units
  Eigen::MatrixXd Y;  ///< n x m objectives, natural units and sign, in the order of the problem's responses
  Eigen::MatrixXd responses;            ///< n x r, all responses at X
  std::vector<std::string> objectives;  ///< names of the columns of Y
  int evaluations = 0, failed = 0, generations = 0;
  StopReason stopped_by = StopReason::generations;
  SearchStatus status = SearchStatus::completed;
  std::string message;  ///< empty when completed and at most 2 % of the evaluations failed
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
  const int evaluations = s.evaluations.value_or(1), window = s.stall_generations.value_or(1);
  check_range(place, "evaluations", evaluations, evaluations >= 1, "1 or more; leave it out for no limit");
  check_range(place, "stall_generations", window, window >= 1, "1 or more; leave it out for never");
  check_range(place, "stall_gain", s.stall_gain, s.stall_gain >= 0.0, "0 or more");
}

}  // namespace detail
}  // namespace drawpoint::pareto
