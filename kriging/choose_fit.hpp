// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Which of several ways to fit a response predicts it best, error bars included, and on which scale.
///
/// Each way is scored by the logarithm of the density that it predicts, on the scale of y, for each run
/// without it (cross_validation.hpp). A prediction outside of the range counts as the bound, so a run on a
/// bound is scored by the probability of reaching that. The score is proper and compares scales; unlike an
/// error of the mean it sees error bars that are too narrow, where noise was taken for signal, and those that
/// are equally wide where the response is not equally certain. Source: Gneiting, Raftery 2007, JASA 102(477),
/// "Strictly proper scoring rules, prediction, and estimation".
///
/// A way is taken in the place of the first where
/// * its mean score over the runs is better by more than one standard error of the difference, paired by runs;
///   a gain below that is mostly chance;
/// * so is the mean over the box, each run counted by its share of it (detail/box_shares.hpp): where half of
///   the runs are corners, the mean over the runs asks who predicts corners;
/// * it is better, by these shares, when both are fitted to runs that they do not score.
/// Of several the one that gains most over the box is taken.
///
/// Cost: a fit and a leave-one-out per way, five fits per way that passes leave-one-out and five of the first
/// then, and 50 n² d for the shares. Deterministic.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/detail/box_shares.hpp>
#include <drawpoint/kriging/noise_model.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

struct FitStanding {
  std::string name;
  double log_score = 0;       ///< −ln of the predicted density, mean over the runs, unit ln(unit of y)
  double gain = 0;            ///< the first way's less this
  double standard_error = 0;  ///< of the gain
  double box_gain = 0;        ///< the gain with each run counted by its share of the box
  double box_standard_error = 0;
  /// The gain over the box where both are fitted anew to runs that they do not score; NaN where that was not
  /// asked.
  double refitted_gain = std::numeric_limits<double>::quiet_NaN();
};

struct FitChoice {
  std::vector<FitStanding> table;  ///< in the order of the ways
  std::size_t best = 0;            ///< of the table
  TransformedModel model;          ///< fitted to all runs in the best way

  const std::string& name() const { return table[best].name; }
  Scale scale() const { return model.transform().scale; }
};

/// Noise of runs as a choice among ways takes it along; `variance`: as FitOptions::noise_variance, n entries,
/// none for the nugget.
struct RunNoise {
  Noise noise = Noise::nugget;
  Eigen::VectorXd variance = {};
};

/// f(X, y) or f(X, y, noise_variance) that gives a TransformedModel, behind one type. It may be given fewer
/// runs than all, and then the variances of these.
class RunFitter {
 public:
  template <class F>
  requires(!std::same_as<std::remove_cvref_t<F>, RunFitter>) RunFitter(F f)  // NOLINT: any such function
      : f_(erase(std::move(f))) {}

  TransformedModel operator()(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                              const Eigen::VectorXd& noise_variance = {}) const {
    return f_(X, y, noise_variance);
  }

 private:
  using Runs = const Eigen::MatrixXd&;
  using Entries = const Eigen::VectorXd&;
  using Erased = std::function<TransformedModel(Runs, Entries, Entries)>;

  template <class F>
  static Erased erase(F f) {
    if constexpr (std::is_invocable_r_v<TransformedModel, const F&, Runs, Entries, Entries>)
      return f;
    else
      return [f = std::move(f)](Runs X, Entries y, Entries) { return TransformedModel(f(X, y)); };
  }

  Erased f_;
};

struct WayToFit {
  std::string name;
  RunFitter fitter;
  /// By which the way is judged on runs that it has not seen. Empty: by the noise of its model, one size, the
  /// mean of what differs; a way that takes each run's own noise gives expected_noise(NoiseSource::told).
  ExpectedNoise noise = {};
};

/// These options with the Gaussian correlation and with Matérn 5/2, each with a constant and with a linear
/// trend: smooth and less smooth, without and with a slope. The first is the one to keep without a reason.
inline std::vector<FitOptions> usual_kinds(FitOptions options = {}) {
  std::vector<FitOptions> kinds;
  for (const Correlation correlation : {Correlation::gaussian, Correlation::matern52}) {
    for (const Trend trend : {Trend::constant, Trend::linear}) {
      options.correlation = correlation;
      options.trend = trend;
      kinds.push_back(options);
    }
  }
  return kinds;
}

/// A fit on this scale with noise from this source, judged by what such a fit expects (noise_model.hpp).
/// options: with Noise::nugget; freedom: the degrees of freedom of each standard error that runs tell.
inline WayToFit way_with_noise(std::string name, Scale scale, const ResponseRange& range,
                               const FitOptions& options, NoiseSource source,
                               double freedom = exactly_known) {
  return {std::move(name),
          [=](const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const Eigen::VectorXd& noise_variance) {
            return fit_with_noise(X, y, scale, range, options, source, noise_variance, freedom);
          },
          expected_noise(source, options, freedom)};
}

namespace detail {

/// −ln of the predicted density of y; on a bound of the probability of that bound.
inline double log_score(const PredictedRun& p, double y, const ResponseRange& range) {
  const double t = (transformed(p.transform, y) - p.mean) / p.deviation;
  if (y <= range.lower) return -log_normal_probability(t);
  if (y >= range.upper) return -log_normal_probability(-t);
  return negative_log_density(p, y);
}

/// The log_score() of each run as predicted without it.
inline Eigen::VectorXd left_out_scores(const TransformedModel& model, const ResponseRange& range) {
  const Validation v = leave_one_out(model);
  Eigen::VectorXd scores(v.observed.size());
  for (Eigen::Index i = 0; i < scores.size(); ++i)
    scores[i] = log_score(predicted_run(v, i), v.observed[i], range);
  return scores;
}

struct Gain {
  double mean = 0, standard_error = 0;
};

/// The mean of independent gains gᵢ by shares wᵢ, Σ wᵢ = 1, and its standard error. With S = Σ wᵢ² the mean's
/// variance is S times that of a gain, and E[Σ wᵢ² (gᵢ − mean)²] is S − 2 Σ wᵢ³ + S² times it; alike shares
/// make it the usual one. Infinite for one run.
inline Gain gain_of(const Eigen::VectorXd& gains, const Eigen::VectorXd& share) {
  const double mean = mean_by_share(share, gains);
  if (std::isinf(mean)) return {mean, 0.0};  // of what the first way holds impossible
  double squares = 0, cubes = 0, spread = 0;
  for (Eigen::Index i = 0; i < share.size(); ++i) {
    if (!(share[i] > 0)) continue;
    const double square = share[i] * share[i], off = gains[i] - mean;
    squares += square;
    cubes += square * share[i];
    spread += square * off * off;
  }
  const double seen = squares - 2 * cubes + squares * squares;
  return {mean, seen > 0 ? std::sqrt(spread * squares / seen) : std::numeric_limits<double>::infinity()};
}

/// share: what each run stands for, Σ = 1.
inline FitStanding standing_of(const std::string& name, const Eigen::VectorXd& scores,
                               const Eigen::VectorXd& first, const Eigen::VectorXd& share) {
  const Eigen::VectorXd gains = difference(first, scores);
  const Gain by_run = gain_of(gains, equal_shares(gains.size())), by_share = gain_of(gains, share);
  FitStanding standing{.name = name, .log_score = mean_of(scores)};
  standing.gain = by_run.mean;
  standing.standard_error = by_run.standard_error;
  standing.box_gain = by_share.mean;
  standing.box_standard_error = by_share.standard_error;
  return standing;
}

/// The share of the model's box that each of its runs stands for; equal shares where the model is a constant.
inline Eigen::VectorXd shares_of_runs(const TransformedModel& model) {
  const ModelState& s = model.model().state();
  return s.X.rows() == 0 ? equal_shares(model.runs()) : shares_of_box(s.X, s.correlation.levels);
}

/// The same for each row of X: n x d, natural units, where a way has averaged them to fewer runs.
inline Eigen::VectorXd shares_of_rows(const TransformedModel& model, const Eigen::MatrixXd& X) {
  const ModelState& s = model.model().state();
  return s.X.rows() == 0 ? equal_shares(X.rows()) : shares_of_box(s.input.apply(X), s.correlation.levels);
}

/// One per way, by its scores.
inline std::vector<FitStanding> standings_of(const std::vector<WayToFit>& ways,
                                             const std::vector<Eigen::VectorXd>& scores,
                                             const Eigen::VectorXd& share) {
  std::vector<FitStanding> table;
  for (std::size_t k = 0; k < ways.size(); ++k)
    table.push_back(standing_of(ways[k].name, scores[k], scores.front(), share));
  return table;
}

/// What ways are compared on.
struct ComparedRuns {
  const Eigen::MatrixXd& X;
  const Eigen::VectorXd& y;
  const ResponseRange& range;
  const RunNoise& noise;

  Eigen::VectorXd noise_of(const std::vector<Eigen::Index>& rows) const {
    return noise.variance.size() == 0 ? Eigen::VectorXd() : entries_of(noise.variance, rows);
  }
};

/// The runs of `out` as a model of those of `in` predicts them.
inline Validation validate_on(const TransformedModel& model, const ComparedRuns& runs,
                              const ExpectedNoise& noise, const std::vector<Eigen::Index>& in,
                              const std::vector<Eigen::Index>& out) {
  const Eigen::MatrixXd X = rows_of(runs.X, out);
  const Eigen::VectorXd y = entries_of(runs.y, out);
  if (!noise) return validate(model, X, y);
  return validate(model, X, y, noise(rows_of(runs.X, in), runs.noise_of(in), X, runs.noise_of(out)));
}

/// The log_score() of each run as predicted by the way fitted to the four fifths of the runs that it is not among.
inline Eigen::VectorXd refitted_scores(const ComparedRuns& runs, const WayToFit& way) {
  Eigen::VectorXd scores(runs.y.size());
  const Eigen::Index n = runs.X.rows();
  for (const std::vector<Eigen::Index>& out : folds_of(runs.X, 5, 1)) {
    const std::vector<Eigen::Index> in = rows_besides(out, n);
    const TransformedModel model = way.fitter(rows_of(runs.X, in), entries_of(runs.y, in), runs.noise_of(in));
    const Validation v = validate_on(model, runs, way.noise, in, out);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      scores[out[i]] = log_score(predicted_run(v, row), v.observed[row], runs.range);
    }
  }
  return scores;
}

/// Whether leave-one-out speaks for a way by more than chance. NaN, which constant models score, is no gain.
inline bool beats_first(const FitStanding& standing) {
  return standing.gain > standing.standard_error && standing.box_gain > standing.box_standard_error;
}

/// The places of the ways that beat the first, best first.
inline std::vector<std::size_t> better_standings(const std::vector<FitStanding>& table) {
  std::vector<std::size_t> better;
  for (std::size_t k = 1; k < table.size(); ++k)
    if (beats_first(table[k])) better.push_back(k);
  std::stable_sort(better.begin(), better.end(),
                   [&](std::size_t a, std::size_t b) { return table[a].box_gain > table[b].box_gain; });
  return better;
}

/// The best that also wins on runs that it has not seen, else the first. Writes the gains that it looks at.
inline std::size_t best_standing(const ComparedRuns& runs, const std::vector<WayToFit>& ways,
                                 const Eigen::VectorXd& share, std::vector<FitStanding>& table) {
  Eigen::VectorXd first;
  for (const std::size_t k : better_standings(table)) {
    if (first.size() == 0) first = refitted_scores(runs, ways.front());
    table[k].refitted_gain = mean_by_share(share, difference(first, refitted_scores(runs, ways[k])));
    if (table[k].refitted_gain > 0) return k;
  }
  return 0;
}

/// Throws std::invalid_argument that begins with `place`.
inline void check_ways(const std::string& place, const Eigen::MatrixXd& X, const std::vector<WayToFit>& ways,
                       const RunNoise& noise) {
  if (ways.empty()) throw std::invalid_argument(place + "0 ways; allowed is 1 or more; name at least one");
  if ((noise.noise != Noise::nugget && noise.noise != Noise::none) || noise.variance.size() > 0)
    check_run_noise(noise.variance, X.rows(), place);
}

/// Leave-one-out pairs ways by the runs of their models.
inline void check_same_runs(const std::vector<WayToFit>& ways, const std::vector<TransformedModel>& models) {
  for (std::size_t k = 1; k < ways.size(); ++k)
    if (models[k].runs() != models[0].runs())
      throw std::invalid_argument(
          "kriging::choose_fit: the model of way \"" + ways[k].name + "\" has " +
          std::to_string(models[k].runs()) + " runs but that of \"" + ways[0].name + "\" has " +
          std::to_string(models[0].runs()) +
          "; allowed are models of the same runs; average replicates in all ways or none");
}

}  // namespace detail

/// X: n x d, natural units; y: n, within the range. The first way is the one to keep without a reason. A way
/// is a function of the runs that it is given, which are fewer than all now and then. Noise that is known is
/// given to the ways that take it, and runs that a way was not fitted to are judged by the noise that it
/// expects of them (WayToFit::noise).
/// Throws std::invalid_argument without ways, for variances that are not one per run, for models of different
/// numbers of runs, and as the ways do.
inline FitChoice choose_fit(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const ResponseRange& range,
                            const std::vector<WayToFit>& ways, const RunNoise& noise = {}) {
  detail::check_ways("kriging::choose_fit: ", X, ways, noise);
  std::vector<TransformedModel> models;
  std::vector<Eigen::VectorXd> scores;
  for (const WayToFit& way : ways) {
    models.push_back(way.fitter(X, y, noise.variance));
    scores.push_back(detail::left_out_scores(models.back(), range));
  }
  detail::check_same_runs(ways, models);
  const TransformedModel& first = models.front();
  const Eigen::VectorXd of_runs = detail::shares_of_runs(first);
  const Eigen::VectorXd of_rows = first.runs() == X.rows() ? of_runs : detail::shares_of_rows(first, X);
  std::vector<FitStanding> table = detail::standings_of(ways, scores, of_runs);
  const std::size_t best = detail::best_standing({X, y, range, noise}, ways, of_rows, table);
  return {std::move(table), best, std::move(models[best])};
}

/// Each of these options as a way to fit on the scale of y, named by correlation and trend.
inline std::vector<WayToFit> ways_of(const std::vector<FitOptions>& kinds) {
  std::vector<WayToFit> ways;
  for (const FitOptions& kind : kinds)
    ways.push_back(
        {std::string(to_string(kind.correlation)) + ", " + std::string(to_string(kind.trend)),
         [kind](const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const Eigen::VectorXd& noise_variance) {
           const bool told = noise_variance.size() > 0 && kind.noise == Noise::nugget;
           if (told) return TransformedModel(fit(X, y, with_known_noise(kind, noise_variance)));
           FitOptions options = kind;
           options.noise_variance = noise_variance;
           return TransformedModel(fit(X, y, options));
         }});
  return ways;
}

/// Among such options: `choose_fit(X, y, usual_kinds())`. Those with a noise that is given per run take
/// `noise.variance`, those with Noise::nugget too where there is one. Throws as above.
inline FitChoice choose_fit(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                            const std::vector<FitOptions>& kinds, const ResponseRange& range = {},
                            const RunNoise& noise = {}) {
  std::vector<WayToFit> ways = ways_of(kinds);
  if (noise.variance.size() > 0)
    for (WayToFit& way : ways) way.noise = expected_noise(NoiseSource::told);
  return choose_fit(X, y, range, ways, noise);
}

/// The same by another rule, for ways that differ in where noise is taken from: leave-one-out holds each run
/// against the noise that this run tells, by chance next to none. Every way is fitted anew to four fifths of
/// the runs, five times, and judged on the rest by the noise that it expects there (WayToFit::noise). The best
/// is taken where its score is better than the first one's by more than one standard error, the first of a
/// single run; all runs count alike. FitStanding has these scores and gains. Cost: five fits per way and one.
inline FitChoice choose_refitted(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                                 const ResponseRange& range, const std::vector<WayToFit>& ways,
                                 const RunNoise& noise = {}) {
  detail::check_ways("kriging::choose_refitted: ", X, ways, noise);
  if (detail::sites_of(X).size() < 2)
    return {{{.name = ways[0].name}}, 0, ways[0].fitter(X, y, noise.variance)};
  std::vector<Eigen::VectorXd> scores;
  for (const WayToFit& way : ways) scores.push_back(detail::refitted_scores({X, y, range, noise}, way));
  std::vector<FitStanding> table = detail::standings_of(ways, scores, detail::equal_shares(X.rows()));
  const std::vector<std::size_t> better = detail::better_standings(table);
  const std::size_t best = better.empty() ? 0 : better.front();
  return {std::move(table), best, ways[best].fitter(X, y, noise.variance)};
}

/// Among the scales that the range allows, the linear one first. Throws as fit_transformed.
inline FitChoice choose_scale(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const ResponseRange& range,
                              const FitOptions& options = {}) {
  std::vector<WayToFit> ways;
  for (const Scale scale : {Scale::linear, Scale::square_root, Scale::logarithm, Scale::logit}) {
    if (!allows(range, scale)) continue;
    ways.push_back(
        {std::string(to_string(scale)),
         [scale, range, options](const Eigen::MatrixXd& P, const Eigen::VectorXd& v,
                                 const Eigen::VectorXd& noise_variance) {
           FitOptions of_runs = options;
           of_runs.noise_variance = noise_variance;
           if (options.noise == Noise::known || options.noise == Noise::pooled)
             of_runs = with_known_noise(options, noise_variance);
           return fit_transformed(P, v, scale, range, of_runs);
         },
         expected_noise(options.noise == Noise::known ? NoiseSource::told : NoiseSource::estimated)});
  }
  return choose_fit(X, y, range, ways, {options.noise, options.noise_variance});
}

}  // namespace drawpoint::kriging
