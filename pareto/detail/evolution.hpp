// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The step of NSGA-II, NSGA-III and SMS-EMOA: join parents and children, select, breed.
///
/// The searches differ in their survival only: from parents and children together it selects the next
/// parents and says what the tournament compares. With an archive the result is the best of all points met,
/// else the best of the last survivors.

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/archive.hpp>
#include <drawpoint/pareto/detail/newcomer.hpp>
#include <drawpoint/pareto/detail/search_process.hpp>

namespace drawpoint::pareto::detail {

/// Rows of a pool, and what the tournament compares of each (variation.hpp).
struct Survivors {
  std::vector<int> rows, rank;
  std::vector<double> distance;
};

template <class S>
concept Survival = requires(S& survive, const Population& pool, const Ranking& ranking,
                            doe::RandomStream& random) {
  { survive(pool, ranking, random) } -> std::same_as<Survivors>;
};

template <Survival S>
class Evolution : public SearchProcess {
 public:
  Evolution(const doe::Problem& problem, const Setting& setting, S survive)
      : SearchProcess(problem, setting), survive_(std::move(survive)), archive_(setting.archive) {}

  std::unique_ptr<SearchProcess> copy() const override { return std::make_unique<Evolution>(*this); }

 private:
  Eigen::MatrixXd next(Population told) override {
    const int step = step_++;
    const auto first_new = static_cast<int>(parents_.size());
    const Population pool = step == 0 ? std::move(told) : joined(parents_, told);
    const Ranking ranking = parents_ranking_ ? rank_with_newcomer(pool, std::move(*parents_ranking_))
                                             : rank(pool, largest_violations());
    if (archived()) archive_.add(pool, first_front(ranking, first_new));
    if (step % steps() == 0) close(step, pool, ranking);
    doe::RandomStream random(stream(step, survival_stream));
    Survivors survivors = survive_(pool, ranking, random);
    parents_ranking_.reset();
    if (setting().children == 1)
      parents_ranking_ = ranking_of_survivors(ranking, survivors.rows, pool.size());
    if (!are_the_old(survivors.rows, first_new)) parents_ = selected(pool, survivors.rows);
    return breeder().children({parents_, std::move(survivors.rank), std::move(survivors.distance)},
                              setting().children, doe::RandomStream(stream(step, generation_stream)));
  }

  Population best() const override { return archived() ? archive_.members() : best_of(parents_); }

  bool archived() const { return setting().archive > 0; }

  /// The old parents, all of them in their order.
  static bool are_the_old(const std::vector<int>& rows, int first_new) {
    for (int i = 0; i < static_cast<int>(rows.size()); ++i)
      if (rows[static_cast<std::size_t>(i)] != i) return false;
    return static_cast<int>(rows.size()) == first_new;
  }

  /// Feasible rows of the pool that nothing dominates, from `first_new` on.
  static std::vector<int> first_front(const Ranking& ranking, int first_new) {
    std::vector<int> rows;
    if (ranking.feasible > 0)
      for (const int i : ranking.fronts.front())
        if (i >= first_new) rows.push_back(i);
    return rows;
  }

  /// A generation is as many steps as make a population of children.
  void close(int step, const Population& pool, const Ranking& ranking) {
    const Eigen::MatrixXd front =
        archived() ? archive_.members().Y : Eigen::MatrixXd(pool.Y(first_front(ranking, 0), Eigen::all));
    close_generation(step / steps(), front, [&] { return worst_feasible(pool, ranking); });
  }

  /// By objective.
  static Eigen::RowVectorXd worst_feasible(const Population& pool, const Ranking& ranking) {
    Eigen::RowVectorXd worst = pool.Y.row(ranking.fronts.front().front());
    for (std::size_t k = 0; k < ranking.feasible; ++k)
      for (const int i : ranking.fronts[k]) worst = worst.cwiseMax(pool.Y.row(i)).eval();
    return worst;
  }

  void write(CheckpointWriter& out) const override { fields(*this, out); }
  void read(CheckpointReader& in) override {
    fields(*this, in);
    parents_ranking_.reset();
  }

  template <class Self, class Stream>
  static void fields(Self& self, Stream& stream) {
    stream.item("step", self.step_);
    stream.item("parents", self.parents_);
    Archive::fields(self.archive_, stream);
    if constexpr (requires { S::fields(self.survive_, stream); }) S::fields(self.survive_, stream);
  }

  S survive_;
  Archive archive_;
  Population parents_;
  int step_ = 0;  // the next one's number
  std::optional<Ranking>
      parents_ranking_;  // with one child per step, where all parents are feasible and it is known
};

}  // namespace drawpoint::pareto::detail
