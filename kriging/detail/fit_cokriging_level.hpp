// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Fits one level of co-Kriging to its runs, given the levels below.
///
/// 1. fit() with the trend h(x) = (f(x), g(x) (m(x) − c)), as if the mean m of the levels below were the
///    response there: a global search. g are the terms of ρ that the runs tell from f (told_rho.hpp).
/// 2. The restricted likelihood, which knows S(X, X) (cokriging_likelihood.hpp), climbed from there and from
///    three starts that take less of the difference for Z; then D gets the ρ that was found, until that moves
///    by less than a hundredth of its standard error, 5 times at most.
/// Parameters of the levels below stay: the runs of this level are few beside theirs and say little of them.
/// V of the parameters is the inverse curvature of step 2 with s² free. Cost: a fit of n runs and some
/// hundred gradients of n³.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/kriging/detail/climb.hpp>
#include <drawpoint/kriging/detail/cokriging_level.hpp>
#include <drawpoint/kriging/detail/cokriging_likelihood.hpp>
#include <drawpoint/kriging/detail/fit_prepared.hpp>
#include <drawpoint/kriging/detail/told_rho.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// One level's runs. X: n x d, natural units; y: n. The box in `options` is given.
struct LevelRuns {
  std::string name;
  const Eigen::MatrixXd& X;
  const Eigen::VectorXd& y;
  FitOptions options;
};

/// build(), with λ raised until R can be factored.
inline void build_regular(const CokrigingLevels& levels, CokrigingLevel& level) {
  while (!build(levels, level)) level.s.nugget *= 100.0;
}

inline CokrigingLevel fit_cheapest_level(const LevelRuns& runs) {
  CokrigingLevel level;
  level.name = runs.name;
  level.X = runs.X;
  FitOptions options = runs.options;
  options.may_be_exact = false;  // levels hold one explanation
  level.s = fit(runs.X, runs.y, options).state();
  build_regular({}, level);
  return level;
}

/// Step 1: the state of a fit whose trend has g(x) (m(x) − c) in it. `asked`: the terms of ρ asked for.
inline CokrigingLevel level_with_mean_below(const CokrigingLevels& levels, const LevelRuns& runs,
                                            const std::vector<TrendTerm>& asked) {
  CokrigingLevel level;
  level.name = runs.name;
  level.X = runs.X;
  level.below_centre = levels.back().s.y_centre;
  const std::vector<TrendTerm> f =
      polynomial(static_cast<int>(runs.X.cols()), runs.options.trend, runs.options.levels);
  const InputScale input = input_scale(runs.X, runs.options);
  const Eigen::MatrixXd scaled_runs = input.apply(runs.X);
  const std::vector<TrendTerm> rho =
      told_rho(levels, {scaled_runs, term_values(f, scaled_runs), views_of(levels, levels.size(), runs.X),
                        asked, level.below_centre});
  FitOptions options = runs.options;
  options.trend = Trend::user;
  options.basis.values = [&](const Eigen::VectorXd& x) {
    const Eigen::VectorXd scaled = input.apply(x.transpose()).transpose();
    const double m = views_of(levels, levels.size(), x.transpose()).back().mean[0] - level.below_centre;
    Eigen::VectorXd h(static_cast<Index>(f.size() + rho.size()));
    for (std::size_t j = 0; j < f.size(); ++j) h[static_cast<Index>(j)] = f[j].at(scaled);
    for (std::size_t j = 0; j < rho.size(); ++j) h[static_cast<Index>(f.size() + j)] = m * rho[j].at(scaled);
    return h;
  };
  options.may_be_exact = false;
  level.s = fit(runs.X, runs.y, options).state();
  std::vector<TrendTerm> kept;
  for (const Index j : level.s.trend.kept) {
    const auto term = static_cast<std::size_t>(j);
    if (term < f.size())
      kept.push_back(f[term]);
    else
      level.rho.push_back(rho[term - f.size()]);
  }
  level.s.trend = TrendFunction{kept, {}, {}};
  level.rho_given = affine(level.s.gls.beta.tail(static_cast<Index>(level.rho.size())), level.s.y_scale);
  return level;
}

inline CokrigingProblem problem_of(const CokrigingLevels& levels, const CokrigingLevel& level,
                                   const FitOptions& options) {
  const ModelState& s = level.s;
  CokrigingProblem problem{
      s.X,           s.F, Eigen::MatrixXd::Zero(s.X.rows(), s.X.rows()), s.y, s.correlation, s.noise,
      s.known_noise, {}};
  if (!level.rho.empty()) {
    problem.G = unknown_below(levels, level);
    for (double& entry : problem.G.reshaped()) entry /= s.y_scale * s.y_scale;
  }
  if (options.estimation == Estimation::penalized_likelihood) {
    std::vector<bool> varying;
    for (Index k = 0; k < s.X.cols(); ++k) varying.push_back(!never_varies(s.X, k));
    problem.prior.emplace(s.X.rows(), varying, s.known_noise == 0, options.nugget_power);
  }
  return problem;
}

/// The bounds of (ln θ, ln s², ln λ), s² of the standardised response.
inline Box cokriging_box(const CokrigingLevel& level, const FitOptions& options) {
  constexpr double least = 1e-12;
  const double most = level.s.known_noise > 0 ? most_process_variance : 1e4;
  const Index d = level.X.cols();
  Box box{Eigen::VectorXd(d + 2), Eigen::VectorXd(d + 2)};
  const ParameterPlaces places = parameter_places(level.s.correlation, d, false);
  bound_thetas(places, options, box);
  fix_untold(level.s.X, level.s.correlation, places, box);
  box.lower[d] = std::log(least);
  box.upper[d] = std::log(most);
  box.lower[d + 1] = std::log(options.nugget_lower);
  box.upper[d + 1] = level.s.known_noise > 0 ? box.lower[d + 1] : std::log(options.nugget_upper);
  return box;
}

inline Eigen::VectorXd parameters_of(const ModelState& s) {
  const Index d = s.X.cols();
  Eigen::VectorXd p(d + 2);
  for (Index k = 0; k < d; ++k) p[k] = std::log(s.correlation.theta[k]);
  p[d] = std::log(s.process_variance);
  p[d + 1] = std::log(s.nugget);
  return p;
}

/// Step 1's parameters, and others by (θ, s², λ): as they are with less of s², and a smooth Z.
inline std::vector<Eigen::VectorXd> cokriging_starts(const ModelState& s, const Box& box) {
  const Eigen::VectorXd p = parameters_of(s);
  const Index d = s.X.cols();
  std::vector<Eigen::VectorXd> starts{p, p, p, p};
  starts[1][d] -= std::log(10.0);
  for (Index k = 0; k < d; ++k) starts[2][k] = starts[3][k] = std::log(0.1);
  starts[3][d] -= std::log(100.0);
  starts[2][d + 1] = starts[3][d + 1] = std::log(1e-3);
  for (Eigen::VectorXd& start : starts) start = moved(box, start, 0.0, p);
  return starts;
}

inline void set_parameters(const Eigen::VectorXd& p, const CokrigingLikelihood& at, ModelState& s) {
  for (Index k = 0; k < s.X.cols(); ++k) s.correlation.theta[k] = std::exp(p[k]);
  s.process_variance = at.variance();
  s.nugget = at.nugget();
}

/// −∂²LL/∂p∂p by central differences of the gradient.
inline Eigen::MatrixXd cokriging_curvature(CokrigingLikelihood& likelihood, const Eigen::VectorXd& p) {
  constexpr double step = 1e-4;
  Eigen::MatrixXd H(p.size(), p.size());
  for (Index a = 0; a < p.size(); ++a) {
    Eigen::VectorXd up = p, down = p;
    up[a] += step;
    down[a] -= step;
    const Eigen::VectorXd change = difference(likelihood.gradient(down), likelihood.gradient(up));
    for (Index b = 0; b < p.size(); ++b) H(b, a) = change[b] / (2.0 * step);
  }
  for (Index a = 0; a < p.size(); ++a)
    for (Index b = 0; b < a; ++b) H(a, b) = H(b, a) = 0.5 * (H(a, b) + H(b, a));
  return H;
}

/// S of parameter_uncertainty.hpp with s² free; that of step 1 where the curvature is not positive definite.
/// Where step 1 left none, its trend having met all runs, exponents have no row: step 2 keeps them. s² comes
/// first in the triangular root, so that the rows of the others do without its column.
inline void set_spread(CokrigingLikelihood& likelihood, const Box& box, const Eigen::VectorXd& p,
                       ModelState& s) {
  std::vector<Index> free = free_parameters(box, p, likelihood.gradient(p));
  const Index d = s.X.cols(), parameters = std::max(s.parameter_spread.rows(), d + 1);
  const auto variance = std::find(free.begin(), free.end(), d);
  const Index first = variance != free.end() ? 1 : 0, count = static_cast<Index>(free.size());
  if (first == 1) std::rotate(free.begin(), variance, variance + 1);
  if (count == first) return;
  const Eigen::MatrixXd H = cokriging_curvature(likelihood, p);
  const Eigen::MatrixXd S =
      inverse_root(rows_of(columns_of(H, free), free), Eigen::VectorXd::Constant(count, 0.25));
  if (S.size() == 0) return;
  s.parameter_spread = Eigen::MatrixXd::Zero(parameters, count - first);
  for (Index i = first; i < count; ++i) {
    const Index parameter = free[static_cast<std::size_t>(i)],
                row = parameter < d ? parameter : parameters - 1;
    for (Index j = i; j < count; ++j) s.parameter_spread(row, j - first) = S(i, j);
  }
}

/// Standard errors of ρ's coefficients, θ, s² and λ taken as known.
inline Eigen::VectorXd rho_standard_errors(const CokrigingLevel& level) {
  const Index q = level.s.gls.T.rows(), count = static_cast<Index>(level.rho.size());
  Eigen::VectorXd errors(count);
  Eigen::MatrixXd inverse(q, q);
  for (Index j = 0; j < q; ++j) inverse.col(j) = solve_upper(level.s.gls.T, Eigen::VectorXd::Unit(q, j));
  const Eigen::VectorXd squares = row_squares(inverse);
  for (Index j = 0; j < count; ++j) errors[j] = std::sqrt(level.s.process_variance * squares[q - count + j]);
  return errors;
}

inline bool settled(const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                    const Eigen::VectorXd& error) {
  for (Index j = 0; j < after.size(); ++j)
    if (std::abs(after[j] - before[j]) > 0.01 * error[j]) return false;
  return true;
}

/// Step 2.
inline void climb_level(const CokrigingLevels& levels, const FitOptions& options, CokrigingLevel& level) {
  using LevelClimb = BoxClimb<CokrigingLikelihood>;
  const Box box = cokriging_box(level, options);
  std::vector<Eigen::VectorXd> starts = cokriging_starts(level.s, box);
  bool done = false;
  for (int iteration = 0; iteration < 5; ++iteration) {
    CokrigingLikelihood likelihood(problem_of(levels, level, options));
    LevelClimb best(likelihood, box, starts[0]);
    best.advance(options.max_iterations, 1e-5);
    for (std::size_t i = 1; i < starts.size(); ++i) {
      LevelClimb other(likelihood, box, starts[i]);
      other.advance(options.max_iterations, 1e-5);
      if (other.value() > best.value()) best = other;
    }
    if (!std::isfinite(best.value())) return;
    likelihood.value(best.p());
    done = best.done();
    set_parameters(best.p(), likelihood, level.s);
    if (options.parameter_uncertainty) set_spread(likelihood, box, best.p(), level.s);
    build_regular(levels, level);
    const Eigen::VectorXd before = level.rho_given;
    if (settled(before, level.rho_coefficients(), rho_standard_errors(level))) break;
    level.rho_given = level.rho_coefficients();
    starts = {best.p()};
  }
  if (!done) level.s.report.status = Status::not_converged;
}

inline CokrigingLevel fit_level_above(const CokrigingLevels& levels, const LevelRuns& runs,
                                      const std::vector<TrendTerm>& rho) {
  CokrigingLevel level = level_with_mean_below(levels, runs, rho);
  build_regular(levels, level);
  climb_level(levels, runs.options, level);
  return level;
}

}  // namespace drawpoint::kriging::detail
