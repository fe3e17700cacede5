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
/// function gets it in one call. Same (black box, problem, options), same result. Cost a generation
/// O(m N log N) for m <= 3, and N evaluations.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include <drawpoint/pareto/detail/elitism.hpp>
#include <drawpoint/pareto/detail/evolution.hpp>

namespace drawpoint::pareto {

/// How the places of the next population are shared among the fronts.
enum class Elitism {
  plain,           ///< the best front first, to the last place (Deb's NSGA-II)
  geometric,       ///< front i of K: a share that falls by elitism_ratio from front to front (Deb, Goel 2001)
  pareto_fraction  ///< the best front at most pareto_fraction of the places (Matlab's gamultiobj)
};

struct Nsga2Options {
  int population = 200;  ///< points a generation, 2 or more; also the most points of the front
  Stopping stopping{};
  Variation variation{};
  /// Plain: on five of the six problems of benchmarks/toolkit/pareto_table it has the largest median
  /// hypervolume. Controlled elitism spends places on dominated points, which pays where a front falls into
  /// pieces that a search can lose (docs/pareto.md).
  Elitism elitism = Elitism::plain;
  double elitism_ratio = 0.65;    ///< r of Elitism::geometric, 0 <= r < 1; Deb and Goel's value
  double pareto_fraction = 0.35;  ///< of Elitism::pareto_fraction, 0 < fraction <= 1; gamultiobj's default
  std::vector<int> integers{};    ///< places of the integer variables in Problem::variables
  doe::Seed seed = 1;
  ProgressFunction progress{};
};

namespace detail {

class FrontSurvival {
 public:
  explicit FrontSurvival(const Nsga2Options& options) : options_(options) {}

  /// Feasible fronts share the places by the kind of elitism, others fill what is left in order.
  Parents operator()(const Population& pool, const Ranking& ranking, doe::RandomStream&) const {
    std::vector<int> sizes;
    for (std::size_t i = 0; i < ranking.feasible; ++i)
      sizes.push_back(static_cast<int>(ranking.fronts[i].size()));
    std::vector<int> taken = places(sizes);
    int left = options_.population;
    for (const int count : taken) left -= count;
    for (std::size_t i = ranking.feasible; i < ranking.fronts.size(); ++i) {
      taken.push_back(std::min(left, static_cast<int>(ranking.fronts[i].size())));
      left -= taken.back();
    }
    Parents parents;
    std::vector<int> rows;
    for (std::size_t i = 0; i < taken.size(); ++i)
      take(pool, ranking.fronts[i], taken[i], static_cast<int>(i), i < ranking.feasible, rows, parents);
    parents.points = selected(pool, rows);
    return parents;
  }

 private:
  std::vector<int> places(const std::vector<int>& sizes) const {
    if (options_.elitism == Elitism::geometric)
      return elitist_places(sizes, options_.population, options_.elitism_ratio);
    if (options_.elitism == Elitism::pareto_fraction)
      return fraction_places(sizes, options_.population, options_.pareto_fraction);
    return elitist_places(sizes, options_.population, 0.0);
  }

  /// Up to `places` rows of one front, the least crowded first choice, appended to the survivors.
  static void take(const Population& pool, const std::vector<int>& front, int places, int rank,
                   bool by_crowding, std::vector<int>& rows, Parents& parents) {
    if (places == 0) return;
    Eigen::VectorXd distance = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(front.size()));
    if (by_crowding) distance = crowding_distance(pool.Y(front, Eigen::all));
    for (const int i : least_crowded(distance, places)) {
      rows.push_back(front[i]);
      parents.rank.push_back(rank);
      parents.distance.push_back(distance[i]);
    }
  }

  const Nsga2Options& options_;
};

inline Setting setting_of(const Nsga2Options& o) {
  Setting setting{.place = "pareto::nsga2: ",
                  .population = o.population,
                  .children = o.population,
                  .archive = o.population,
                  .stopping = o.stopping,
                  .variation = o.variation,
                  .integers = o.integers,
                  .seed = o.seed,
                  .progress = o.progress};
  check_range(setting.place, "elitism_ratio", o.elitism_ratio,
              o.elitism_ratio >= 0.0 && o.elitism_ratio < 1.0, "0 (plain) to below 1");
  check_range(setting.place, "pareto_fraction", o.pareto_fraction,
              o.pareto_fraction > 0.0 && o.pareto_fraction <= 1.0, "above 0 to 1");
  return setting;
}

}  // namespace detail

/// Searches the box of the problem. Throws std::invalid_argument on a faulty problem or option, or without an
/// objective; evaluations that fail are ranked last and counted.
template <class F>
Front nsga2(const F& black_box, const doe::Problem& problem, const Nsga2Options& options = {}) {
  doe::require_black_box<F>();
  if constexpr (doe::BlackBox<F>) {
    return detail::evolve(black_box, problem, detail::setting_of(options), detail::FrontSurvival(options));
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::pareto
