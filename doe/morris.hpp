// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Screening by elementary effects: which of many inputs matter at all, in r(d + 1) runs.
///
/// A trajectory starts at a random point of a grid and changes one input at a time, in random order, by half
/// of the grid's levels (up from the lower half, down from the upper one): d + 1 runs. A real input has p
/// levels, an integer or categorical one all its values. The elementary effect of input j is the change of
/// the response over the change of u_j, the input's share of its range: the change, in the unit of the
/// response, over the whole range. For a categorical input it is the change itself. Over the trajectories:
///   mean           μ, the effect as a whole; effects of both signs cancel
///   mean_absolute  μ*, how much the input matters: rank by this
///   deviation      σ; 0 where the response is linear in the input and knows no interaction of it
/// A run that failed takes the effects on both of its sides with it. The order of a categorical input's
/// levels means nothing: look at its μ* only. With noise of variance τ² in each run, σ² grows by 2τ²/Δ² and
/// μ* of an inert input is not 0: Δ = p/(2(p − 1)).
/// Sources: Morris 1991, Technometrics 33(2); Campolongo, Cariboni, Saltelli 2007, Environ. Model. Softw. 22
/// (μ*).

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/sensitivity.hpp>

namespace drawpoint::doe {

struct MorrisOptions {
  Seed seed = 1;          ///< of the trajectories
  int trajectories = 10;  ///< r, 2 or more; 10 rank the inputs, some 50 give σ to a tenth
  /// p of real inputs, even, 2 to 1000; 4 is usual. A step is p/(2(p − 1)) of the range: 2/3 with 4 levels,
  /// little more than a half with many. What repeats itself over the step seems inert: with 64 levels the
  /// second input of Ishigami's function, whose period is half of its range.
  int levels = 4;
  EvaluateOptions evaluate = {};
};

/// Unit of the response per range of the input; one entry per variable, NaN with fewer than two effects.
struct ElementaryEffects {
  std::string response;
  SensitivityStatus status = SensitivityStatus::estimated;
  std::string message = {};  ///< empty when estimated
  Eigen::VectorXd mean, mean_absolute, deviation;
  Eigen::VectorXd standard_error;  ///< of mean_absolute
  Eigen::VectorXi count;           ///< effects of each variable
};

struct Screening {
  std::vector<ElementaryEffects> responses;  ///< in the order of the problem
  Evaluations runs;                          ///< d + 1 of each trajectory, one after another
};

namespace detail {

inline void check_morris(const MorrisOptions& options) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("doe::morris_screening: " + what);
  };
  if (options.trajectories < 2)
    reject("trajectories is " + std::to_string(options.trajectories) +
           "; allowed is 2 or more; 10 rank the inputs");
  if (options.levels < 2 || options.levels > 1000 || options.levels % 2 != 0)
    reject("levels is " + std::to_string(options.levels) +
           "; allowed is an even number from 2 to 1000; 4 is usual");
  if (options.evaluate.replicates != 1)
    reject("replicates is " + std::to_string(options.evaluate.replicates) +
           "; allowed is 1; average inside the black box");
}

/// Trajectories, and which input changed before each row but the first of a trajectory.
struct Trajectories {
  Eigen::MatrixXd X;                ///< r(d + 1) x d, natural units
  std::vector<Eigen::Index> moved;  ///< one per row; -1 for the first of a trajectory
};

/// The number of levels of a variable, and the value of one of them in natural units.
inline int level_count(const Variable& v, int levels) {
  return is_discrete(v) ? static_cast<int>(value_count(v)) : levels;
}
inline double value_of_level(const Variable& v, int level, int levels) {
  return is_discrete(v) ? v.lower + level : to_natural(static_cast<double>(level) / (levels - 1), v);
}

inline Trajectories trajectories(const Problem& problem, const MorrisOptions& options) {
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  Trajectories t{Eigen::MatrixXd(options.trajectories * (d + 1), d), {}};
  std::vector<int> level(static_cast<std::size_t>(d));
  Eigen::Index row = 0;
  const auto add = [&](Eigen::Index moved) {
    for (std::size_t j = 0; j < level.size(); ++j)
      t.X(row, static_cast<Eigen::Index>(j)) = value_of_level(problem.variables[j], level[j], options.levels);
    ++row;
    t.moved.push_back(moved);
  };
  for (int k = 0; k < options.trajectories; ++k) {
    RandomStream random(run_seed(options.seed, static_cast<std::uint64_t>(k), 0));
    for (std::size_t j = 0; j < level.size(); ++j)
      level[j] = random.below(level_count(problem.variables[j], options.levels));
    const std::vector<Eigen::Index> order = permutation(d, random);
    add(-1);
    for (const Eigen::Index j : order) {
      const auto of = static_cast<std::size_t>(j);
      const int count = level_count(problem.variables[of], options.levels);
      const int half = count / 2;
      level[of] = level[of] < count - half ? level[of] + half : level[of] - (count - half);
      add(j);
    }
  }
  return t;
}

/// The effects of each input on one response.
inline std::vector<std::vector<double>> elementary_effects(const Trajectories& t, const Evaluations& runs,
                                                           Eigen::Index response) {
  std::vector<std::vector<double>> effects(runs.problem.variables.size());
  for (std::size_t row = 1; row < runs.rows.size(); ++row) {
    const Eigen::Index j = t.moved[row];
    const Outcome &before = runs.rows[row - 1].outcome, &after = runs.rows[row].outcome;
    if (j < 0 || before.failed() || after.failed()) continue;
    const auto i = static_cast<Eigen::Index>(row);
    const Variable& v = runs.problem.variables[static_cast<std::size_t>(j)];
    const double share =
        v.kind == VariableKind::categorical ? 1.0 : (t.X(i, j) - t.X(i - 1, j)) / (v.upper - v.lower);
    effects[static_cast<std::size_t>(j)].push_back((after.values()[response] - before.values()[response]) /
                                                   share);
  }
  return effects;
}

struct MeanAndDeviation {
  double mean, deviation;
};

inline MeanAndDeviation mean_and_deviation(const Eigen::ArrayXd& values) {
  const double mean = values.mean(), size = values.abs().maxCoeff();  // whose square may leave the range
  if (!(size > 0.0)) return {mean, 0.0};
  const double squares = ((values - mean) / size).square().sum();
  return {mean, size * std::sqrt(squares / static_cast<double>(values.size() - 1))};
}

inline ElementaryEffects summary_of(std::string response, const std::vector<std::vector<double>>& effects,
                                    int trajectories) {
  const auto d = static_cast<Eigen::Index>(effects.size());
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(d, std::numeric_limits<double>::quiet_NaN());
  ElementaryEffects e{.response = std::move(response),
                      .mean = none,
                      .mean_absolute = none,
                      .deviation = none,
                      .standard_error = none,
                      .count = Eigen::VectorXi::Zero(d)};
  for (Eigen::Index j = 0; j < d; ++j) {
    const auto& of = effects[static_cast<std::size_t>(j)];
    e.count[j] = static_cast<int>(of.size());
    if (of.size() < 2) continue;
    const Eigen::ArrayXd values = Eigen::Map<const Eigen::ArrayXd>(of.data(), e.count[j]);
    const MeanAndDeviation raw = mean_and_deviation(values), absolute = mean_and_deviation(values.abs());
    e.mean[j] = raw.mean;
    e.deviation[j] = raw.deviation;
    e.mean_absolute[j] = absolute.mean;
    e.standard_error[j] = absolute.deviation / std::sqrt(static_cast<double>(of.size()));
  }
  if (e.count.minCoeff() < 2) {
    e.status = SensitivityStatus::too_few_runs;
    e.message = std::to_string((e.count.array() < 2).count()) +
                " variables have fewer than two effects: runs failed or are missing; see the reasons of the "
                "failures";
  } else if ((e.mean_absolute.array() == 0.0).all()) {
    e.status = SensitivityStatus::constant_response;
    e.message = "no change of an input changed the response";
  } else if (const Eigen::Index all = trajectories * d, lost = all - e.count.sum(); 20 * lost > all) {
    e.status = SensitivityStatus::runs_lost;
    e.message = std::to_string(lost) + " of " + std::to_string(all) +
                " effects are left out beside failed runs: the others are of the part of the box where runs "
                "succeed";
  }
  return e;
}

}  // namespace detail

/// Makes trajectories·(d + 1) runs and estimates the effects on every response. A stopped evaluation
/// (options.evaluate.stop) gives what its runs allow. Throws std::invalid_argument for options out of range,
/// and as evaluate does. Equal input gives equal bits on any number of threads.
template <class F>
Screening morris_screening(const F& f, const Problem& problem, const MorrisOptions& options = {}) {
  require_black_box<F>();
  check(problem);
  detail::check_morris(options);
  const detail::Trajectories t = detail::trajectories(problem, options);
  Screening result{{}, evaluate(f, problem, t.X, options.evaluate)};
  for (std::size_t r = 0; r < problem.responses.size(); ++r)
    result.responses.push_back(detail::summary_of(
        problem.responses[r].name, detail::elementary_effects(t, result.runs, static_cast<Eigen::Index>(r)),
        options.trajectories));
  return result;
}

}  // namespace drawpoint::doe
