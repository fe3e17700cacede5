// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The optimum of an expensive black box in one call: `Optimum found = optimize(simulate, problem, 60);`
///
/// A first design fills the box, a Latin hypercube; after it every run is chosen by Kriging models of all runs so
/// far (detail/next_run.hpp). One objective gives the best run, several give the front; limits (at_most,
/// at_least), whole numbers, categories and failed runs are part of the problem. Whether the simulator is exact
/// the problem says (Problem::deterministic), or one run is made twice, with two seeds; the models then meet the
/// runs, or estimate their noise. With several threads a run is chosen whenever one is free, and points under way
/// count as what the models expect of them.
///
/// With one thread equal input gives equal bits; with more the points depend on which run ends first. With a
/// journal the call after a crash goes on from the runs on disk. Cost beside each run: a fit or two per objective
/// and limit and some 5000 predictions, 0.02 to 0.05 s per response at 60 runs, 1 s where runs have failed.
/// Sources: Jones, Schonlau, Welch 1998, J. Global Optimization 13; Schonlau 1997, "Computer experiments and
/// global optimization"; Ginsbourger, Le Riche, Carraro 2010 (points under way); acquisition_hypervolume.hpp.

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <drawpoint/doe/detail/run_stream.hpp>
#include <drawpoint/doe/evaluate_options.hpp>
#include <drawpoint/kriging/detail/optimum_search.hpp>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

struct OptimizeOptions {
  doe::Seed seed = 1;  ///< of the design, the candidates and the runs
  int threads = 1;     ///< runs at once, 0: all cores
  /// Runs of the first design, 1 to the budget; empty: 2 per variable, at least 12, at most a third of the
  /// budget. Larger ones leave less to learn from.
  std::optional<int> first = {};
  doe::Allowed allowed = {};           ///< where runs may be made; empty: the whole box
  std::filesystem::path journal = {};  ///< where each run is kept as it ends (doe/run_journal.hpp)
  std::stop_token stop = {};           ///< requested: no run is begun any more
  double time_limit = std::numeric_limits<double>::infinity();  ///< of a run [s], as EvaluateOptions has it
  std::function<void(const doe::Evaluation&)> on_result =
      {};  ///< called as each run ends, one call at a time
  std::function<void(const doe::EvaluateProgress&)> progress = {};  ///< called after on_result
};

enum class OptimizeStatus {
  budget_spent,
  no_candidate,       ///< every point has been run
  nothing_feasible,   ///< the budget is spent, and no run keeps all limits
  nothing_succeeded,  ///< all runs failed
  cancelled
};

inline std::string_view to_string(OptimizeStatus status) {
  switch (status) {
    case OptimizeStatus::budget_spent:
      return "budget_spent";
    case OptimizeStatus::no_candidate:
      return "no_candidate";
    case OptimizeStatus::nothing_feasible:
      return "nothing_feasible";
    case OptimizeStatus::nothing_succeeded:
      return "nothing_succeeded";
    case OptimizeStatus::cancelled:
      return "cancelled";
  }
  return "unknown";
}

struct Optimum {
  /// One objective: the best run; several: the front, in the order of the runs. Where no run keeps all limits the
  /// one that breaks them least, where none succeeded nothing.
  std::vector<OptimalPoint> best;
  /// One objective: where the models expect the best of all points without a run.
  std::optional<OptimalPoint> expected;
  bool feasible = false;  ///< whether the best keep all limits
  bool exact = false;     ///< whether the simulator was taken to be exact
  doe::Evaluations runs;  ///< all of them, in their order
  OptimizeStatus status = OptimizeStatus::budget_spent;
  std::string message;  ///< for people
};

namespace detail {

inline void check_optimize(const doe::Problem& problem, int budget, const OptimizeOptions& options) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("kriging::optimize: " + what);
  };
  doe::check(problem);
  if (std::none_of(problem.responses.begin(), problem.responses.end(),
                   [](const doe::Response& r) { return doe::is_objective(r.goal); }))
    reject(
        "the problem has 0 objectives; allowed is 1 or more; give a response the goal minimize or maximize");
  if (budget < 1)
    reject("budget is " + std::to_string(budget) + "; allowed is 1 or more; give the runs that can be made");
  if (options.first && (*options.first < 1 || *options.first > budget))
    reject("first is " + std::to_string(*options.first) + "; allowed is 1 to the budget, " +
           std::to_string(budget) + "; leave it out for 2 per variable");
}

inline int first_runs(const doe::Problem& problem, int budget, const OptimizeOptions& options) {
  const int wanted = std::max(2 * static_cast<int>(problem.variables.size()), 12);
  return options.first.value_or(std::clamp(wanted, 1, std::max(budget / 3, 1)));
}

/// The point whose run is made twice, so that it tells whether the simulator is exact: of those that succeeded the one
/// with the median of the first objective, since noisy runs may agree at an extreme.
inline Eigen::VectorXd point_to_repeat(const doe::Evaluations& ended, const Eigen::MatrixXd& first) {
  const std::vector<doe::Response>& responses = ended.problem.responses;
  const auto asked = std::find_if(responses.begin(), responses.end(),
                                  [](const doe::Response& r) { return doe::is_objective(r.goal); });
  std::vector<std::pair<double, const doe::Evaluation*>> good;
  for (const doe::Evaluation& row : ended.rows)
    if (!row.outcome.failed()) good.emplace_back(row.outcome.values()[asked - responses.begin()], &row);
  if (good.empty()) return first.row(0).transpose();
  std::stable_sort(good.begin(), good.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return good[good.size() / 2].second->x;
}

inline doe::EvaluateOptions evaluation_of(const OptimizeOptions& options) {
  doe::EvaluateOptions e;
  e.seed = options.seed;
  e.threads = options.threads;
  e.journal = options.journal;
  e.stop = options.stop;
  e.time_limit = options.time_limit;
  e.on_result = options.on_result;
  e.progress = options.progress;
  return e;
}

inline void conclude(Optimum& o, doe::detail::StreamEnd end) {
  if (end == doe::detail::StreamEnd::cancelled)
    o.status = OptimizeStatus::cancelled;
  else if (o.best.empty())
    o.status = OptimizeStatus::nothing_succeeded;
  else if (!o.feasible)
    o.status = OptimizeStatus::nothing_feasible;
  else if (end == doe::detail::StreamEnd::nothing_next)
    o.status = OptimizeStatus::no_candidate;
  o.message = std::to_string(o.runs.rows.size()) + " runs, " + std::to_string(o.runs.failed()) + " failed; ";
  if (o.best.empty())
    o.message += "none gave values";
  else if (!o.feasible)
    o.message += "none keeps all limits, the best breaks them least";
  else
    o.message += o.best.size() == 1 ? "1 is the best" : std::to_string(o.best.size()) + " are on the front";
  o.message += o.exact ? "; the simulator is exact" : "; the simulator is taken to be noisy";
}

template <class F>
Optimum optimized(const F& f, const doe::Problem& problem, int budget, const OptimizeOptions& options) {
  const Eigen::MatrixXd first =
      first_design(problem, first_runs(problem, budget, options), options.seed, options.allowed);
  const bool ask = !problem.deterministic && budget > first.rows() + 1;
  const doe::EvaluateOptions evaluation = evaluation_of(options);
  doe::detail::check_options(evaluation);
  doe::detail::RunStream<F> runs("kriging::optimize", f, problem, budget, evaluation);
  const auto next = [&](const doe::Evaluations& ended,
                        const Eigen::MatrixXd& pending) -> std::optional<Eigen::VectorXd> {
    const std::int64_t begun = runs.begun(), extra = begun - first.rows();
    if (ask && extra == 0) return point_to_repeat(ended, first);
    return next_run(ended, pending, {options.seed, options.allowed, extra - ask, budget - begun});
  };
  const doe::detail::StreamEnd end = doe::detail::stream(runs, first, budget, next);
  Optimum o;
  o.runs = runs.finish();
  OptimumFound found = optimum_found(o.runs, {options.seed, options.allowed, 0, 1});
  o.best = std::move(found.best);
  o.expected = std::move(found.expected);
  o.feasible = found.feasible;
  o.exact = found.exact;
  conclude(o, end);
  return o;
}

}  // namespace detail

/// At most `budget` runs of f, those of the journal included. Throws std::invalid_argument for a faulty problem
/// or option, a problem without an objective, and where the first run that gives values gives another number than
/// the problem has responses; std::runtime_error from the journal; and whatever the callbacks throw.
template <class F>
Optimum optimize(const F& f, const doe::Problem& problem, int budget, const OptimizeOptions& options = {}) {
  doe::require_black_box<F>();
  detail::check_optimize(problem, budget, options);
  if constexpr (doe::BlackBox<F>) {
    doe::detail::check_variables(f, static_cast<Eigen::Index>(problem.variables.size()));
    return detail::optimized(f, problem, budget, options);
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::kriging

#ifndef DRAWPOINT_KRIGING_COMPILED
#include <drawpoint/kriging/detail/first_design.hpp>
#include <drawpoint/kriging/detail/next_run.hpp>
#include <drawpoint/kriging/detail/optimum_found.hpp>
#endif
