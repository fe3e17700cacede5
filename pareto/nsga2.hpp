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

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
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
  SearchOptions search{};
  /// Plain: on five of the six problems of benchmarks/toolkit/pareto_table it has the largest median
  /// hypervolume. Controlled elitism spends places on dominated points, which pays where a front falls into
  /// pieces that a search can lose (docs/pareto.md).
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

namespace detail {

class FrontSurvival {
 public:
  FrontSurvival(int population, const Nsga2Options& options)
      : population_(population),
        elitism_(options.elitism),
        ratio_(options.elitism_ratio),
        fraction_(options.pareto_fraction) {}

  /// Feasible fronts share the places by the kind of elitism, others fill what is left in order.
  Survivors operator()(const Population& pool, const Ranking& ranking, doe::RandomStream&) const {
    std::vector<int> sizes;
    for (std::size_t i = 0; i < ranking.feasible; ++i)
      sizes.push_back(static_cast<int>(ranking.fronts[i].size()));
    std::vector<int> taken = places(sizes);
    int left = population_;
    for (const int count : taken) left -= count;
    for (std::size_t i = ranking.feasible; i < ranking.fronts.size(); ++i) {
      taken.push_back(std::min(left, static_cast<int>(ranking.fronts[i].size())));
      left -= taken.back();
    }
    Survivors survivors;
    for (std::size_t i = 0; i < taken.size(); ++i)
      take(pool, ranking.fronts[i], taken[i], static_cast<int>(i), i < ranking.feasible, survivors);
    return survivors;
  }

 private:
  std::vector<int> places(const std::vector<int>& sizes) const {
    if (elitism_ == Elitism::geometric) return elitist_places(sizes, population_, ratio_);
    if (elitism_ == Elitism::pareto_fraction) return fraction_places(sizes, population_, fraction_);
    return elitist_places(sizes, population_, 0.0);
  }

  /// Up to `places` rows of one front, the least crowded first choice, appended to the survivors.
  static void take(const Population& pool, const std::vector<int>& front, int places, int rank,
                   bool by_crowding, Survivors& survivors) {
    if (places == 0) return;
    Eigen::VectorXd distance = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(front.size()));
    if (by_crowding) distance = crowding_distance(pool.Y(front, Eigen::all));
    for (const int i : least_crowded(distance, places)) {
      survivors.rows.push_back(front[i]);
      survivors.rank.push_back(rank);
      survivors.distance.push_back(distance[i]);
    }
  }

  int population_;
  Elitism elitism_;
  double ratio_, fraction_;
};

inline Setting setting_of(const doe::Problem& problem, const Nsga2Options& o) {
  Setting setting = setting_for("pareto::nsga2: ", problem, o.search, {.population = 200});
  check_range(setting.place, "elitism_ratio", o.elitism_ratio,
              o.elitism_ratio >= 0.0 && o.elitism_ratio < 1.0, "0 (plain) to below 1");
  check_range(setting.place, "pareto_fraction", o.pareto_fraction,
              o.pareto_fraction > 0.0 && o.pareto_fraction <= 1.0, "above 0 to 1");
  setting.archive = setting.population;
  setting.own = {{"elitism", std::string(to_string(o.elitism))},
                 {"elitism_ratio", doe::detail::number_text(o.elitism_ratio)},
                 {"pareto_fraction", doe::detail::number_text(o.pareto_fraction)}};
  return setting;
}

}  // namespace detail

/// Searches the box of the problem, driven from outside (ask_and_tell.hpp). Throws std::invalid_argument on a
/// faulty problem or option, or without an objective.
class Nsga2 : public detail::Evolution<detail::FrontSurvival> {
 public:
  explicit Nsga2(const doe::Problem& problem, const Nsga2Options& options = {})
      : Nsga2(problem, options, detail::setting_of(problem, options)) {}

 private:
  Nsga2(const doe::Problem& problem, const Nsga2Options& options, const detail::Setting& setting)
      : Evolution(problem, setting, detail::FrontSurvival(setting.population, options)) {}
};

/// The same on a black box, to the end. Evaluations that fail are ranked last and counted.
template <class F>
Front nsga2(const F& black_box, const doe::Problem& problem, const Nsga2Options& options = {}) {
  doe::require_black_box<F>();
  if constexpr (doe::BlackBox<F>) {
    Nsga2 search(problem, options);
    return finish(search, black_box);
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::pareto
