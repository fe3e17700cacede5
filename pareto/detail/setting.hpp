// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The options of a search with nothing left open: what the caller did not choose is what the search's
/// authors advise.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/pareto/detail/roles.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto::detail {

/// Random numbers of a search: evaluations have replicate 0 of run_seed, other purposes one each, so that no
/// two share a seed.
inline constexpr std::uint64_t start_stream = 1, generation_stream = 2, survival_stream = 3;

/// Variation of one problem.
struct Rates {
  double crossover_probability = 0.9, crossover_index = 20.0;  // Deb's settings of NSGA-II for real variables
  double mutation_probability = 1.0, mutation_index = 20.0;
};

/// What a search takes where the caller says nothing.
struct Advice {
  int population = 100;
  double crossover_probability = Rates{}.crossover_probability, crossover_index = Rates{}.crossover_index;
};

struct Setting {
  using Named = std::vector<std::pair<std::string, std::string>>;

  std::string place;                 ///< "pareto::nsga2: "
  int population = 0, children = 0;  ///< children per step
  int archive = 0;                   ///< most points; 0: none
  Rates rates{};
  SearchOptions search{};
  Named own{};  ///< options of this search alone that decide the result, name and value
};

inline Rates rates_for(const std::string& place, const Variation& v, const Advice& advice, std::size_t d) {
  const Rates rates{v.crossover_probability.value_or(advice.crossover_probability),
                    v.crossover_index.value_or(advice.crossover_index),
                    v.mutation_probability.value_or(1.0 / static_cast<double>(d)), v.mutation_index};
  const auto check_share = [&](const char* name, double p) {
    check_range(place, name, p, p >= 0.0 && p <= 1.0, "0 to 1");
  };
  check_share("crossover_probability", rates.crossover_probability);
  check_range(place, "crossover_index", rates.crossover_index, rates.crossover_index >= 0.0, "0 or more");
  check_share("mutation_probability", rates.mutation_probability);
  check_range(place, "mutation_index", rates.mutation_index, rates.mutation_index >= 0.0, "0 or more");
  return rates;
}

/// Throws std::invalid_argument on a faulty problem or option, a starting point outside of the box, and
/// without an objective.
inline Setting setting_for(std::string place, const doe::Problem& problem, const SearchOptions& options,
                           const Advice& advice) {
  doe::check(problem);
  Setting setting;
  setting.population = setting.children = options.population.value_or(advice.population);
  check_range(place, "population", setting.population, setting.population >= 2, "2 or more");
  setting.rates = rates_for(place, options.variation, advice, problem.variables.size());
  check(place, options.stopping);
  if (options.start.rows() > 0) doe::detail::check_inside(options.start, problem, place + "start");
  check_range(place, "threads", options.threads, options.threads >= 0, "0 (all cores) or more");
  if (roles(problem).objectives.empty())
    throw std::invalid_argument(place + "no response has goal minimize or maximize; give at least one");
  setting.search = options;
  setting.place = std::move(place);
  return setting;
}

}  // namespace drawpoint::pareto::detail
