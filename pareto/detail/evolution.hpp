// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The loop of NSGA-II, NSGA-III and SMS-EMOA: start, select, breed, evaluate, join, until the course ends.
///
/// The searches differ in their survival only: from parents and children together it selects the next
/// parents and says what the tournament compares. With an archive the result is the best of all points met,
/// else the best of the last survivors.

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/archive.hpp>
#include <drawpoint/pareto/detail/course.hpp>
#include <drawpoint/pareto/detail/evaluation.hpp>
#include <drawpoint/pareto/detail/variation.hpp>

namespace drawpoint::pareto::detail {

template <class S>
concept Survival = requires(S& survive, const Population& pool, const Ranking& ranking,
                            doe::RandomStream& random) {
  { survive(pool, ranking, random) } -> std::same_as<Parents>;
};

/// The options of a search as the loop needs them.
struct Setting {
  std::string place;                 ///< "pareto::nsga2: "
  int population = 0, children = 0;  ///< children a step
  int archive = 0;                   ///< most points; 0: none
  Stopping stopping{};
  Variation variation{};
  std::vector<int> integers{};
  doe::Seed seed = 1;
  ProgressFunction progress{};
};

inline void check(const Setting& setting, const doe::Problem& problem) {
  doe::check(problem);
  check_range(setting.place, "population", setting.population, setting.population >= 2, "2 or more");
  check(setting.place, setting.variation);
  if (roles(problem).objectives.empty())
    throw std::invalid_argument(setting.place +
                                "no response has goal minimize or maximize; give at least one");
}

/// The best points so far: the archive, or else the first front of the pool.
class Best {
 public:
  explicit Best(int capacity) : archive_(capacity), archived_(capacity > 0) {}

  /// The pool's rows from `first_new` on are new.
  void update(const Population& pool, const Ranking& ranking, int first_new) {
    std::vector<int> rows;
    if (ranking.feasible > 0)
      for (const int i : ranking.fronts.front())
        if (!archived_ || i >= first_new) rows.push_back(i);
    if (!archived_)
      front_ = pool.Y(rows, Eigen::all);
    else
      archive_.add(selected(pool, rows));
  }

  const Eigen::MatrixXd& front() const { return archived_ ? archive_.members().Y : front_; }
  const Archive& archive() const { return archive_; }

 private:
  Archive archive_;
  bool archived_;
  Eigen::MatrixXd front_;
};

template <doe::BlackBox F, Survival S>
class Evolution {
 public:
  Evolution(const F& black_box, const doe::Problem& problem, const Setting& setting, S& survive)
      : problem_(problem),
        setting_(setting),
        survive_(survive),
        space_(setting.place, problem, setting.integers),
        course_(setting.place, setting.stopping, setting.progress, roles(problem).objectives.size()),
        breeder_(space_, setting.variation),
        evaluate_(black_box, problem, space_, setting.seed),
        best_(setting.archive),
        steps_(std::max(1, setting.population / setting.children)) {}

  Front run() {
    Population pool =
        evaluate_(space_.start(setting_.population, doe::run_seed(setting_.seed, 0, start_stream)));
    Eigen::Index first_new = 0;
    for (int step = 0;; ++step) {
      const Ranking ranking = rank(pool, evaluate_.largest_violations());
      best_.update(pool, ranking, static_cast<int>(first_new));
      const bool done = ended(step, pool, ranking);
      if (done && setting_.archive > 0) return result(best_.archive().members(), step);
      doe::RandomStream random(stream(step, survival_stream));
      const Parents parents = survive_(pool, ranking, random);
      if (done) return result(best_of(parents.points), step);
      first_new = parents.size();
      pool = joined(parents.points,
                    evaluate_(breeder_.children(parents, setting_.children,
                                                doe::RandomStream(stream(step, generation_stream)))));
    }
  }

 private:
  doe::Seed stream(int step, std::uint64_t purpose) const {
    return doe::run_seed(setting_.seed, static_cast<std::uint64_t>(step), purpose);
  }

  /// Asked once a generation, which is as many steps as make a population of children.
  bool ended(int step, const Population& pool, const Ranking& ranking) {
    if (step % steps_ != 0) return false;
    Progress now;
    now.generation = step / steps_;
    now.evaluations = evaluate_.evaluations();
    now.failed = evaluate_.failed();
    return course_.done(
        now, best_.front(), [&] { return worst_feasible(pool, ranking); }, steps_ * setting_.children);
  }

  /// By objective.
  static Eigen::RowVectorXd worst_feasible(const Population& pool, const Ranking& ranking) {
    Eigen::RowVectorXd worst = pool.Y.row(ranking.fronts.front().front());
    for (std::size_t k = 0; k < ranking.feasible; ++k)
      for (const int i : ranking.fronts[k]) worst = worst.cwiseMax(pool.Y.row(i)).eval();
    return worst;
  }

  Front result(const Population& best, int step) const {
    Front front = to_front(problem_, space_, best, evaluate_);
    front.generations = step / steps_;
    front.stopped_by = course_.reason();
    return front;
  }

  const doe::Problem& problem_;
  const Setting& setting_;
  S& survive_;
  SearchSpace space_;
  Course course_;
  Breeder breeder_;
  Evaluator<F> evaluate_;
  Best best_;
  int steps_;  // that make a generation
};

template <doe::BlackBox F, Survival S>
Front evolve(const F& black_box, const doe::Problem& problem, const Setting& setting, S survive) {
  check(setting, problem);
  return Evolution<F, S>(black_box, problem, setting, survive).run();
}

}  // namespace drawpoint::pareto::detail
