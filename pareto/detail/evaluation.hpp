// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// From points of the unit box to evaluated populations, and from those to the front that a caller gets.
///
/// A population is one batch: a batch function gets it in one call. Each evaluation has its own seed, made
/// from the search's seed and its number. Runs that fail are counted and ranked last.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/pareto/detail/population.hpp>
#include <drawpoint/pareto/detail/search_space.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto::detail {

/// Streams for other purposes than evaluation have their own replicate number, so that no two share a seed.
inline constexpr std::uint64_t start_stream = 1, generation_stream = 2, survival_stream = 3;

template <class F>
class Evaluator {
 public:
  Evaluator(const F& f, const doe::Problem& problem, const SearchSpace& space, doe::Seed seed)
      : f_(f), problem_(problem), space_(space), seed_(seed) {}

  Population operator()(Eigen::MatrixXd U) {
    std::vector<doe::Seed> seeds;
    for (Eigen::Index i = 0; i < U.rows(); ++i)
      seeds.push_back(doe::run_seed(seed_, static_cast<std::uint64_t>(evaluations_++), 0));
    const auto outcomes = doe::detail::call_batch(f_, problem_, space_.natural(U), seeds);
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
  const SearchSpace& space_;
  doe::Seed seed_;
  int evaluations_ = 0, failed_ = 0;
  std::string first_reason_;
  Eigen::RowVectorXd largest_;
};

/// Without a feasible point: why there is none.
template <class F>
void explain(const Evaluator<F>& evaluate, Front& front) {
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

/// The points of `best` in rising order of the (minimised) objectives, in natural units.
template <class F>
Front to_front(const doe::Problem& problem, const SearchSpace& space, const Population& best,
               const Evaluator<F>& evaluate) {
  const Roles role = roles(problem);
  const std::vector<int> order = sorted_points(best.Y).order;
  Front front;
  front.X = space.natural(best.U(order, Eigen::all));
  front.responses = best.responses(order, Eigen::all);
  front.Y = front.responses(Eigen::all, role.objectives);
  for (const int j : role.objectives) front.objectives.push_back(problem.responses[j].name);
  front.evaluations = evaluate.evaluations();
  front.failed = evaluate.failed();
  explain(evaluate, front);
  return front;
}

/// The feasible points that no other point of the population dominates.
inline Population best_of(const Population& population) {
  std::vector<int> feasible;
  for (int i = 0; i < static_cast<int>(population.size()); ++i)
    if (population.feasible(i)) feasible.push_back(i);
  std::vector<int> rows = non_dominated(population.Y(feasible, Eigen::all));
  for (int& i : rows) i = feasible[i];
  return selected(population, rows);
}

}  // namespace drawpoint::pareto::detail
