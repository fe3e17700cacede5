// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A black box that never makes a run twice: what a store has is looked up, the rest is run and stored.
///
///     doe::JournalStore store(problem, "runs.csv");
///     const auto f = doe::remembered(simulate, problem, store);
///     pareto::nsga2(f, problem);  // and again tomorrow, without the runs of today
///
/// A run is known by its point and its seed, both exactly. A failed run is remembered too: equal input gives an
/// equal outcome. Unlike a journal of evaluate, which belongs to one design and knows its rows by their
/// numbers, a store serves any number of calls with any points. Missing rows go to a batch function `batch` at
/// a time, each batch stored before the next begins; other black boxes run and store one by one. The store is
/// held by reference and must outlive the black box; calls may come from several threads.

#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/run_journal.hpp>

namespace drawpoint::doe {

/// What keeps runs by point and seed: find gives what add was given last, or nothing.
template <class S>
concept RunStore = requires(S& store, const Eigen::VectorXd& x, Seed seed, const Outcome& outcome) {
  { store.find(x, seed) } -> std::convertible_to<std::optional<Outcome>>;
  store.add(x, seed, outcome);
};

namespace detail {

using RunKey = std::pair<std::vector<double>, Seed>;

inline RunKey run_key(const Eigen::VectorXd& x, Seed seed) { return {{x.begin(), x.end()}, seed}; }

}  // namespace detail

/// Runs in memory, for as long as the program lasts.
class MemoryStore {
 public:
  std::optional<Outcome> find(const Eigen::VectorXd& x, Seed seed) const {
    const auto found = runs_.find(detail::run_key(x, seed));
    return found == runs_.end() ? std::nullopt : std::optional(found->second);
  }
  void add(const Eigen::VectorXd& x, Seed seed, Outcome outcome) {
    runs_.insert_or_assign(detail::run_key(x, seed), std::move(outcome));
  }
  std::size_t size() const { return runs_.size(); }

 private:
  std::map<detail::RunKey, Outcome> runs_;
};

/// Runs in a file (run_journal.hpp), each on disk as it is added.
class JournalStore {
 public:
  /// Throws std::runtime_error as RunJournal does.
  JournalStore(const Problem& problem, std::filesystem::path path) : journal_(problem, std::move(path)) {
    for (const Evaluation& row : journal_.rows()) {
      known_.add(row.x, row.seed, row.outcome);
      next_ = std::max(next_, row.run + 1);
    }
  }

  std::optional<Outcome> find(const Eigen::VectorXd& x, Seed seed) const { return known_.find(x, seed); }
  /// Throws std::runtime_error when the disk refuses.
  void add(const Eigen::VectorXd& x, Seed seed, const Outcome& outcome) {
    journal_.add({.run = next_++, .seed = seed, .x = x, .outcome = outcome});
    known_.add(x, seed, outcome);
  }
  std::size_t size() const { return known_.size(); }

 private:
  RunJournal journal_;
  MemoryStore known_;
  std::int64_t next_ = 0;
};

struct RememberedOptions {
  int batch = 1;  ///< missing rows per call of a batch function, 1 or more: as many as it runs at a time
};

/// What `remembered` returns: a batch function.
template <class F, class Store>
class Remembered {
 public:
  Remembered(F f, Problem problem, Store& store, RememberedOptions options)
      : f_(std::move(f)), problem_(std::move(problem)), store_(&store), options_(options) {
    if (options_.batch < 1)
      throw std::invalid_argument("doe::remembered: batch is " + std::to_string(options_.batch) +
                                  "; allowed is 1 or more");
    detail::check_variables(f_, static_cast<Eigen::Index>(problem_.variables.size()));
  }

  /// Outcomes are those that evaluate would have recorded: what goes wrong in f is a Failure, and stored, but for
  /// a wrong number of values. Throws what the store throws.
  std::vector<Outcome> operator()(const Eigen::MatrixXd& X, std::span<const Seed> seeds) const {
    std::vector<std::optional<Outcome>> known = look_up(X, seeds);
    std::vector<Eigen::Index> missing;
    for (Eigen::Index i = 0; i < X.rows(); ++i)
      if (!known[static_cast<std::size_t>(i)]) missing.push_back(i);
    const auto size = BatchFunction<F> ? static_cast<std::size_t>(options_.batch) : std::size_t{1};
    for (std::size_t from = 0; from < missing.size(); from += size)
      run({missing.data() + from, std::min(size, missing.size() - from)}, X, seeds, known);
    std::vector<Outcome> outcomes;
    for (std::optional<Outcome>& outcome : known) outcomes.push_back(std::move(*outcome));
    return outcomes;
  }

 private:
  std::vector<std::optional<Outcome>> look_up(const Eigen::MatrixXd& X, std::span<const Seed> seeds) const {
    const std::scoped_lock lock(*mutex_);
    std::vector<std::optional<Outcome>> known;
    for (Eigen::Index i = 0; i < X.rows(); ++i)
      known.push_back(store_->find(X.row(i).transpose(), seeds[static_cast<std::size_t>(i)]));
    return known;
  }

  void run(std::span<const Eigen::Index> rows, const Eigen::MatrixXd& X, std::span<const Seed> seeds,
           std::vector<std::optional<Outcome>>& known) const {
    Eigen::MatrixXd part(static_cast<Eigen::Index>(rows.size()), X.cols());
    std::vector<Seed> part_seeds;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      part.row(static_cast<Eigen::Index>(k)) = X.row(rows[k]);
      part_seeds.push_back(seeds[static_cast<std::size_t>(rows[k])]);
    }
    std::vector<Outcome> outcomes = detail::call_batch(f_, problem_, part, part_seeds);
    const std::scoped_lock lock(*mutex_);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (outcomes[k].given() != Outcome::Given::wrong_count)
        store_->add(part.row(static_cast<Eigen::Index>(k)).transpose(), part_seeds[k], outcomes[k]);
      known[static_cast<std::size_t>(rows[k])] = std::move(outcomes[k]);
    }
  }

  F f_;
  Problem problem_;
  Store* store_;
  RememberedOptions options_;
  std::shared_ptr<std::mutex> mutex_ = std::make_shared<std::mutex>();  // copies share it, as the store
};

/// Throws std::invalid_argument for a faulty problem, options out of range and a surrogate of another number of
/// variables.
template <class F, class Store>
Remembered<F, Store> remembered(F f, const Problem& problem, Store& store, RememberedOptions options = {}) {
  require_black_box<F>();
  static_assert(
      RunStore<Store>,
      "drawpoint: not a store of runs. Expected std::optional<Outcome> find(const Eigen::VectorXd& x, "
      "Seed seed) and void add(const Eigen::VectorXd& x, Seed seed, const Outcome& outcome); "
      "doe::MemoryStore and doe::JournalStore are such");
  check(problem);
  return Remembered<F, Store>(std::move(f), problem, store, options);
}

static_assert(RunStore<MemoryStore> && RunStore<JournalStore>);

}  // namespace drawpoint::doe
