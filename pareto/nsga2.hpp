// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// NSGA-II: the trade-offs of any black box, constraints included.
///
/// Deb, Pratap, Agarwal, Meyarivan 2002, "A fast and elitist multiobjective genetic algorithm: NSGA-II":
/// Latin hypercube start, binary tournaments by rank and crowding, simulated binary crossover, polynomial
/// mutation, survival of parents and children by fronts, the last one by crowding; order by constrained
/// dominance (population.hpp). Two departures: survivors may be chosen by controlled elitism (elitism.hpp),
/// and the result comes from an archive of the best points met (archive.hpp). Goals minimize and maximize are
/// objectives, at_most and at_least constraints, record is ignored. A population is one batch: a batch
/// function gets it in one call. Same (black box, problem, options), same result. Cost per generation
/// O(m N log N) for m <= 3, and N evaluations.

#include <string_view>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/pareto/ask_and_tell.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto {

/// How the places of the next population are shared among the fronts.
enum class Elitism {
  plain,           ///< the best front first, to the last place (Deb's NSGA-II)
  geometric,       ///< front i of K: a share that falls by elitism_ratio from front to front (Deb, Goel 2001)
  pareto_fraction  ///< the best front at most pareto_fraction of the places (Matlab's gamultiobj)
};

struct Nsga2Options {
  SearchOptions search{};
  /// Plain: on five of the six problems of benchmarks/toolkit/pareto_table it has the largest median
  /// hypervolume. Controlled elitism spends places on dominated points, which pays where a front falls into
  /// pieces that a search can lose (docs/explanation/pareto.md).
  Elitism elitism = Elitism::plain;
  double elitism_ratio = 0.65;    ///< r of Elitism::geometric, 0 <= r < 1; Deb and Goel's value
  double pareto_fraction = 0.35;  ///< of Elitism::pareto_fraction, 0 < fraction <= 1; gamultiobj's default
};

inline std::string_view to_string(Elitism elitism) {
  switch (elitism) {
    case Elitism::plain:
      return "plain";
    case Elitism::geometric:
      return "geometric";
    case Elitism::pareto_fraction:
      return "pareto_fraction";
  }
  return "unknown";
}

/// Searches the box of the problem, driven from outside (ask_and_tell.hpp). Throws std::invalid_argument on a
/// faulty problem or option, or without an objective.
class Nsga2 : public Search {
 public:
  explicit Nsga2(const doe::Problem& problem, const Nsga2Options& options = {});
};

/// The same on a black box, to the end. Evaluations that fail are ranked last and counted.
template <class F>
Front nsga2(const F& black_box, const doe::Problem& problem, const Nsga2Options& options = {}) {
  Nsga2 search(problem, options);
  return finish(search, black_box);
}

}  // namespace drawpoint::pareto

#ifndef DRAWPOINT_PARETO_COMPILED
#include <drawpoint/pareto/detail/nsga2_definition.hpp>
#endif
