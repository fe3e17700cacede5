// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Main effects: how the mean of a response moves with one input, the others uniform in the box or
/// distributed as one says (distribution.hpp).
///
///   m_j(x) = E[f | x_j = x],  at `levels` values of x_j from its lower to its upper bound
/// The same `samples` points of a scrambled Sobol' sequence serve at every level and for every input, with
/// entry j replaced: so the curve is smooth, and for a sum of functions of one input its shape is exact. Cost
/// d · levels · samples runs: meant for formulas and surrogates. Ready to plot: x against mean, with the band
/// from `low` to `high` that holds 80 % of the responses.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/doe/detail/sorted_quantile.hpp>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/sensitivity.hpp>
#include <drawpoint/doe/sobol.hpp>

namespace drawpoint::doe {

struct MainEffectsOptions {
  Seed seed = 1;      ///< of the points
  int levels = 21;    ///< values of each input, 2 or more
  int samples = 256;  ///< points averaged at each, 2 or more; powers of 2 suit the Sobol' sequence
  InputDistributions inputs = {};  ///< of the others, by variable; uniform where they are not named
  EvaluateOptions evaluate = {};
};

/// One curve: entries are levels, NaN where every run failed; means and bands in the unit of the response.
struct MainEffect {
  std::string variable, response;
  /// too_few_runs: the mean is NaN somewhere; runs_lost: more than a twentieth failed at some level.
  SensitivityStatus status = SensitivityStatus::estimated;
  std::string message = {};        ///< empty when estimated
  Eigen::VectorXd x;               ///< natural units
  Eigen::VectorXd mean;            ///< E[f | x_j = x]
  Eigen::VectorXd standard_error;  ///< of the mean, as if the points were random
  Eigen::VectorXd low, high;       ///< 10 % and 90 % of the responses
};

namespace detail {

inline void check_main_effects(const MainEffectsOptions& options) {
  const auto at_least_two = [](const char* name, int value) {
    if (value < 2)
      throw std::invalid_argument("doe::main_effects: " + std::string(name) + " is " + std::to_string(value) +
                                  "; allowed is 2 or more; a curve needs two points and a spread two runs");
  };
  at_least_two("levels", options.levels);
  at_least_two("samples", options.samples);
  if (options.evaluate.replicates != 1)
    throw std::invalid_argument("doe::main_effects: replicates is " +
                                std::to_string(options.evaluate.replicates) +
                                "; allowed is 1; average inside the black box");
}

inline double level(const Variable& v, int k, int levels) {
  return to_natural(static_cast<double>(k) / (levels - 1), v);
}

/// Blocks of `samples` rows, level after level, input after input.
inline Eigen::MatrixXd main_effects_design(const Problem& problem, const MainEffectsOptions& options) {
  const Eigen::MatrixXd base =
      distributed(problem, options.inputs, scrambled_sobol(problem, options.samples, {.seed = options.seed}));
  const Eigen::Index d = base.cols(), n = base.rows();
  Eigen::MatrixXd X(d * options.levels * n, d);
  for (Eigen::Index j = 0, from = 0; j < d; ++j)
    for (int k = 0; k < options.levels; ++k, from += n) {
      X.middleRows(from, n) = base;
      X.col(j).segment(from, n).setConstant(level(problem.variables[j], k, options.levels));
    }
  return X;
}

/// Entry k of the curve from the values that succeeded there.
inline void set_level(MainEffect& effect, Eigen::Index k, Eigen::VectorXd values) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<double>(values.size());
  effect.mean[k] = values.size() ? values.mean() : none;
  effect.standard_error[k] =
      n > 1 ? std::sqrt((values.array() - effect.mean[k]).square().sum() / (n - 1) / n) : none;
  std::sort(values.begin(), values.end());
  effect.low[k] = values.size() ? sorted_quantile(values, 0.1) : none;
  effect.high[k] = values.size() ? sorted_quantile(values, 0.9) : none;
}

/// Tells of levels where runs failed; kept: how many succeeded at each.
inline void tell_losses(MainEffect& effect, const Variable& variable, const Eigen::VectorXi& kept,
                        int samples) {
  const auto empty = (kept.array() == 0).count();
  Eigen::Index worst = 0;
  const int lost = samples - kept.minCoeff(&worst);
  if (empty > 0) {
    effect.status = SensitivityStatus::too_few_runs;
    effect.message = "every run failed at " + std::to_string(empty) + " of " + std::to_string(kept.size()) +
                     " levels, where the mean is NaN; see the reasons of the failures, or narrow the bounds";
  } else if (20 * lost > samples) {
    effect.status = SensitivityStatus::runs_lost;
    const std::string at = variable.levels.empty()
                               ? number_text(effect.x[worst])
                               : variable.levels[static_cast<std::size_t>(effect.x[worst])];
    effect.message =
        std::to_string(lost) + " of " + std::to_string(samples) + " runs failed at " + variable.name + " = " +
        at +
        ": means there are of the part of the box where runs succeed; narrow the bounds, or give failed "
        "runs a value";
  }
}

inline MainEffect main_effect(const Evaluations& runs, Eigen::Index j, Eigen::Index response,
                              const MainEffectsOptions& options) {
  const Variable& variable = runs.problem.variables[j];
  const Eigen::VectorXd blank(options.levels);
  MainEffect effect{.variable = variable.name,
                    .response = runs.problem.responses[response].name,
                    .x = blank,
                    .mean = blank,
                    .standard_error = blank,
                    .low = blank,
                    .high = blank};
  Eigen::VectorXi succeeded(options.levels);
  for (int k = 0; k < options.levels; ++k) {
    effect.x[k] = level(variable, k, options.levels);
    Eigen::VectorXd values(options.samples);
    Eigen::Index kept = 0;
    const Eigen::Index from = (j * options.levels + k) * options.samples;
    for (Eigen::Index i = from; i < from + options.samples; ++i) {
      const Outcome& outcome = runs.rows[static_cast<std::size_t>(i)].outcome;
      if (!outcome.failed()) values[kept++] = outcome.values()[response];
    }
    set_level(effect, k, values.head(kept));
    succeeded[k] = static_cast<int>(kept);
  }
  tell_losses(effect, variable, succeeded, options.samples);
  return effect;
}

}  // namespace detail

/// One curve a variable and response, variables outermost. Throws std::invalid_argument for options out of
/// range and more than 1111 variables, std::runtime_error when options.evaluate.stop ended the runs, and as
/// evaluate does.
template <class F>
std::vector<MainEffect> main_effects(const F& f, const Problem& problem,
                                     const MainEffectsOptions& options = {}) {
  require_black_box<F>();
  check(problem);
  detail::check_main_effects(options);
  const Eigen::MatrixXd X = detail::main_effects_design(problem, options);
  const Evaluations runs = evaluate(f, problem, X, options.evaluate);
  std::vector<MainEffect> effects;
  if (static_cast<Eigen::Index>(runs.rows.size()) != X.rows())
    throw std::runtime_error("doe::main_effects: stopped after " + std::to_string(runs.rows.size()) + " of " +
                             std::to_string(X.rows()) + " runs; give a journal to go on later");
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    for (std::size_t r = 0; r < problem.responses.size(); ++r)
      effects.push_back(detail::main_effect(runs, j, static_cast<Eigen::Index>(r), options));
  return effects;
}

}  // namespace drawpoint::doe
