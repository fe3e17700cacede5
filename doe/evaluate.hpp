// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Evaluates a black box at every row of a design, several runs at once, each as often as `replicates` says.
///
/// Row i, replicate k of a design has seed run_seed(options.seed, first_run + i, k) and place i·replicates +
/// k in the table: the result does not depend on the number of threads nor on which run ends first. Failed
/// runs are rows like the others. A batch function gets all rows in one call on the calling thread and does
/// its own sharing out.

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/evaluations.hpp>

namespace drawpoint::doe {

struct EvaluateOptions {
  int threads = 1;     ///< runs at once, 1 or more; a batch function ignores it
  int replicates = 1;  ///< runs a design point, 1 or more, each with its own seed
  Seed seed = 1;       ///< the study's
  /// Called as each run ends, one call at a time, in order of ending.
  std::function<void(const Evaluation&)> on_result = {};
  std::int64_t first_run = 0;  ///< number of the first row, 0 or more: to go on with a study
};

namespace detail {

inline void check_count(const char* name, std::int64_t value, std::int64_t lowest) {
  if (value < lowest)
    throw std::invalid_argument("doe::evaluate: " + std::string(name) + " is " + std::to_string(value) +
                                "; allowed is " + std::to_string(lowest) + " or more");
}

inline void check_points(const Problem& problem, const Eigen::MatrixXd& X) {
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  if (X.cols() != d)
    throw std::invalid_argument("doe::evaluate: X has " + std::to_string(X.cols()) +
                                " columns, the problem has " + std::to_string(d) +
                                " variables; X is n x d with one run a row");
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    for (Eigen::Index j = 0; j < d; ++j) {
      const Variable& v = problem.variables[j];
      if (X(i, j) >= v.lower && X(i, j) <= v.upper) continue;
      throw std::invalid_argument("doe::evaluate: row " + std::to_string(i) + ", variable \"" + v.name +
                                  "\": " + with_unit(X(i, j), v.unit) + " is outside " +
                                  with_unit(v.lower, v.unit) + " to " + with_unit(v.upper, v.unit) +
                                  "; correct the point or widen the bounds");
    }
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
      const Seed seed =
          run_seed(options.seed, static_cast<std::uint64_t>(run), static_cast<std::uint64_t>(k));
      table.rows.push_back({run, k, seed, X.row(i), Outcome(), 0.0});
    }
  return table;
}

template <class F>
void run_batch(const F& f, Evaluations& table, const EvaluateOptions& options) {
  const auto n = static_cast<Eigen::Index>(table.rows.size());
  Eigen::MatrixXd X(n, static_cast<Eigen::Index>(table.problem.variables.size()));
  std::vector<Seed> seeds;
  for (Eigen::Index i = 0; i < n; ++i) {
    X.row(i) = table.rows[i].x;
    seeds.push_back(table.rows[i].seed);
  }
  const auto start = std::chrono::steady_clock::now();
  std::vector<Outcome> outcomes = call_batch(f, table.problem, X, seeds);
  const double seconds = seconds_since(start) / static_cast<double>(std::max<Eigen::Index>(n, 1));
  for (Eigen::Index i = 0; i < n; ++i) {
    table.rows[i].outcome = std::move(outcomes[i]);
    table.rows[i].seconds = seconds;
    if (options.on_result) options.on_result(table.rows[i]);
  }
}

/// Threads take the next row until none is left, or until on_result throws; the first such exception is
/// passed on.
template <class F>
void run_points(const F& f, Evaluations& table, const EvaluateOptions& options) {
  std::atomic<std::size_t> next{0};
  std::mutex reporting;
  std::exception_ptr fault;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < table.rows.size();) {
      Evaluation& row = table.rows[i];
      const auto start = std::chrono::steady_clock::now();
      row.outcome = call(f, table.problem, row.x, row.seed);
      row.seconds = seconds_since(start);
      if (!options.on_result) continue;
      const std::scoped_lock lock(reporting);
      try {
        if (!fault) options.on_result(row);
      } catch (...) {
        fault = std::current_exception();
        next = table.rows.size();
      }
    }
  };
  {
    const auto others = std::min<std::size_t>(static_cast<std::size_t>(options.threads), table.rows.size());
    std::vector<std::jthread> threads;
    for (std::size_t t = 1; t < others; ++t) threads.emplace_back(work);
    work();
  }
  if (fault) std::rethrow_exception(fault);
}

template <BlackBox F>
Evaluations evaluated(const F& f, const Problem& problem, const Eigen::MatrixXd& X,
                      const EvaluateOptions& options) {
  check(problem);
  check_points(problem, X);
  check_count("threads", options.threads, 1);
  check_count("replicates", options.replicates, 1);
  check_count("first_run", options.first_run, 0);
  Evaluations table = planned(problem, X, options);
  if constexpr (BatchFunction<F>) {
    run_batch(f, table, options);
  } else {
    run_points(f, table, options);
  }
  return table;
}

}  // namespace detail

/// X: n x d, natural units, inside the bounds. Returns n·replicates rows. Throws std::invalid_argument on a
/// faulty problem, X or option, and whatever on_result throws; what f throws becomes a failed row.
template <class F>
Evaluations evaluate(const F& f, const Problem& problem, const Eigen::MatrixXd& X,
                     const EvaluateOptions& options = {}) {
  require_black_box<F>();
  if constexpr (BlackBox<F>) {
    return detail::evaluated(f, problem, X, options);
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::doe
