// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Adaptive sampling: evaluate a first design, then add batches where a sampler says, until a criterion
/// holds.
///
/// This is the loop  runs = evaluate(f, problem, X);  while (!enough(runs)) runs += evaluate(f, problem,
/// propose(runs, sampler)),  with budget, journal and status. `enough` is asked before each batch and before
/// the sampler, so that a model fitted and scored there can serve the sampler too. Batch after batch is a
/// function of the runs so far and the options alone: with a journal (EvaluateOptions::journal) the same call
/// after a crash repeats the proposals, finds the runs on disk and goes on, to the same bits.
///
/// Without waiting for whole batches a new point is proposed whenever one of evaluate.threads threads is free,
/// from the runs that have ended, and kept away from those under way. With one thread the same holds of it; with
/// more the points depend on which run ends first, and the call after a crash goes on from the runs on disk.

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <drawpoint/doe/criterion.hpp>
#include <drawpoint/doe/detail/run_stream.hpp>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/lola_voronoi.hpp>
#include <drawpoint/doe/propose.hpp>

namespace drawpoint::doe {

struct RefineOptions {
  int max_points = 500;  ///< design points in all, those of the first design included; 1 or more
  /// Whether the runs so far are enough: a surrogate's error below its target, say. Empty: never.
  std::function<bool(const Evaluations& runs)> enough = {};
  ProposeOptions propose{.batch = 8};  ///< batch: as many as can run at once
  EvaluateOptions evaluate = {};       ///< its stop ends the loop too; first_run is set by the loop
  /// false: propose.batch is not used, `enough` is asked before each point, and evaluate.replicates must be 1.
  bool wait_for_batch = true;
};

enum class RefineStatus {
  criterion_met,  ///< enough said so
  budget_spent,   ///< max_points reached
  no_candidate,   ///< no point is left to propose
  cancelled       ///< evaluate.stop was requested
};

inline std::string_view to_string(RefineStatus status) {
  switch (status) {
    case RefineStatus::criterion_met:
      return "criterion_met";
    case RefineStatus::budget_spent:
      return "budget_spent";
    case RefineStatus::no_candidate:
      return "no_candidate";
    case RefineStatus::cancelled:
      return "cancelled";
  }
  return "unknown";
}

struct Refinement {
  Evaluations runs;
  RefineStatus status = RefineStatus::budget_spent;
  std::string message;  ///< for people
  int batches = 0;      ///< after the first design; points where no batch is waited for
};

namespace detail {

/// Evaluates X as the runs after those in `all` and appends them; false when it was cancelled.
template <class F>
bool extend(const F& f, Evaluations& all, const Eigen::MatrixXd& X, int& points, EvaluateOptions options) {
  options.first_run = points;
  Evaluations more = evaluate(f, all.problem, X, options);
  const bool whole = static_cast<Eigen::Index>(more.rows.size()) == X.rows() * options.replicates;
  for (Evaluation& row : more.rows) all.rows.push_back(std::move(row));
  points += static_cast<int>(X.rows());
  return whole;
}

template <class F, class S>
Refinement refined(const F& f, const Problem& problem, const Eigen::MatrixXd& first, S& sampler,
                   const RefineOptions& options) {
  Refinement result{Evaluations{problem, {}}, RefineStatus::cancelled, {}, 0};
  const auto end = [&](RefineStatus status, int points, const std::string& why) {
    result.status = status;
    result.message =
        why + " after " + std::to_string(points) + " points, " + std::to_string(result.batches) + " batches";
    return std::move(result);
  };
  int points = 0;
  bool whole = extend(f, result.runs, first, points, options.evaluate);
  while (whole) {
    if (options.enough && options.enough(result.runs))
      return end(RefineStatus::criterion_met, points, "the stopping criterion held");
    if (points >= options.max_points)
      return end(RefineStatus::budget_spent, points, "max_points was reached");
    ProposeOptions next = options.propose;
    next.batch = std::min(next.batch, options.max_points - points);
    const Eigen::MatrixXd X = propose(result.runs, sampler, next);
    if (X.rows() == 0) return end(RefineStatus::no_candidate, points, "no candidate was left");
    whole = extend(f, result.runs, X, points, options.evaluate);
    ++result.batches;
  }
  return end(RefineStatus::cancelled, points, "cancelled");
}

/// The same without batches.
template <class F, class S>
Refinement refined_one_by_one(const F& f, const Problem& problem, const Eigen::MatrixXd& first, S& sampler,
                              const RefineOptions& options) {
  check_inside(first, problem, "doe::refine");
  check_options(options.evaluate);
  if (options.evaluate.replicates != 1)
    throw std::invalid_argument("doe::refine: replicates is " + std::to_string(options.evaluate.replicates) +
                                " without waiting for batches; allowed is 1; wait for batches");
  bool met = false;
  int points = 0;
  const auto next = [&](const Evaluations& ended,
                        const Eigen::MatrixXd& pending) -> std::optional<Eigen::VectorXd> {
    met = met || (options.enough && options.enough(ended));
    if (met) return {};
    ProposeOptions one = options.propose;
    one.batch = 1;
    one.pending = pending;
    const Eigen::MatrixXd X = propose(ended, sampler, one);
    if (X.rows() == 0) return {};
    ++points;
    return X.row(0).transpose();
  };
  RunStream<F> runs("doe::refine", f, problem, options.max_points, options.evaluate);
  const StreamEnd end = stream(runs, first, options.max_points, next);
  Refinement result{runs.finish(), RefineStatus::cancelled, "cancelled", points};
  if (end == StreamEnd::budget_spent) {
    result.status = RefineStatus::budget_spent;
    result.message = "max_points was reached";
  } else if (end == StreamEnd::nothing_next) {
    result.status = met ? RefineStatus::criterion_met : RefineStatus::no_candidate;
    result.message = met ? "the stopping criterion held" : "no candidate was left";
  }
  result.message += " after " + std::to_string(result.runs.rows.size()) + " points";
  return result;
}

}  // namespace detail

/// first: n x d, the first design, natural units. `sampler` is a sampler, a joint one or a Mix
/// (criterion.hpp). Throws as evaluate and propose do, and whatever enough throws.
template <class F, class S>
Refinement refine(const F& f, const Problem& problem, const Eigen::MatrixXd& first, S&& sampler,
                  const RefineOptions& options = {}) {
  using Given = std::remove_reference_t<S>;
  require_black_box<F>();
  require_sampler<Given>();
  detail::check_rule(options.propose, JointSamplerFunction<Given>);
  if (options.max_points < 1)
    throw std::invalid_argument("doe::refine: max_points is " + std::to_string(options.max_points) +
                                "; allowed is 1 or more; give the budget with the first design in it");
  if (first.rows() < 1)
    throw std::invalid_argument(
        "doe::refine: the first design has 0 runs; allowed is 1 or more; start from a Latin hypercube");
  if constexpr (BlackBox<F> && (SamplerFunction<Given> || JointSamplerFunction<Given>))
    return options.wait_for_batch ? detail::refined(f, problem, first, sampler, options)
                                  : detail::refined_one_by_one(f, problem, first, sampler, options);
  else
    return {};  // so that the message above stands alone
}

}  // namespace drawpoint::doe
