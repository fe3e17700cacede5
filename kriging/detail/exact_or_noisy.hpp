// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Whether runs of which no two are at the same point are those of a simulator without noise.
///
/// The default fit expects some noise (detail/prior.hpp), or pure noise would pass for signal. Of a response that is
/// rough for its runs it then takes the roughness for noise, and its intervals are far too narrow. The likelihood
/// tells the two apart, where it does. The runs are taken for exact where
/// * without noise, the prior of length scales kept, they are likelier by more than least_gain in ln L: noise of a
///   few per cent that is really there makes exact runs unlikelier, by 5 to 60 for 40 to 120 runs of smooth
///   functions;
/// * without noise they are likelier than noise about the trend alone, by more than one data set of a thousand of
///   such noise would have it: half of the 99.9 % quantile of χ² with a degree for each parameter of the correlation;
/// * they are predicted without themselves at least as well, by shares of the box (box_shares.hpp): of designs with
///   many corners the likeliest fit is now and then a poor one (choice.hpp);
/// * runs of the noisy model would not gain as much (simulated_gains.hpp), unless the gain is above sure_gain, three
///   times what noisy runs ever gained.
/// Three of 1152 sets of noisy runs are taken for exact (docs/measurements/kriging.md), with 0.76 to 1.13 of the
/// error; where a response is rough for its runs noise of a third of its deviation mostly is.
/// Where only some of these hold, or the runs are unlikelier without noise by no more than hardly_likely, up to 250
/// runs do not tell which of the two it is: the mean stays that of the noisy model, and variances hold both
/// explanations (model.hpp), by the ratio of their likelihoods. So a response that is taken for noise by mistake has
/// intervals that hold it.
///
/// Cost: two searches from few starts where the default finds noise, one more where it leaves doubt, a whole one where
/// the likelihoods come near, and up to two for each of sixteen simulated sets where only the last condition is left.

#include <cmath>
#include <drawpoint/kriging/detail/box_shares.hpp>
#include <drawpoint/kriging/detail/choice.hpp>
#include <drawpoint/kriging/detail/simulated_gains.hpp>
#include <drawpoint/kriging/model.hpp>
#include <drawpoint/kriging/options.hpp>
#include <memory>
#include <string>

namespace drawpoint::kriging::detail {

inline constexpr double least_gain = 2.0;
inline constexpr double sure_gain = 30.0;
inline constexpr double little_noise = 1e-4;  ///< over the variance of the runs: less matters to no interval
inline constexpr double as_well = 1.1;        ///< a mean square up to so many times another one is as good

/// Whether the noise that a fit found may be the default's expectation.
inline bool may_be_expected(const Model& noisy, const TrainingData& data, const FitOptions& options) {
  const bool expects_noise = options.may_be_exact && options.nugget_power > 0 &&
                             options.estimation == Estimation::penalized_likelihood;
  const bool free = options.nugget_lower <= exact_nugget && options.nugget_upper > exact_nugget;
  return expects_noise && free && noisy.nugget() > exact_nugget && std::isfinite(noisy.log_likelihood()) &&
         data.X.rows() > data.F.cols() + 1;
}

/// 99.9 % quantile of χ², by Wilson and Hilferty's cube, to 1 % from one degree on.
inline double chance_quantile(double degrees) {
  const double share = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - share + 3.0902 * std::sqrt(share), 3);
}

/// Whether an exact model is likelier than noise about the trend would make it.
inline bool is_more_than_noise(const Model& exact, const TrainingData& data, const FitOptions& options) {
  Likelihood likelihood(likelihood_problem(data, options));
  likelihood.value(uncorrelated(parameter_box(data, likelihood, options), options));
  const double of_noise =
      likelihood.estimates().log_likelihood - static_cast<double>(data.X.rows()) * std::log(data.y_scale);
  const auto degrees = static_cast<double>(exact.theta().size() + exact.correlation().exponent.size());
  return exact.log_likelihood() - of_noise > 0.5 * chance_quantile(degrees);
}

/// By leave-one-out errors, each run counted by its share of the box.
inline bool predicts_as_well(const Model& exact, const Model& noisy) {
  const ModelState &e = exact.state(), &n = noisy.state();
  const Eigen::VectorXd share = shares_of_box(n.X, n.correlation.levels);
  return squares_left_out(e.L, e.gls, e.X, share) <= as_well * squares_left_out(n.L, n.gls, n.X, share);
}

/// The model with a sentence of its choice.
inline Model said_exact(const Model& exact, const Model& noisy, double gain) {
  ModelState state = exact.state();
  const std::string part = state.X.rows() > many ? ", by " + std::to_string(many) + " of them," : "";
  state.report.message += "; the model meets the runs, which are" + part + " e^" + brief_text(gain) +
                          " times as likely without noise as with noise of " +
                          brief_text(std::sqrt(noisy.noise_variance())) +
                          ": repeat a run if the simulator may have some";
  return Model(std::move(state));
}

/// Whether it matters that the runs may be exact, which gain so much without noise.
inline bool leaves_doubt(const Model& noisy, const TrainingData& data, double gain) {
  return gain > hardly_likely && data.X.rows() <= many &&
         noisy.noise_variance() > little_noise * data.y_scale * data.y_scale;
}

/// The noisy model with the exact one beside it, as likely as what the runs gain by that.
inline Model in_doubt(const Model& noisy, const Model& exact, double gain) {
  ModelState state = noisy.state();
  state.other = std::make_shared<const ModelState>(exact.state());
  state.doubt = doubt_of(gain);
  state.report.message += "; the runs do not tell whether there is noise of " +
                          brief_text(std::sqrt(noisy.noise_variance())) + " or none, of probability " +
                          brief_text(state.doubt) + ": variances hold both; repeat a run to know";
  return Model(std::move(state));
}

}  // namespace drawpoint::kriging::detail
