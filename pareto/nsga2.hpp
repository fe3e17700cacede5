// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// NSGA-II with controlled elitism: the trade-offs of any black box, constraints included.
///
/// Deb, Pratap, Agarwal, Meyarivan 2002, "A fast and elitist multiobjective genetic algorithm: NSGA-II":
/// Latin hypercube start, binary tournaments by rank and crowding, simulated binary crossover, polynomial
/// mutation, survival of parents and children by fronts; places by controlled elitism (elitism.hpp), order by
/// constrained dominance (population.hpp), result from an archive of the best points met (archive.hpp). Goals
/// minimize and maximize are objectives, at_most and at_least constraints, record is ignored. A population is
/// one batch: a batch function gets it in one call. Same (black box, problem, options), same result. Cost a
/// generation O(m N log N) for m <= 3, and N evaluations.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/scaling.hpp>
#include <drawpoint/pareto/archive.hpp>
#include <drawpoint/pareto/elitism.hpp>
#include <drawpoint/pareto/variation.hpp>

namespace drawpoint::pareto {

struct Nsga2Options {
  int population = 200;                ///< points a generation, 2 or more; also the most points of the front
  int generations = 300;               ///< after the first population, 0 or more
  double crossover_probability = 0.9;  ///< of a pair of parents, 0 to 1
  double crossover_index = 20.0;       ///< η_c >= 0: larger keeps children nearer to the parents
  double mutation_probability =
      std::numeric_limits<double>::quiet_NaN();  ///< of a variable, 0 to 1; NaN: 1/d
  double mutation_index = 20.0;                  ///< η_m >= 0: larger makes smaller steps
  double elitism_ratio = 0.65;                   ///< r of controlled elitism, 0 <= r < 1; 0 is plain NSGA-II
  doe::Seed seed = 1;
};

enum class SearchStatus { completed, no_feasible_point, all_failed };

struct Front {
  Eigen::MatrixXd X;  ///< n x d, natural units
  Eigen::MatrixXd Y;  ///< n x m objectives, natural units and sign, in the order of the problem's responses
  Eigen::MatrixXd responses;            ///< n x r, all responses at X
  std::vector<std::string> objectives;  ///< names of the columns of Y
  int evaluations = 0, failed = 0;
  SearchStatus status = SearchStatus::completed;
  std::string message;  ///< empty when completed
};

namespace detail {

inline void check_range(const char* name, double value, bool allowed, const char* range) {
  if (!allowed)
    throw std::invalid_argument("pareto::nsga2: " + std::string(name) + " is " +
                                doe::detail::number_text(value) + "; allowed is " + range);
}

inline void check_options(const Nsga2Options& o) {
  const auto probability = [](double p) { return p >= 0.0 && p <= 1.0; };
  check_range("population", o.population, o.population >= 2, "2 or more");
  check_range("generations", o.generations, o.generations >= 0, "0 or more");
  check_range("crossover_probability", o.crossover_probability, probability(o.crossover_probability),
              "0 to 1");
  check_range("crossover_index", o.crossover_index, o.crossover_index >= 0.0, "0 or more");
  check_range("mutation_probability", o.mutation_probability,
              std::isnan(o.mutation_probability) || probability(o.mutation_probability),
              "0 to 1, or NaN for 1/d");
  check_range("mutation_index", o.mutation_index, o.mutation_index >= 0.0, "0 or more");
  check_range("elitism_ratio", o.elitism_ratio, o.elitism_ratio >= 0.0 && o.elitism_ratio < 1.0,
              "0 (plain) to below 1");
}

/// Parents with what the tournament compares: place of the front, then distance.
struct Parents {
  Population points;
  std::vector<int> rank;
  std::vector<double> distance;
};

/// Up to `places` rows of one front, the least crowded first choice, appended to the survivors.
inline void take(const Population& pool, const std::vector<int>& front, int places, int rank,
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

/// The next parents: feasible fronts share the places by controlled elitism, others fill what is left in
/// order.
inline Parents survivors(const Population& pool, const Ranking& ranking, int places, double ratio) {
  std::vector<int> sizes;
  for (std::size_t i = 0; i < ranking.feasible; ++i)
    sizes.push_back(static_cast<int>(ranking.fronts[i].size()));
  std::vector<int> taken = elitist_places(sizes, places, ratio);
  int left = places;
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

inline int tournament(const Parents& parents, doe::RandomStream& random) {
  const int n = static_cast<int>(parents.rank.size());
  const int a = random.below(n), b = random.below(n);
  if (parents.rank[a] != parents.rank[b]) return parents.rank[a] < parents.rank[b] ? a : b;
  return parents.distance[b] > parents.distance[a] ? b : a;
}

inline void mutate(Eigen::Ref<Eigen::VectorXd> child, const Nsga2Options& options,
                   doe::RandomStream& random) {
  const double probability = std::isnan(options.mutation_probability)
                                 ? 1.0 / static_cast<double>(child.size())
                                 : options.mutation_probability;
  for (double& y : child)
    if (random.uniform() < probability) y = polynomial_mutation(y, options.mutation_index, random);
}

/// As many children as parents, n x d in the unit box.
inline Eigen::MatrixXd offspring(const Parents& parents, const Nsga2Options& options,
                                 doe::RandomStream random) {
  const Eigen::Index n = parents.points.size(), d = parents.points.U.cols();
  Eigen::MatrixXd children(d, n + n % 2);  // one a column while they are made
  for (Eigen::Index i = 0; i < n; i += 2) {
    auto first = children.col(i), second = children.col(i + 1);
    first = parents.points.U.row(tournament(parents, random)).transpose();
    second = parents.points.U.row(tournament(parents, random)).transpose();
    if (random.uniform() < options.crossover_probability)
      for (Eigen::Index j = 0; j < d; ++j)
        if (random.uniform() < 0.5) sbx(first[j], second[j], options.crossover_index, random);
    mutate(first, options, random);
    mutate(second, options, random);
  }
  return children.leftCols(n).transpose();
}

/// Evaluates populations and keeps count.
template <class F>
class Evaluator {
 public:
  Evaluator(const F& f, const doe::Problem& problem, doe::Seed seed)
      : f_(f), problem_(problem), seed_(seed) {}

  Population operator()(Eigen::MatrixXd U) {
    std::vector<doe::Seed> seeds;
    for (Eigen::Index i = 0; i < U.rows(); ++i)
      seeds.push_back(doe::run_seed(seed_, static_cast<std::uint64_t>(evaluations_++), 0));
    const auto outcomes = doe::detail::call_batch(f_, problem_, doe::detail::to_natural(U, problem_), seeds);
    for (const doe::Outcome& outcome : outcomes) {
      if (outcome.failed() && failed_++ == 0) first_reason_ = outcome.reason();
    }
    Population population = assess(problem_, std::move(U), outcomes);
    const Eigen::RowVectorXd largest = population.violations.colwise().maxCoeff();
    largest_ = largest_.size() == 0 ? largest : largest_.cwiseMax(largest);
    return population;
  }

  /// By constraint, over all evaluations so far.
  const Eigen::RowVectorXd& largest_violations() const { return largest_; }

  int evaluations() const { return evaluations_; }
  int failed() const { return failed_; }
  const std::string& first_reason() const { return first_reason_; }

 private:
  const F& f_;
  const doe::Problem& problem_;
  doe::Seed seed_;
  int evaluations_ = 0, failed_ = 0;
  std::string first_reason_;
  Eigen::RowVectorXd largest_;
};

/// The archive as the caller wants it, in rising order of the (minimised) objectives.
inline Front to_front(const doe::Problem& problem, const Population& best) {
  const Roles role = roles(problem);
  const std::vector<int> order = sorted_points(best.Y).order;
  Front front;
  front.X = doe::detail::to_natural(best.U(order, Eigen::all), problem);
  front.responses = best.responses(order, Eigen::all);
  front.Y = front.responses(Eigen::all, role.objectives);
  for (const int j : role.objectives) front.objectives.push_back(problem.responses[j].name);
  return front;
}

template <class F>
void report(const Evaluator<F>& evaluate, Front& front) {
  front.evaluations = evaluate.evaluations();
  front.failed = evaluate.failed();
  if (front.X.rows() > 0) return;
  const std::string all = std::to_string(front.evaluations);
  if (front.failed == front.evaluations) {
    front.status = SearchStatus::all_failed;
    front.message = "all " + all + " evaluations failed; the first: " + evaluate.first_reason();
  } else {
    front.status = SearchStatus::no_feasible_point;
    front.message =
        "none of " + all + " evaluations met every limit; relax a limit, widen the bounds or search longer";
  }
}

/// Streams for other purposes than evaluation have their own replicate number, so that no two share a seed.
inline constexpr std::uint64_t start_stream = 1, generation_stream = 2;

template <doe::BlackBox F>
Front search(const F& black_box, const doe::Problem& problem, const Nsga2Options& options) {
  doe::check(problem);
  check_options(options);
  if (roles(problem).objectives.empty())
    throw std::invalid_argument(
        "pareto::nsga2: no response has goal minimize or maximize; give at least one");
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  Evaluator<F> evaluate(black_box, problem, options.seed);
  Archive archive(options.population);
  const doe::Seed start = doe::run_seed(options.seed, 0, start_stream);
  Population pool = evaluate(doe::detail::unit_latin_hypercube(options.population, d, start));
  archive.add(pool);
  for (int generation = 0; generation < options.generations; ++generation) {
    const Ranking ranking = rank(pool, evaluate.largest_violations());
    const Parents parents = survivors(pool, ranking, options.population, options.elitism_ratio);
    const doe::Seed seed =
        doe::run_seed(options.seed, static_cast<std::uint64_t>(generation), generation_stream);
    const Population children = evaluate(offspring(parents, options, doe::RandomStream(seed)));
    archive.add(children);
    pool = joined(parents.points, children);
  }
  Front front = to_front(problem, archive.members());
  report(evaluate, front);
  return front;
}

}  // namespace detail

/// Searches the box of the problem. Throws std::invalid_argument on a faulty problem or option, or without an
/// objective; evaluations that fail are ranked last and counted.
template <class F>
Front nsga2(const F& black_box, const doe::Problem& problem, const Nsga2Options& options = {}) {
  doe::require_black_box<F>();
  if constexpr (doe::BlackBox<F>) {
    return detail::search(black_box, problem, options);
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::pareto
