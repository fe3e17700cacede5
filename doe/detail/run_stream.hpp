// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Runs that begin one by one while others are under way, each as soon as a thread is free.
///
/// The calling thread plans, one further thread per run computes; with one thread the calling thread does both,
/// and the table is a function of the plan alone. A run is in the journal, and its callbacks are called, when
/// it ends, also while the calling thread plans. Runs that the journal holds at the start count as ended.

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <list>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/threads.hpp>
#include <drawpoint/doe/evaluate.hpp>

namespace drawpoint::doe::detail {

template <BlackBox F>
class RunStream {
 public:
  /// who: in whose name it throws; total: runs in all, for the progress. Throws std::runtime_error as RunJournal does.
  RunStream(const char* who, const F& f, const Problem& problem, std::int64_t total,
            const EvaluateOptions& options)
      : who_(who), f_(f), options_(options), table_{problem, {}} {
    progress_.total = total;
    if (!options.journal.empty()) {
      journal_ = std::make_unique<RunJournal>(problem, options.journal);
      table_.rows = journal_->rows();
    }
    for (const Evaluation& row : table_.rows) {
      next_ = std::max(next_, row.run + 1);
      first_values_.take(row.outcome, who_);
      progress_.failed += row.outcome.failed();
    }
    remembered_ = progress_.done = static_cast<std::int64_t>(table_.rows.size());
    if constexpr (StoppableFunction<F>)
      watchdog_ = std::make_unique<Watchdog>(options.time_limit, options.stop);
  }

  ~RunStream() {
    for (Under& run : under_way_)
      if (run.thread.joinable()) run.thread.join();
  }
  RunStream(const RunStream&) = delete;
  RunStream& operator=(const RunStream&) = delete;

  /// The runs that have ended, in the order of their ends.
  const Evaluations& ended() const { return table_; }

  /// Points under way, k x d.
  Eigen::MatrixXd pending() const {
    Eigen::MatrixXd X(static_cast<Eigen::Index>(under_way_.size()),
                      static_cast<Eigen::Index>(table_.problem.variables.size()));
    Eigen::Index i = 0;
    for (const Under& run : under_way_) X.row(i++) = run.row.x;
    return X;
  }

  std::int64_t begun() const { return static_cast<std::int64_t>(table_.rows.size() + under_way_.size()); }
  bool stopped() const { return options_.stop.stop_requested(); }

  /// Begins row i of the first design as run i, unless the journal has it. Throws std::runtime_error where the
  /// journal has that run at another point.
  void begin_first(std::int64_t i, const Eigen::VectorXd& x) {
    Evaluation row = planned_row(i, x);
    next_ = std::max(next_, i + 1);
    if (!journal_ || !journal_->find(row)) begin(std::move(row));
  }

  void begin_next(const Eigen::VectorXd& x) { begin(planned_row(next_++, x)); }

  /// Waits until a thread is free. Throws what callbacks and the journal threw, and std::invalid_argument where
  /// the first values were not one per response.
  void wait_for_room() {
    const auto most = static_cast<std::size_t>(thread_count(options_.threads));
    do collect(under_way_.size() >= most);
    while (under_way_.size() >= most);
  }

  /// Waits until at least one more run has ended; false when none is under way.
  bool wait_for_one() {
    if (under_way_.empty()) return false;
    collect(true);
    return true;
  }

  /// The table in the order of runs, once all have ended.
  Evaluations finish() {
    while (wait_for_one()) {
    }
    std::stable_sort(table_.rows.begin(), table_.rows.end(),
                     [](const Evaluation& a, const Evaluation& b) { return a.run < b.run; });
    return std::move(table_);
  }

 private:
  struct Under {
    Evaluation row;
    bool ended = false, whole = false;
    std::thread thread = {};
  };

  Evaluation planned_row(std::int64_t run, const Eigen::VectorXd& x) const {
    return {run, 0, run_seed(options_.seed, static_cast<std::uint64_t>(run), 0), x, Outcome(), 0.0};
  }

  void begin(Evaluation row) {
    under_way_.push_back({std::move(row)});
    Under& run = under_way_.back();
    if (thread_count(options_.threads) > 1)
      run.thread = std::thread([this, &run] { make(run); });
    else
      make(run);
  }

  void make(Under& run) {
    run.whole = run_row(f_, table_.problem, run.row, watchdog_.get(), options_);
    const std::scoped_lock lock(mutex_);
    try {
      if (run.whole && !fault_) report(run.row);
    } catch (...) {
      fault_ = std::current_exception();
    }
    run.ended = true;
    changed_.notify_one();
  }

  void report(const Evaluation& row) {
    if (journal_ && row.outcome.given() != Outcome::Given::wrong_count) journal_->add(row);
    ++progress_.done;
    progress_.failed += row.outcome.failed();
    if (options_.on_result) options_.on_result(row);
    if (!options_.progress) return;
    progress_.seconds = seconds_since(start_);
    progress_.seconds_left = progress_.seconds / static_cast<double>(progress_.done - remembered_) *
                             static_cast<double>(progress_.total - progress_.done);
    options_.progress(progress_);
  }

  /// Moves what has ended into the table; `wait`: until there is one.
  void collect(bool wait) {
    std::list<Under> done;
    {
      std::unique_lock lock(mutex_);
      const auto any = [&] {
        return std::any_of(under_way_.begin(), under_way_.end(), [](const Under& u) { return u.ended; });
      };
      if (wait) changed_.wait(lock, any);
      for (auto it = under_way_.begin(); it != under_way_.end();)
        if (const auto run = it++; run->ended) done.splice(done.end(), under_way_, run);
    }
    for (Under& run : done)
      if (run.thread.joinable()) run.thread.join();
    if (fault_) std::rethrow_exception(fault_);
    for (Under& run : done) {
      if (!run.whole) continue;
      first_values_.take(run.row.outcome, who_);
      table_.rows.push_back(std::move(run.row));
    }
  }

  const char* who_;
  const F& f_;
  const EvaluateOptions& options_;
  Evaluations table_;
  std::unique_ptr<RunJournal> journal_;
  std::unique_ptr<Watchdog> watchdog_;
  FirstValues first_values_;
  EvaluateProgress progress_;
  std::int64_t remembered_ = 0, next_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr fault_;
  std::list<Under> under_way_;
};

/// How a stream of runs ended.
enum class StreamEnd { budget_spent, nothing_next, cancelled };

/// The first design, then next(ended runs, pending points) whenever a thread is free, until it gives no point or
/// `total` runs have begun. X: n x d, natural units; next: std::optional<Eigen::VectorXd>. A next that gives no
/// point while runs are under way is asked again when one has ended.
template <BlackBox F, class Next>
StreamEnd stream(RunStream<F>& runs, const Eigen::MatrixXd& first, std::int64_t total, const Next& next) {
  for (Eigen::Index i = 0; i < first.rows(); ++i) {
    runs.wait_for_room();
    if (runs.stopped()) return StreamEnd::cancelled;
    runs.begin_first(i, first.row(i).transpose());
  }
  while (true) {
    runs.wait_for_room();
    if (runs.stopped()) return StreamEnd::cancelled;
    if (runs.begun() < total) {
      if (const auto x = next(runs.ended(), runs.pending())) {
        runs.begin_next(*x);
        continue;
      }
      if (runs.wait_for_one()) continue;
      return StreamEnd::nothing_next;
    }
    if (!runs.wait_for_one()) return StreamEnd::budget_spent;
  }
}

}  // namespace drawpoint::doe::detail
