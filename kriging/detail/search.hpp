// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The search for θ, exponents and λ: many short climbs, then Ipopt from the best.
///
/// Up to 250 runs every start climbs on all runs (climb.hpp) until it promises less than 1e-3 more, and Ipopt
/// finishes the best, or the one that leave-one-out prefers (choice.hpp), with the exact Hessian
/// (maximize.hpp). Beyond, the climbs see 250 runs, evenly picked: the one that leave-one-out prefers, or the
/// best of the interpolating and of the noisy explanation, starts Ipopt on all runs
/// with the curvature that the climb has learnt, scaled by the number of runs. Deterministic. Cost up to 250
/// runs: candidates · n³/3 + about 15 starts · n³; beyond, about 10 gradients of n³ a search more.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/choice.hpp>
#include <drawpoint/kriging/detail/climb.hpp>
#include <drawpoint/kriging/detail/likelihood.hpp>
#include <drawpoint/kriging/detail/maximize.hpp>
#include <drawpoint/kriging/detail/starting_points.hpp>
#include <drawpoint/kriging/detail/trend.hpp>
#include <drawpoint/kriging/options.hpp>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

inline constexpr double agreement = 0.1;  // log likelihood
inline constexpr double climb_gain = 1e-3;

struct Search {
  Maximum best;
  int tried = 0, agreed = 0;
  double height_left = 0;  ///< that the highest maximum has beyond the chosen one
  double error_ratio = 1;  ///< root mean square leave-one-out error, chosen over highest
};

/// The problem of some of its runs, with those terms of the trend that these tell apart: with others its likelihood is
/// −∞ everywhere. `take` gives their rows of a matrix.
template <class Take>
LikelihoodProblem problem_of_some(const LikelihoodProblem& all, const Take& take) {
  LikelihoodProblem some = all;
  some.X = take(all.X);
  some.y = take(all.y);
  if (all.F.size()) {
    const Eigen::MatrixXd F = take(all.F);
    some.F = columns_of(F, independent_columns(F));
  }
  if (all.noise.size()) some.noise = take(all.noise);
  return some;
}

/// At most `many` runs, evenly picked.
inline LikelihoodProblem thinned(const LikelihoodProblem& all) {
  LikelihoodProblem few =
      problem_of_some(all, [](const Eigen::MatrixXd& rows) { return thinned(rows, many); });
  few.threads = 1;
  return few;
}

/// All climbs, best first; ties keep the order of the starts.
inline std::vector<Climb> climbs(Likelihood& likelihood, const Box& box, const FitOptions& options) {
  std::vector<Climb> all, ranked;
  std::vector<double> values;
  for (const Eigen::VectorXd& start : starting_points(likelihood, box, options)) {
    all.emplace_back(likelihood, box, start);
    all.back().advance(options.max_iterations, climb_gain);
    values.push_back(all.back().value());
  }
  for (const int i : ranking(values)) ranked.push_back(all[i]);
  return ranked;
}

/// How many came to the height `value`.
inline int agreeing(const std::vector<Climb>& all, double value) {
  return static_cast<int>(std::count_if(
      all.begin(), all.end(), [&](const Climb& c) { return std::abs(c.value() - value) <= agreement; }));
}

/// Where the searches on all runs start, with curvatures times `scale`: the chosen climb, and, where that is
/// the highest, the best of the other explanation of the same data.
inline std::vector<SearchStart> starts_on_all(const std::vector<Climb>& ranked, std::size_t place,
                                              double scale) {
  const auto noisy = [](const Climb& c) { return c.p()[c.p().size() - 1] >= std::log(interpolation_nugget); };
  const auto start = [&](const Climb& c) {
    SearchStart s{c.p(), c.curvature()};
    std::for_each(s.curvature.data(), s.curvature.data() + s.curvature.size(),
                  [=](double& b) { b *= scale; });
    return s;
  };
  std::vector<SearchStart> starts{start(ranked[place])};
  if (place > 0) return starts;
  const auto other = std::find_if(ranked.begin(), ranked.end(), [&](const Climb& c) {
    return std::isfinite(c.value()) && noisy(c) != noisy(ranked.front());
  });
  if (other != ranked.end()) starts.push_back(start(*other));
  return starts;
}

/// Raises λ tenfold, within the box, until R of all runs can be factored: few runs need less of it.
inline void make_regular(Likelihood& likelihood, const Box& box, SearchStart& start) {
  const Eigen::Index last = start.p.size() - 1;
  while (!std::isfinite(likelihood.value(start.p)) && start.p[last] < box.upper[last])
    start.p[last] = std::min(start.p[last] + std::log(10.0), box.upper[last]);
}

/// The highest that the starts lead to on all of many runs.
inline Maximum maximize_all(Likelihood& likelihood, const Box& box, const std::vector<SearchStart>& starts,
                            int max_iterations) {
  Maximum best;
  for (SearchStart start : starts) {
    make_regular(likelihood, box, start);
    const Maximum found = maximize(likelihood, box, start, max_iterations);
    if (found.value > best.value) best = found;
  }
  return best;
}

/// Searches the box; the best point has the value −∞ when R is singular wherever it was tried.
inline Search search(Likelihood& likelihood, const Box& box, const FitOptions& options, int& evaluations) {
  if (box.lower == box.upper) return {{box.lower, likelihood.value(box.lower), true}, 1, 1};
  const bool all = likelihood.runs() <= many;
  Likelihood few(all ? LikelihoodProblem{} : thinned(likelihood.problem()));
  Likelihood& climbed = all ? likelihood : few;
  const std::vector<Climb> ranked = climbs(climbed, box, options);
  if (!std::isfinite(ranked.front().value())) {
    evaluations += all ? 0 : few.factorizations();
    return {{ranked.front().p(), ranked.front().value(), false}, static_cast<int>(ranked.size()), 0};
  }
  const bool by_error = options.estimation == Estimation::penalized_likelihood;
  const Choice choice = by_error ? chosen(climbed, ranked) : Choice{};
  evaluations += all ? 0 : few.factorizations();
  const Climb& from = ranked[choice.place];
  const double scale = static_cast<double>(likelihood.runs()) / static_cast<double>(many);
  const Maximum best =
      all ? maximize(likelihood, box, {from.p(), {}}, options.max_iterations)
          : maximize_all(likelihood, box, starts_on_all(ranked, choice.place, scale), options.max_iterations);
  return {best, static_cast<int>(ranked.size()), agreeing(ranked, from.value()),
          ranked.front().value() - from.value(), choice.ratio};
}

}  // namespace drawpoint::kriging::detail
