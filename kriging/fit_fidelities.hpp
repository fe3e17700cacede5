// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Fits co-Kriging to runs of several fidelities: `fit_fidelities({{"rough", Xc, yc}, {"true", Xt, yt}})`.
///
/// Levels go from the cheapest to the true one; each is fitted given those below
/// (detail/fit_cokriging_level.hpp). True runs need not be among the cheap ones. Unless told otherwise the
/// fit ends by asking leave-one-out whether the cheap runs helped: it fits the true runs alone as well and
/// says in message() which of both predicts them better; choose_fidelities() takes that one. Cost: the fits,
/// and n³ of each level per true run. Deterministic.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <drawpoint/kriging/any_surrogate.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/fidelity_model.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/replicates.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

/// Runs of one fidelity.
struct FidelityLevel {
  std::string name;
  Eigen::MatrixXd X;  ///< n x d, one run per row, natural units
  Eigen::VectorXd y;  ///< n
  /// The options of its Kriging model, above the cheapest level that of the difference from ρ times the level below.
  /// Noise is that of the level's own runs. The box is by default the range of the runs of all levels; above the
  /// cheapest level `trend` is constant, linear or quadratic.
  FitOptions options = {};
};

struct FidelityOptions {
  Trend rho = Trend::constant;  ///< or linear: ρ varies with the inputs, at the price of d coefficients
  bool compare = true;          ///< with the true runs alone; costs one more fit and a leave-one-out
};

namespace detail {

[[noreturn]] inline void reject_fidelities(const std::string& what) {
  throw std::invalid_argument("kriging::fit_fidelities: " + what);
}

inline std::string place_of(const std::vector<FidelityLevel>& levels, std::size_t t) {
  return "level " + (levels[t].name.empty() ? std::to_string(t) : "\"" + levels[t].name + "\"") + ": ";
}

/// Bounds of the runs of all levels, where the options of a level give none.
inline FitOptions with_box(const std::vector<FidelityLevel>& levels, FitOptions options) {
  if (options.lower.size() > 0 || options.upper.size() > 0) return options;
  options.lower = levels[0].X.colwise().minCoeff();
  options.upper = levels[0].X.colwise().maxCoeff();
  for (const FidelityLevel& level : levels) {
    options.lower = options.lower.cwiseMin(level.X.colwise().minCoeff().transpose());
    options.upper = options.upper.cwiseMax(level.X.colwise().maxCoeff().transpose());
  }
  for (Index k = 0; k < options.lower.size(); ++k)  // fit() asks for a box of some width
    if (options.lower[k] == options.upper[k]) options.upper[k] += 1.0 + std::abs(options.upper[k]);
  return options;
}

inline void check_runs_of_level(const std::vector<FidelityLevel>& levels, std::size_t t) {
  const FidelityLevel& level = levels[t];
  const std::string place = place_of(levels, t);
  try {
    check_runs(level.X, level.y);
    check_options(level.options, level.X.cols());
    check_noise(level.options, level.X.rows());
    require_levels("kriging::fit", level.X, level.options.levels);
  } catch (const std::invalid_argument& e) {
    const std::string text = e.what();
    reject_fidelities(place + text.substr(text.find(": ") + 2));
  }
  if (level.X.cols() != levels[0].X.cols())
    reject_fidelities(place + "X has " + std::to_string(level.X.cols()) +
                      " columns but that of the cheapest level has " + std::to_string(levels[0].X.cols()) +
                      "; give all levels the same variables");
  if (categories_of(level.options.levels) != categories_of(levels[0].options.levels))
    reject_fidelities(place +
                      "its options.levels differ from those of the cheapest level; allowed are the same "
                      "categories everywhere; give all levels the same");
  if (level.options.structure != Structure::product)
    reject_fidelities(place + "its options.structure is " + std::string(to_string(level.options.structure)) +
                      "; allowed with several levels is product; leave it at that");
  if (is_constant(level.y))
    reject_fidelities(place + "all " + std::to_string(level.y.size()) + " responses equal " +
                      text(level.y[0]) +
                      "; allowed are levels that vary; leave the level out, or check its response");
  if ((level.X.rowwise() - level.X.row(0)).isZero(0.0))
    reject_fidelities(place + "all " + std::to_string(level.y.size()) +
                      " runs have the same inputs; allowed are two points or more; run it at other points");
}

inline Index distinct_places(const FidelityLevel& level) {
  return static_cast<Index>(sites_of(level.X).size());
}

/// "5 runs at 3 places": places only where there are fewer.
inline std::string count_of_runs(const FidelityLevel& level) {
  const Index runs = level.X.rows(), places = distinct_places(level);
  return std::to_string(runs) + " runs" +
         (places < runs ? " at " + std::to_string(places) + " places" : std::string());
}

/// A mean, s² and θ of each variable, and a run that may contradict them.
inline void check_cheapest_level(const std::vector<FidelityLevel>& levels) {
  const Index least = levels[0].X.cols() + 3;
  if (distinct_places(levels[0]) < least)
    reject_fidelities(place_of(levels, 0) + count_of_runs(levels[0]) +
                      " for a Kriging model to build on; allowed at the cheapest level is variables + 3 = " +
                      std::to_string(least) +
                      " places or more; make more cheap runs, or use kriging::fit of the level "
                      "above");
}

inline void check_level_above(const std::vector<FidelityLevel>& levels, std::size_t t, Trend rho) {
  const FidelityLevel& level = levels[t];
  const Trend trend = level.options.trend;
  if (trend == Trend::user || trend == Trend::blind)
    reject_fidelities(place_of(levels, t) + "its trend is " + (trend == Trend::user ? "user" : "blind") +
                      "; allowed above the cheapest level are constant, linear and quadratic; use constant");
  const int d = static_cast<int>(level.X.cols());
  const std::size_t terms = polynomial(d, trend).size() + polynomial(d, rho).size();
  const bool repeated = level.X.rows() > static_cast<Index>(terms);
  if (distinct_places(level) < static_cast<Index>(terms) + 1)
    reject_fidelities(place_of(levels, t) + count_of_runs(level) + " for " + std::to_string(terms) +
                      " coefficients of rho and the trend; allowed is " + std::to_string(terms + 1) +
                      (repeated ? " places or more; make runs at other places" : " or more; make more runs") +
                      (terms > 2 ? ", or make rho and the trend constant" : ""));
}

inline void check_levels(const std::vector<FidelityLevel>& levels, const FidelityOptions& options) {
  if (levels.size() < 2)
    reject_fidelities(
        std::to_string(levels.size()) +
        " levels; allowed is 2 or more, from the cheapest to the true one; use kriging::fit for "
        "one");
  if (options.rho != Trend::constant && options.rho != Trend::linear)
    reject_fidelities("rho is neither constant nor linear; allowed are these; use constant");
  for (std::size_t t = 0; t < levels.size(); ++t) {
    check_runs_of_level(levels, t);
    if (t == 0)
      check_cheapest_level(levels);
    else
      check_level_above(levels, t, options.rho);
  }
}

inline std::string sentence_of(const FidelityLevelReport& level) {
  const std::string name = "level \"" + level.name + "\"";
  if (level.rho.size() == 0)
    return name +
           ": what the level below says at its runs cannot be told from its trend, or from the error of that "
           "level's model, so rho is left out";
  std::string text =
      name + ": rho " + brief_text(level.rho[0]) + " +- " + brief_text(level.rho_standard_error[0]);
  if (level.rho.size() > 1) text += " at the centre";
  return text + ", " + brief_text(100.0 * level.explained) +
         " % of the variance is the level below's, the rest the difference's";
}

inline std::string sentence_of(const FidelityComparison& c) {
  if (std::isnan(c.gain))
    return "the true runs cannot tell whether the cheaper levels help: without one of them the others do not "
           "tell rho from the trend; leave-one-out RMSE " +
           brief_text(c.rmse_alone) + " without the cheaper levels; make more true runs";
  const std::string errors = ": leave-one-out RMSE " + brief_text(c.rmse) + " with the cheaper levels, " +
                             brief_text(c.rmse_alone) + " without; gain in log score " + brief_text(c.gain) +
                             " +- " + brief_text(c.standard_error) + " per run";
  if (c.gain > c.standard_error) return "the cheaper levels help" + errors;
  if (c.gain < -c.standard_error)
    return "the cheaper levels do not help, a fit of the true runs alone is better" + errors +
           "; use kriging::choose_fidelities, or kriging::fit of the true runs";
  return "the true runs cannot tell whether the cheaper levels help" + errors;
}

inline FidelityModel fit_checked(const std::vector<FidelityLevel>& levels, Trend rho) {
  CokrigingLevels fitted;
  for (std::size_t t = 0; t < levels.size(); ++t) {
    const LevelRuns runs{levels[t].name.empty() ? std::to_string(t) : levels[t].name, levels[t].X,
                         levels[t].y, with_box(levels, levels[t].options)};
    fitted.push_back(
        t == 0 ? fit_cheapest_level(runs)
               : fit_level_above(fitted, runs,
                                 polynomial(static_cast<int>(runs.X.cols()), rho, runs.options.levels)));
  }
  FidelityReport report;
  for (const CokrigingLevel& level : fitted) report.levels.push_back(report_of(level));
  for (std::size_t t = 1; t < fitted.size(); ++t)
    report.message += (t > 1 ? "; " : "") + sentence_of(report.levels[t]);
  return {std::move(fitted), std::move(report)};
}

/// Scores of each run by what is predicted of it without it.
inline Eigen::VectorXd scores_of(const Validation& v) {
  Eigen::VectorXd scores(v.observed.size());
  for (Index i = 0; i < scores.size(); ++i)
    scores[i] = negative_log_density(predicted_run(v, i), v.observed[i]);
  return scores;
}

inline FidelityComparison compared(const FidelityModel& model, const Model& alone) {
  const Validation with = leave_one_out(model), without = leave_one_out(alone);
  const FitStanding standing =
      standing_of("co-Kriging", scores_of(with), scores_of(without), equal_shares(with.observed.size()));
  return {with.rmse, without.rmse, standing.gain, standing.standard_error};
}

struct ComparedFits {
  FidelityModel cokriging;
  Model alone;
};

inline ComparedFits fit_and_compare(const std::vector<FidelityLevel>& levels,
                                    const FidelityOptions& options) {
  check_levels(levels, options);
  FidelityModel model = fit_checked(levels, options.rho);
  Model alone = fit(levels.back().X, levels.back().y, with_box(levels, levels.back().options));
  FidelityReport report = model.report();
  report.comparison = compared(model, alone);
  report.message = sentence_of(report.comparison) + "; " + report.message;
  return {FidelityModel(model.levels(), std::move(report)), std::move(alone)};
}

}  // namespace detail

/// Throws std::invalid_argument for fewer than two levels, levels of other variables, without runs, of
/// constant response or of one point, runs at fewer places than there are coefficients of ρ and the trend and
/// one more, d + 3 at the cheapest level, and as fit().
inline FidelityModel fit_fidelities(const std::vector<FidelityLevel>& levels,
                                    const FidelityOptions& options = {}) {
  if (options.compare) return detail::fit_and_compare(levels, options).cokriging;
  detail::check_levels(levels, options);
  return detail::fit_checked(levels, options.rho);
}

/// Co-Kriging or the true runs alone.
struct FidelityChoice {
  bool cokriging = true;  ///< else the true runs alone
  AnySurrogate model;     ///< a FidelityModel or a Model
  FidelityReport report;  ///< of co-Kriging, with the comparison
};

/// Co-Kriging unless leave-one-out finds the true runs alone better by more than one standard error; so also
/// where it cannot tell. Throws as fit_fidelities.
inline FidelityChoice choose_fidelities(const std::vector<FidelityLevel>& levels,
                                        const FidelityOptions& options = {}) {
  detail::ComparedFits fits = detail::fit_and_compare(levels, options);
  const FidelityReport report = fits.cokriging.report();
  const bool cokriging = !(report.comparison.gain < -report.comparison.standard_error);
  return {cokriging,
          cokriging ? AnySurrogate(std::move(fits.cokriging)) : AnySurrogate(std::move(fits.alone)), report};
}

/// A fitter of true runs above cheaper levels that stay: for k_fold, hold_out, compare and assess. `levels`
/// are those below the true one, `options` the true level's. The levels below are fitted once; their runs at
/// the place of a run that is left out stay, so leave_one_out() is the stricter of both where designs are
/// nested.
class FidelityFitter {
 public:
  FidelityFitter(std::vector<FidelityLevel> levels, FitOptions options = {}, Trend rho = Trend::constant)
      : levels_(std::move(levels)), options_(std::move(options)), rho_(rho) {}

  FidelityModel operator()(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) const {
    std::vector<FidelityLevel> all = levels_;
    all.push_back({"true", X, y, options_});
    return fit_fidelities(all, {.rho = rho_, .compare = false});
  }

 private:
  std::vector<FidelityLevel> levels_;
  FitOptions options_;
  Trend rho_;
};

static_assert(Fitter<FidelityFitter>);

}  // namespace drawpoint::kriging
