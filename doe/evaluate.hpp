// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Evaluates a black box at every row of a design, several runs at once, each as often as `replicates` says.
///
/// Row i, replicate k of a design has seed run_seed(options.seed, first_run + i, k) and place i·replicates +
/// k in the table: the result does not depend on the number of threads nor on which run ends first. Failed
/// runs are rows like the others. A batch function gets all rows, or batch_size rows, in one call on the
/// calling thread and does its own sharing out. With a journal each run is on disk as it ends and is not made
/// again by the next call; so the same line serves a formula and a simulator of an hour.

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/detail/threads.hpp>
#include <drawpoint/doe/detail/watchdog.hpp>
#include <drawpoint/doe/evaluate_options.hpp>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/doe/run_journal.hpp>

namespace drawpoint::doe {

namespace detail {

inline void check_count(const char* name, std::int64_t value, std::int64_t lowest) {
  if (value < lowest)
    throw std::invalid_argument("doe::evaluate: " + std::string(name) + " is " + std::to_string(value) +
                                "; allowed is " + std::to_string(lowest) + " or more");
}

inline void check_options(const EvaluateOptions& options) {
  check_count("threads", options.threads, 0);
  check_count("replicates", options.replicates, 1);
  check_count("first_run", options.first_run, 0);
  check_count("batch_size", options.batch_size.value_or(1), 1);
  if (!(options.time_limit > 0.0))
    throw std::invalid_argument("doe::evaluate: time_limit is " + number_text(options.time_limit) +
                                " s; allowed is a time above 0 s; leave it out for no limit");
}

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The table with everything but outcomes and times.
inline Evaluations planned(const Problem& problem, const Eigen::MatrixXd& X, const EvaluateOptions& options) {
  Evaluations table{problem, {}};
  table.rows.reserve(static_cast<std::size_t>(X.rows()) * static_cast<std::size_t>(options.replicates));
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    for (int k = 0; k < options.replicates; ++k) {
      const std::int64_t run = options.first_run + i;
      const std::uint64_t stream = options.common_random_numbers ? 0 : static_cast<std::uint64_t>(run);
      const Seed seed = run_seed(options.seed, stream, static_cast<std::uint64_t>(k));
      table.rows.push_back({run, k, seed, X.row(i), Outcome(), 0.0});
    }
  return table;
}

/// The table as it fills: which rows are done, which are still to run, and who is told of each that ends.
class RunBook {
 public:
  RunBook(Evaluations& table, const EvaluateOptions& options)
      : table_(table), options_(options), done_(table.rows.size(), 0) {
    progress_.total = static_cast<std::int64_t>(table.rows.size());
    if (!options.journal.empty()) journal_ = std::make_unique<RunJournal>(table.problem, options.journal);
    for (std::size_t i = 0; i < done_.size(); ++i) recall(i);
    remembered_ = progress_.done;
  }

  const std::vector<std::size_t>& to_run() const { return to_run_; }
  bool stopped() const { return halted_ || options_.stop.stop_requested(); }

  /// The outcome of row i is in place. One call at a time; the first exception of a callback or of the
  /// journal stops the study.
  void ended(std::size_t i) {
    const std::scoped_lock lock(mutex_);
    if (fault_) return;
    try {
      done_[i] = 1;
      look_at_first_values();
      if (journal_ && table_.rows[i].outcome.given() != Outcome::Given::wrong_count)
        journal_->add(table_.rows[i]);
      count(i);
      if (options_.on_result) options_.on_result(table_.rows[i]);
      if (options_.progress) options_.progress(timed_progress());
    } catch (...) {
      fault_ = std::current_exception();
      halted_ = true;
    }
  }

  /// Passes a fault on, else leaves the rows that were done.
  void close() {
    if (fault_) std::rethrow_exception(fault_);
    if (progress_.done == progress_.total) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < done_.size(); ++i) {
      if (!done_[i]) continue;
      if (kept != i) table_.rows[kept] = std::move(table_.rows[i]);
      ++kept;
    }
    table_.rows.resize(kept);
  }

 private:
  // Checks the outcomes of the rows to run, in their order, up to the first row that is not done.
  void look_at_first_values() {
    for (; looked_at_ < to_run_.size() && done_[to_run_[looked_at_]]; ++looked_at_)
      first_values_.take(table_.rows[to_run_[looked_at_]].outcome, "doe::evaluate");
  }

  void count(std::size_t i) {
    ++progress_.done;
    progress_.failed += table_.rows[i].outcome.failed();
  }

  void recall(std::size_t i) {
    const Evaluation* known = journal_ ? journal_->find(table_.rows[i]) : nullptr;
    if (!known) return to_run_.push_back(i);
    table_.rows[i] = *known;
    done_[i] = 1;
    first_values_.take(known->outcome, "doe::evaluate");
    count(i);
  }

  const EvaluateProgress& timed_progress() {
    progress_.seconds = seconds_since(start_);
    const auto made = static_cast<double>(progress_.done - remembered_);
    progress_.seconds_left = progress_.seconds / made * static_cast<double>(progress_.total - progress_.done);
    return progress_;
  }

  Evaluations& table_;
  const EvaluateOptions& options_;
  std::vector<char> done_;
  std::vector<std::size_t> to_run_;
  std::size_t looked_at_ = 0;  // of to_run_
  FirstValues first_values_;
  std::unique_ptr<RunJournal> journal_;
  EvaluateProgress progress_;
  std::int64_t remembered_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::exception_ptr fault_;
  std::atomic<bool> halted_{false};
};

template <class F>
void run_batches(const F& f, Evaluations& table, RunBook& book, const EvaluateOptions& options) {
  const std::vector<std::size_t>& rows = book.to_run();
  const std::size_t size = options.batch_size ? static_cast<std::size_t>(*options.batch_size)
                                              : std::max<std::size_t>(rows.size(), 1);
  for (std::size_t from = 0; from < rows.size() && !book.stopped(); from += size) {
    const auto n = static_cast<Eigen::Index>(std::min(size, rows.size() - from));
    Eigen::MatrixXd X(n, static_cast<Eigen::Index>(table.problem.variables.size()));
    std::vector<Seed> seeds;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Evaluation& row = table.rows[rows[from + static_cast<std::size_t>(i)]];
      X.row(i) = row.x;
      seeds.push_back(row.seed);
    }
    const auto start = std::chrono::steady_clock::now();
    std::vector<Outcome> outcomes = call_batch(f, table.problem, X, seeds);
    const double seconds = seconds_since(start) / static_cast<double>(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t place = rows[from + static_cast<std::size_t>(i)];
      table.rows[place].outcome = std::move(outcomes[static_cast<std::size_t>(i)]);
      table.rows[place].seconds = seconds;
      book.ended(place);
    }
  }
}

/// One run into its row; false when it was cancelled on the way.
template <class F>
bool run_row(const F& f, const Problem& problem, Evaluation& row, Watchdog* watchdog,
             const EvaluateOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  if (watchdog) {
    const auto [run, stop] = watchdog->start();
    row.outcome = call(f, problem, row.x, row.seed, stop);
    watchdog->forget(run);
  } else {
    row.outcome = call(f, problem, row.x, row.seed);
  }
  row.seconds = seconds_since(start);
  if (row.seconds > options.time_limit) {
    row.outcome = Failure{"took " + number_text(std::round(row.seconds * 1000) / 1000) +
                          " s, over the time limit of " + number_text(options.time_limit) + " s"};
    return true;
  }
  return !(watchdog && row.outcome.failed() && options.stop.stop_requested());
}

/// Threads take the next row until none is left or the study is stopped.
template <class F>
void run_points(const F& f, Evaluations& table, RunBook& book, const EvaluateOptions& options) {
  const std::vector<std::size_t>& rows = book.to_run();
  std::unique_ptr<Watchdog> watchdog;
  if constexpr (StoppableFunction<F>) watchdog = std::make_unique<Watchdog>(options.time_limit, options.stop);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k; !book.stopped() && (k = next++) < rows.size();)
      if (run_row(f, table.problem, table.rows[rows[k]], watchdog.get(), options)) book.ended(rows[k]);
  };
  const std::size_t all = std::min(static_cast<std::size_t>(thread_count(options.threads)), rows.size());
  std::vector<std::jthread> threads;
  for (std::size_t t = 1; t < all; ++t) threads.emplace_back(work);
  work();
}

template <BlackBox F>
Evaluations evaluated(const F& f, const Problem& problem, const Eigen::MatrixXd& X,
                      const EvaluateOptions& options) {
  check_inside(X, problem, "doe::evaluate");
  check_options(options);
  Evaluations table = planned(problem, X, options);
  RunBook book(table, options);
  if constexpr (BatchFunction<F>) {
    run_batches(f, table, book, options);
  } else {
    run_points(f, table, book, options);
  }
  book.close();
  return table;
}

}  // namespace detail

/// X: n x d, natural units, inside the bounds, whole numbers where the variable takes no others. Returns
/// n·replicates rows, or those that were done when options.stop was requested. Throws std::invalid_argument
/// on a faulty problem, X or option, and where the first run that gives values gives another number than the
/// problem has responses; std::runtime_error from the journal; and whatever the callbacks throw. What f throws
/// becomes a failed row, as does a wrong number later, which a journal does not keep.
template <class F>
Evaluations evaluate(const F& f, const Problem& problem, const Eigen::MatrixXd& X,
                     const EvaluateOptions& options = {}) {
  require_black_box<F>();
  if constexpr (BlackBox<F>) {
    detail::check_variables(f, static_cast<Eigen::Index>(problem.variables.size()));
    return detail::evaluated(f, problem, X, options);
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::doe
