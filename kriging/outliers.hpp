// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Runs that do not belong to the response that the others have: a simulator that hit a rock, a wrong unit, a
/// disk that was full.
///
/// One such run spoils a model without a trace in its status: noise, or a short correlation, takes it up, and
/// every prediction is as uncertain as it is wrong. The screen asks leave-one-out, on the scale of the model,
/// for the run that the others put farthest from where it is. It is suspected if normal errors would put any
/// run so far with less than `level` of chance; then the model is fitted without it, and asked for the next.
/// In the end the others must be predicted better without the suspects: their leave-one-out errors fall, in
/// root mean square, to `spoilt` of what they were or less; else none is named. And each suspect is held
/// against the model without all of them, and let go if that one reaches it. More than `most` of the runs are
/// no outliers but noise that is not normal, or a step, and none is named either.
///
/// Cost: one leave-one-out where nothing is found, a fit per suspect besides. Deterministic. Nothing is
/// removed from anything: what a suspect is, its log must say.
///
/// Source: sequential deletion with a Bonferroni bound, as Cook, Weisberg 1982, "Residuals and Influence in
/// Regression", section 2.2.2, with the leave-one-out errors of Kriging (Dubrule 1983) in place of
/// studentised residuals.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/noise_model.hpp>
#include <drawpoint/kriging/score.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace drawpoint::kriging {

struct OutlierOptions {
  double level = 0.01;  ///< chance that normal runs have a suspect by their distance alone, 0 to 1
  double spoilt = 0.7;  ///< 0 to 1; 1: also those that do no harm
  double most = 0.1;    ///< share of the runs, 0 to 0.5
  /// What the runs tell of theirs, n entries, unit of y squared; the fitter may then be f(X, y,
  /// noise_variance). A suspect is judged by what it tells where the noise of the model differs from run to
  /// run, else by the model's one size.
  Eigen::VectorXd noise_variance = {};
  ExpectedNoise noise = {};  ///< what the fitter makes of that for runs that it has not seen; empty: as it is
};

struct Outlier {
  Eigen::Index run = 0;               ///< row of X
  double observed = 0, expected = 0;  ///< unit of y; expected by a model of the runs that are no outliers
  double lower = 0, upper = 0;        ///< where that model expects 95 of 100 runs at this point, unit of y
};

namespace detail {

/// The run farthest from where the others put it, and how far: in standard deviations on the model's scale.
struct Farthest {
  Eigen::Index run = 0;
  double deviations = 0;
};

inline double deviations_of(const PredictedRun& p, double y) {
  const double distance = std::abs(transformed(p.transform, y) - p.mean);
  return p.deviation > 0 ? distance / p.deviation : 0;  // a model that knows no error suspects nobody
}

inline Farthest farthest_run(const Validation& left_out) {
  Farthest found;
  for (Eigen::Index i = 0; i < left_out.observed.size(); ++i) {
    const double deviations = deviations_of(predicted_run(left_out, i), left_out.observed[i]);
    if (deviations > found.deviations) found = {i, deviations};
  }
  return found;
}

/// Whether normal errors put any of n runs so far with less than this chance.
inline bool too_far(double deviations, Eigen::Index n, double level) {
  return std::log(2.0 * static_cast<double>(n)) + log_normal_probability(-deviations) < std::log(level);
}

/// Root mean square of the errors of these runs, unit of y.
inline double error_of(const Validation& left_out, const std::vector<Eigen::Index>& rows) {
  const Eigen::VectorXd error = entries_of(difference(left_out.observed, left_out.predicted), rows);
  return std::sqrt(square(error) / static_cast<double>(rows.size()));
}

/// Fitted to these runs; with their noise where that is known and the fitter takes it.
template <class F>
TransformedModel fitted_to(const std::vector<Eigen::Index>& rows, const Eigen::MatrixXd& X,
                           const Eigen::VectorXd& y, const F& fitter, const Eigen::VectorXd& noise) {
  const Eigen::MatrixXd P = rows_of(X, rows);
  const Eigen::VectorXd v = entries_of(y, rows);
  if constexpr (std::is_invocable_v<const F&, const Eigen::MatrixXd&, const Eigen::VectorXd&,
                                    const Eigen::VectorXd&>)
    return fitter(P, v, noise.size() == 0 ? noise : entries_of(noise, rows));
  else
    return fitter(P, v);
}

/// The noise of the suspects, as a fit to `rows` expects it: by default what they report.
inline Eigen::VectorXd noise_of_suspects(const OutlierOptions& options, const Eigen::MatrixXd& X,
                                         const std::vector<Eigen::Index>& rows,
                                         const std::vector<Eigen::Index>& suspects) {
  const Eigen::VectorXd own = entries_of(options.noise_variance, suspects);
  if (!options.noise) return own;
  return options.noise(rows_of(X, rows), entries_of(options.noise_variance, rows), rows_of(X, suspects), own);
}

inline std::vector<Eigen::Index> without(std::vector<Eigen::Index> rows, Eigen::Index place) {
  rows.erase(rows.begin() + place);
  return rows;
}

}  // namespace detail

/// The outliers, in order of rows, among the runs X (n x d, natural units) and y (n) that `fitter(X, y)` fitted
/// `model` to. Throws std::invalid_argument for options out of range and another number of runs, and as the
/// fitter.
template <class F>
std::vector<Outlier> find_outliers(const TransformedModel& model, const Eigen::MatrixXd& X,
                                   const Eigen::VectorXd& y, const F& fitter,
                                   const OutlierOptions& options = {}) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("kriging::find_outliers: " + what);
  };
  if (X.rows() != model.runs() || y.size() != model.runs())
    reject(std::to_string(X.rows()) + " points and " + std::to_string(y.size()) +
           " responses for a model of " + std::to_string(model.runs()) +
           " runs; give those that it was fitted to");
  if (options.noise_variance.size() != 0)
    detail::check_run_noise(options.noise_variance, X.rows(), "kriging::find_outliers: ");
  for (const auto& [name, value, most] :
       {std::tuple("level", options.level, 1.0), std::tuple("spoilt", options.spoilt, 1.0),
        std::tuple("most", options.most, 0.5)})
    if (!(value >= 0 && value <= most))
      reject(std::string(name) + " is " + detail::text(value) + "; allowed is 0 to " + detail::text(most));

  std::vector<Eigen::Index> rows(static_cast<std::size_t>(X.rows())), suspects;
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  TransformedModel best = model;
  const Validation all = leave_one_out(model);
  Validation left_out = all;
  while (rows.size() >= 4) {
    const detail::Farthest far = detail::farthest_run(left_out);
    if (!detail::too_far(far.deviations, static_cast<Eigen::Index>(rows.size()), options.level)) break;
    suspects.push_back(rows[static_cast<std::size_t>(far.run)]);
    if (static_cast<double>(suspects.size()) > options.most * static_cast<double>(X.rows())) return {};
    rows = detail::without(std::move(rows), far.run);
    best = detail::fitted_to(rows, X, y, fitter, options.noise_variance);
    left_out = leave_one_out(best);
  }
  if (suspects.empty() || left_out.rmse > options.spoilt * detail::error_of(all, rows)) return {};

  std::sort(suspects.begin(), suspects.end());
  std::vector<Outlier> outliers;
  const Eigen::MatrixXd P = detail::rows_of(X, suspects);
  const Eigen::VectorXd observed = detail::entries_of(y, suspects), &noise = options.noise_variance;
  const bool by_own = noise.size() > 0 && model.model().state().noise.size() > 0;
  const Validation v =
      by_own ? validate(best, P, observed, detail::noise_of_suspects(options, X, rows, suspects))
             : validate(best, P, observed);
  for (std::size_t k = 0; k < suspects.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (detail::too_far(detail::deviations_of(detail::predicted_run(v, i), observed[i]), X.rows(),
                        options.level))
      outliers.push_back({suspects[k], observed[i], v.predicted[i], predicted_quantile(v, i, 0.025),
                          predicted_quantile(v, i, 0.975)});
  }
  return outliers;
}

}  // namespace drawpoint::kriging
