// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What fit.hpp declares.

#include <Eigen/Core>
#include <algorithm>
#include <drawpoint/kriging/detail/blind.hpp>
#include <drawpoint/kriging/detail/compiled.hpp>
#include <drawpoint/kriging/detail/exact_or_noisy.hpp>
#include <drawpoint/kriging/detail/fit_prepared.hpp>
#include <drawpoint/kriging/detail/joined_repeats.hpp>
#include <drawpoint/kriging/detail/sites.hpp>
#include <drawpoint/kriging/detail/training_data.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <vector>

namespace drawpoint::kriging {
namespace detail {

/// Without noise but for round-off, its length scales expected as before.
inline FitOptions without_noise(FitOptions options) {
  options.nugget_upper = std::max(options.nugget_lower, std::min(options.nugget_upper, exact_nugget));
  options.nugget_power = 0;
  return options;
}

/// What Noise::none stands for.
inline FitOptions with_exact_runs(const FitOptions& options) {
  FitOptions exact = without_noise(options);
  exact.estimation = Estimation::maximum_likelihood;
  return exact;
}

/// The model of these data, with the trend that the options ask for.
inline Model fit_to(const Eigen::MatrixXd& X, const TrainingData& data, const FitOptions& options) {
  const Model model = fit_prepared(data, options);
  if (options.trend != Trend::blind) return model;
  const std::vector<TrendTerm> terms = blind_terms(model.state());
  if (terms.size() == 1) return model;
  TrainingData chosen = data;
  set_trend(chosen, X, {terms, {}, {}});
  const Model blind = fit_prepared(chosen, options);
  return leave_one_out_error(blind.state()) < leave_one_out_error(model.state()) ? blind : model;
}

/// Whether runs that gain so much without noise are exact: `exact` is the model that meets them.
inline bool are_exact(const Model& exact, const Model& noisy, const TrainingData& data, double gain,
                      const FitOptions& options) {
  return is_more_than_noise(exact, data, options) && predicts_as_well(exact, noisy) &&
         (gain >= sure_gain || beyond_chance(gain, noisy.state(), data, without_noise(options), options));
}

/// The same, but without noise where the runs are clearly likelier without any, and with both explanations where the
/// runs do not tell.
inline Model fit_either(const Eigen::MatrixXd& X, const TrainingData& data, const FitOptions& options) {
  const Model noisy = fit_to(X, data, options);
  if (!may_be_expected(noisy, data, options)) return noisy;
  const FitOptions without = without_noise(options);
  const double gain = gain_of(data, without, options);
  if (gain > least_gain) {
    const Model exact = fit_to(X, data, with_exact_runs(options));
    if (are_exact(exact, noisy, data, gain, options)) return said_exact(exact, noisy, gain);
  }
  return leaves_doubt(noisy, data, gain) ? in_doubt(noisy, fit_to(X, data, with_few_searches(without)), gain)
                                         : noisy;
}

/// Fits the first run of each site in a way, fit_to or fit_either; the others join that model.
template <class Way>
Model fit_once_each(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                    const std::vector<std::vector<Eigen::Index>>& sites, const FitOptions& options,
                    const Way& way, const std::string& said) {
  const std::vector<Eigen::Index> once = first_runs(sites);
  const Eigen::MatrixXd distinct = rows_of(X, once);
  const TrainingData data = prepare(distinct, entries_of(y, once), options);
  return with_repeats(way(distinct, data, options), X, y, said);
}

}  // namespace detail

DRAWPOINT_KRIGING_INLINE Model fit(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                                   const FitOptions& given) {
  const FitOptions options = given.noise == Noise::none ? detail::with_exact_runs(given) : given;
  const detail::TrainingData data = detail::prepare(X, y, options);
  if (data.y.size() == 0) return detail::constant_model(data, options);
  if (given.noise == Noise::none || given.noise == Noise::nugget) {
    const auto sites = detail::sites_of(X);
    const bool agree = detail::repeats_agree(sites, y);
    if (agree && given.noise == Noise::nugget && !given.may_be_exact)
      return detail::fit_once_each(X, y, sites, options, detail::fit_to, "which is chance beside noise");
    if (agree) {
      if (const auto trend = detail::exact_trend(data, options))
        return *trend;  // repeats count as runs for that
      if (given.noise == Noise::nugget && !detail::agreement_tells(sites, y))
        return detail::fit_once_each(X, y, sites, options, detail::fit_either,
                                     "as others do, which tells little");
      return detail::fit_once_each(X, y, sites, detail::with_exact_runs(given), detail::fit_to,
                                   "so the simulator is taken to be exact");
    }
    if (given.noise == Noise::nugget && static_cast<Eigen::Index>(sites.size()) == X.rows())
      return detail::fit_either(X, data, options);
  }
  return detail::fit_to(X, data, options);
}

}  // namespace drawpoint::kriging
