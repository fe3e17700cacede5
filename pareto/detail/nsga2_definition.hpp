// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Survival of NSGA-II: fronts share the places by the kind of elitism, crowding decides within a front.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <drawpoint/pareto/crowding.hpp>
#include <drawpoint/pareto/detail/compiled.hpp>
#include <drawpoint/pareto/detail/elitism.hpp>
#include <drawpoint/pareto/detail/evolution.hpp>
#include <drawpoint/pareto/nsga2.hpp>

namespace drawpoint::pareto {
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

inline std::unique_ptr<SearchProcess> process_of(const doe::Problem& problem, const Nsga2Options& options) {
  const Setting setting = setting_of(problem, options);
  return std::make_unique<Evolution<FrontSurvival>>(problem, setting,
                                                    FrontSurvival(setting.population, options));
}

}  // namespace detail

DRAWPOINT_PARETO_INLINE Nsga2::Nsga2(const doe::Problem& problem, const Nsga2Options& options)
    : Search(detail::process_of(problem, options)) {}

}  // namespace drawpoint::pareto
