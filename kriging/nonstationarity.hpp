// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Whether one correlation and one noise fit everywhere: a response that jumps, or is rougher or noisier in
/// one part of the box than elsewhere.
///
/// A Kriging model takes the response to vary alike all over the box. Of one that jumps it makes a rough one:
/// error bars are too wide away from the jump and too narrow at it, and the status is `converged`. Two
/// questions:
///   Does it jump with an input? The step across a gap between runs of which generalised least squares are
///   surest goes into the trend. It counts if it is ten of its standard errors or more (chance, among the gaps
///   of a smooth function of five inputs, reaches eight) and leave-one-out errors fall to `spoilt` of what
///   they were or less.
///   Do leave-one-out errors, each over its deviation, cluster along an input or between neighbours
///   (detail/error_scan.hpp)? What chance does is told by simulation: responses drawn from the fitted model at
///   the same runs, θ and λ as fitted, β estimated anew. Errors that cluster only with the run of the largest
///   among them are that run's doing (outliers.hpp), not the response's.
/// A category has no places in a row: it is asked neither for jumps nor for windows, only for neighbours,
/// which are runs of one level first.
/// Errors below `matters` of the response's deviation are left alone: every formula is uneven in its last
/// digits. Cost n² per simulation and per gap, and a fit. Deterministic.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/error_scan.hpp>
#include <drawpoint/kriging/detail/left_out.hpp>
#include <drawpoint/kriging/detail/sites.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/model.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::kriging {

struct StationarityOptions {
  doe::Seed seed = 1;     ///< of the simulations
  double level = 0.01;    ///< chance that an even response is called uneven, 2/(simulations + 1) to 1
  int simulations = 399;  ///< 99 or more
  double matters = 0.05;  ///< least root mean square of the errors over the deviation of y, 0 to 1
  double spoilt = 0.7;    ///< 0 to 1
};

/// A step of the response between two runs.
struct Jump {
  int input;             ///< along which
  double after, before;  ///< natural units: the two runs' values of the input, after < before
  double size;           ///< what the response gains from one side to the other, unit of y
  double standard_error;
  double error_left;  ///< leave-one-out errors with the step in the trend over those without it
};

struct Stationarity {
  bool uneven = false;
  double p_value = 1;  ///< of errors that cluster so much by chance; above the level where only a jump tells
  double error_share = 0;  ///< root mean square of the leave-one-out errors over the deviation of y
  /// Where errors are largest: input, from, to in natural units, and how many times the deviations of the
  /// model errors are there, in root mean square, over those elsewhere. -1: between neighbours, along no
  /// input.
  int input = -1;
  double from = 0, to = 0, ratio = 1;
  std::vector<Eigen::Index>
      runs;  ///< the rows of X there; along no input a tenth, those with the largest errors
  std::optional<Jump> jump;
};

namespace detail {

inline void check_stationarity_options(const StationarityOptions& options) {
  const auto reject = [](const char* name, const std::string& value, const std::string& allowed) {
    throw std::invalid_argument("kriging::check_stationarity: " + std::string(name) + " is " + value +
                                "; allowed is " + allowed);
  };
  if (options.simulations < 99)
    reject("simulations", std::to_string(options.simulations), "99 or more; 399 tell a chance of 0.01");
  const double least = 2.0 / (options.simulations + 1);
  if (!(options.level >= least && options.level <= 1))
    reject("level", text(options.level), text(least) + " to 1 with so many simulations");
  if (!(options.matters >= 0 && options.matters <= 1)) reject("matters", text(options.matters), "0 to 1");
  if (!(options.spoilt >= 0 && options.spoilt <= 1)) reject("spoilt", text(options.spoilt), "0 to 1");
}

/// P v for R = L Lᵀ and B = L⁻ᵀQ: n².
inline Eigen::VectorXd without_trend(const ModelState& s, const Eigen::VectorXd& v) {
  Eigen::VectorXd Pv = v;
  solve_lower(s.L, Pv);
  solve_lower_transposed(s.L, Pv);
  add_product(Pv.data(), -1.0, s.gls.B, transposed_product(s.gls.B, v).data());
  return Pv;
}

/// How runs are left out, each with its repeats, of the factor of one model.
struct SitesOfModel {
  Eigen::VectorXd P;                                     ///< its diagonal
  std::vector<std::vector<Eigen::Index>> repeated = {};  ///< sites of several runs
  std::vector<Eigen::MatrixXd> blocks = {};              ///< P of those

  explicit SitesOfModel(const ModelState& s) {
    Eigen::MatrixXd L = s.L, rows;
    inverse_transposed(L, rows);
    P = row_squares(rows);
    add_scaled(P.data(), -1.0, row_squares(s.gls.B).data(), P.size());
    for (std::vector<Eigen::Index>& site : sites_of(s.X)) {
      if (site.size() < 2) continue;
      blocks.push_back(block_of_P(site, rows, s.gls));
      repeated.push_back(std::move(site));
    }
  }

  /// Leave-one-out errors over their deviations, squared, but for a common factor: (P y)ᵢ²/Pᵢᵢ of single runs. A
  /// site that the others tell nothing of has none.
  Eigen::VectorXd squared_errors(const Eigen::VectorXd& alpha) const {
    Eigen::VectorXd squares = entry_quotients(entry_products(alpha, alpha), P);
    for (std::size_t k = 0; k < repeated.size(); ++k) {
      const LeftOut out = solve_site(blocks[k], entries_of(alpha, repeated[k]));
      for (std::size_t i = 0; i < repeated[k].size(); ++i) {
        const auto row = static_cast<Index>(i);
        const double square = out.error[row] * out.error[row] / out.variance[row];
        squares[repeated[k][i]] = std::isnan(square) ? 0.0 : square;
      }
    }
    return squares;
  }
};

/// How often chance reaches what was found, along inputs and between neighbours: the smaller p, doubled for
/// two questions.
struct Clusters {
  double p_value = 1;
  bool along_input = false;
  ErrorWindow window;
};

inline Clusters clusters_of(const ModelState& s, const ErrorScan& scan, const SitesOfModel& sites,
                            const StationarityOptions& options) {
  Clusters found;
  const Eigen::VectorXd squares = sites.squared_errors(s.gls.alpha);
  found.window = scan.widest_errors(squares);
  const double alike = scan.neighbours_alike(squares);
  doe::RandomStream random(options.seed);
  int as_wide = 1, as_alike = 1;
  Eigen::VectorXd y = s.y;
  for (int k = 0; k < options.simulations; ++k) {
    Eigen::VectorXd z = s.y;
    for (double& entry : z) entry = random.normal();
    y = product(s.L, z);
    const Eigen::VectorXd by_chance = sites.squared_errors(without_trend(s, y));
    as_wide += scan.widest_errors(by_chance).ratio >= found.window.ratio;
    as_alike += scan.neighbours_alike(by_chance) >= alike;
  }
  found.along_input = found.window.input >= 0 && as_wide <= as_alike;
  found.p_value = std::min(1.0, 2.0 * std::min(as_wide, as_alike) / (options.simulations + 1.0));
  return found;
}

/// Without the site of one run, θ and λ as they are. False where the rest is singular.
inline bool leave_out(ModelState& s, Index run) {
  std::vector<Index> rest;
  for (Index i = 0; i < s.X.rows(); ++i)
    if (s.X.row(i) != s.X.row(run)) rest.push_back(i);
  if (static_cast<Index>(rest.size()) <= s.F.cols()) return false;
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(s.L.rows(), s.L.rows());
  add_product(block_of(s.L), block_of(s.L), 1.0, block_of(R), Part::lower);
  mirror_lower(R);
  s.L = columns_of(rows_of(R, rest), rest);
  s.X = rows_of(s.X, rest);
  s.F = rows_of(s.F, rest);
  s.y = entries_of(s.y, rest);
  s.observed = entries_of(s.observed, rest);
  if (s.noise.size() > 0) s.noise = entries_of(s.noise, rest);
  if (!factor(block_of(s.L), 1)) return false;
  clear_upper(s.L);
  estimate(s);
  return true;
}

/// Whether the errors of the others cluster too, without the site of the largest error.
inline bool cluster_without_worst(ModelState s, const Eigen::VectorXd& squares,
                                  const StationarityOptions& options) {
  Index worst = 0;
  squares.maxCoeff(&worst);
  return leave_out(s, worst) &&
         clusters_of(s, ErrorScan(s.X, s.correlation.levels), SitesOfModel(s), options).p_value <=
             options.level;
}

inline double to_natural(const InputScale& scale, double x, Index k) {
  return scale.factor[k] > 0 ? x / scale.factor[k] + scale.centre[k] : scale.centre[k];
}

/// Root mean square of the errors of the rows over that of all others.
inline double error_ratio(const Eigen::VectorXd& squares, const std::vector<Index>& rows) {
  double inside = 0, all = mean_of(squares) * static_cast<double>(squares.size());
  for (const Index i : rows) inside += squares[i];
  const auto m = static_cast<double>(rows.size()), rest = static_cast<double>(squares.size()) - m;
  return std::sqrt(inside / m / std::max((all - inside) / rest, std::numeric_limits<double>::min()));
}

/// The rows with the largest errors, a tenth of all.
inline std::vector<Index> worst_rows(const Eigen::VectorXd& squares) {
  std::vector<Index> rows(static_cast<std::size_t>(squares.size()));
  std::iota(rows.begin(), rows.end(), Index{0});
  std::stable_sort(rows.begin(), rows.end(), [&](Index a, Index b) { return squares[a] > squares[b]; });
  rows.resize((rows.size() + 9) / 10);
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// A gap between runs that follow each other along an input.
struct Gap {
  int input = -1;
  Index place = 0;  ///< of the run behind it, in the order of the input
};

/// The gap across which a step of the response is surest: (hᵀPy)²/(hᵀPh) is largest, h 1 behind the gap. Four
/// runs or more on each side, so that no step stands for one wild run.
inline Gap surest_gap(const ModelState& s, const ErrorScan& scan) {
  constexpr Index fewest = 4;
  Gap best;
  double most = 0;
  for (int k = 0; k < s.X.cols(); ++k) {
    const auto& order = scan.order(k);
    if (order.empty()) continue;
    const auto n = static_cast<Index>(order.size());
    Eigen::VectorXd h = Eigen::VectorXd::Zero(n);
    for (Index i = n - 1; i >= fewest; --i) {
      h[order[static_cast<std::size_t>(i)]] = 1.0;
      const double before = s.X(order[static_cast<std::size_t>(i - 1)], k),
                   behind = s.X(order[static_cast<std::size_t>(i)], k);
      if (i > n - fewest || !(behind > before)) continue;
      const double spread = dot(h, without_trend(s, h)), step = dot(h, s.gls.alpha);
      if (spread > 0 && step * step / spread > most) best = {k, i}, most = step * step / spread;
    }
  }
  return best;
}

/// Trend and noise as in the model, with the step as one more term of the trend, the last one.
inline Model fit_with_step(const Model& model, int input, double at) {
  const ModelState& s = model.state();
  Eigen::MatrixXd X = s.X;
  for (Index k = 0; k < X.cols(); ++k)
    for (Index i = 0; i < X.rows(); ++i) X(i, k) = to_natural(s.input, s.X(i, k), k);
  FitOptions options;
  options.correlation = s.correlation.family;
  options.levels = s.correlation.levels;
  options.structure = s.correlation.structure;
  options.trend = Trend::user;
  options.basis.values = [trend = s.trend, scale = s.input, input, at](const Eigen::VectorXd& x) {
    const Eigen::VectorXd scaled = scale.apply(x.transpose()).row(0), half_range = scale.half_range();
    const Eigen::VectorXd terms = trend.values({x, scaled, half_range});
    Eigen::VectorXd all(terms.size() + 1);
    for (Index j = 0; j < terms.size(); ++j) all[j] = terms[j];
    all[terms.size()] = x[input] > at ? 1.0 : 0.0;
    return all;
  };
  if (s.noise.size() > 0) {
    options.noise = s.known_noise > 0 ? Noise::known : Noise::proportional;
    options.noise_variance = affine(s.noise, s.noise_unit);
  } else if (s.known_noise > 0) {
    options.noise = Noise::pooled;
    options.noise_variance = Eigen::VectorXd::Constant(X.rows(), s.noise_unit);
  } else if (s.nugget <= exact_nugget) {
    options.noise = Noise::none;
  }
  return fit(X, s.observed, options);
}

/// Leave-one-out errors of one model over those of another, in root mean square, each over the variance that
/// the other expects: over the deviation, a run of much noise would count as much as any and hide what
/// changes.
inline double error_quotient(const Validation& mine, const Validation& theirs, double process_variance) {
  double sum = 0, of_other = 0;
  for (Index i = 0; i < mine.observed.size(); ++i) {
    // Over the process variance, which has the unit.
    const double variance = theirs.observation_variance[i] / process_variance;
    sum += std::pow((mine.observed[i] - mine.predicted[i]) / variance, 2);
    of_other += std::pow((theirs.observed[i] - theirs.predicted[i]) / variance, 2);
  }
  return std::sqrt(sum / of_other);
}

/// The step across a gap, if it counts. `left_out`: of the model.
inline std::optional<Jump> jump_across(const Gap& gap, const Model& model, const Validation& left_out,
                                       const ErrorScan& scan, double spoilt) {
  const ModelState& s = model.state();
  if (gap.input < 0) return {};
  const auto at = [&](Index place) {
    const Index run = scan.order(gap.input)[static_cast<std::size_t>(place)];
    return to_natural(s.input, s.X(run, gap.input), gap.input);
  };
  const double after = at(gap.place - 1), before = at(gap.place);
  const Model stepped = fit_with_step(model, gap.input, 0.5 * (after + before));
  const ModelState& t = stepped.state();
  const Index last = t.gls.beta.size() - 1;
  if (last != s.trend.size()) return {};  // the runs cannot tell the step from the other terms
  const Jump jump{gap.input,
                  after,
                  before,
                  t.y_scale * t.gls.beta[last],
                  std::sqrt(stepped.process_variance()) / std::abs(t.gls.T(last, last)),
                  error_quotient(leave_one_out(stepped), left_out, model.process_variance())};
  if (!(std::abs(jump.size) >= 10 * jump.standard_error && jump.error_left <= spoilt)) return {};
  return jump;
}

/// All runs of the window, which lies along an input.
inline void describe_window(const ModelState& s, const ErrorScan& scan, const ErrorWindow& window,
                            Stationarity& result) {
  const auto& order = scan.order(window.input);
  result.input = window.input;
  result.runs.assign(order.begin() + window.from, order.begin() + window.to + 1);
  result.from = to_natural(s.input, s.X(result.runs.front(), window.input), window.input);
  result.to = to_natural(s.input, s.X(result.runs.back(), window.input), window.input);
  std::sort(result.runs.begin(), result.runs.end());
}

}  // namespace detail

/// Checks a model of 20 runs or more; with fewer, or a constant response, nothing is found. Throws
/// std::invalid_argument for options out of range.
inline Stationarity check_stationarity(const Model& model, const StationarityOptions& options = {}) {
  detail::check_stationarity_options(options);
  const detail::ModelState& s = model.state();
  Stationarity result;
  if (s.X.rows() < 20) return result;
  const Eigen::VectorXd centred = detail::affine(s.observed, 1.0, -detail::mean_of(s.observed));
  const Validation left_out = leave_one_out(model);
  result.error_share =
      left_out.rmse / std::sqrt(detail::square(centred) / static_cast<double>(centred.size()));
  if (!(result.error_share >= options.matters)) return result;

  const detail::ErrorScan scan(s.X, s.correlation.levels);
  const detail::SitesOfModel sites(s);
  const Eigen::VectorXd squares = sites.squared_errors(s.gls.alpha);
  const detail::Gap gap = detail::surest_gap(s, scan);
  result.jump = detail::jump_across(gap, model, left_out, scan, options.spoilt);
  const detail::Clusters clusters = detail::clusters_of(s, scan, sites, options);
  result.p_value = clusters.p_value;
  const bool cluster =
      clusters.p_value <= options.level && detail::cluster_without_worst(s, squares, options);
  result.uneven = result.jump || cluster;
  if (result.jump && !(cluster && clusters.along_input && clusters.window.input == gap.input))
    detail::describe_window(s, scan, {gap.input, gap.place - 1, gap.place}, result);  // the runs beside it
  else if (cluster && clusters.along_input)
    detail::describe_window(s, scan, clusters.window, result);
  else if (cluster)
    result.runs = detail::worst_rows(squares);
  if (result.uneven) result.ratio = detail::error_ratio(squares, result.runs);
  return result;
}

}  // namespace drawpoint::kriging
