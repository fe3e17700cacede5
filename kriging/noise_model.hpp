// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The noise that a run has at a place, learnt from what runs tell of theirs.
///
/// Standard errors of a few samples are off by chance, two samples' by their own size, so a fit should not
/// take each for the truth (Noise::known), but draw it towards the others (moderated_noise.hpp). All together they
/// know one size of noise well: of n runs of k samples each it is off by 1/√(2n(k − 1)) of itself (Noise::pooled),
/// where the likelihood of the responses alone may be off by several times. Where noise varies smoothly over the
/// box, a Kriging model of all standard errors, on the scale of their logarithm, knows it better than any of them;
/// its own noise is how far samples miss. It expects of normal samples 0.8 to 1.0 of their deviation, two samples to
/// many. It does not know of a run that is worse than its neighbours. Sources: Ankenman, Nelson, Staum 2010,
/// Operations Research 58(2), "Stochastic Kriging for Simulation Metamodeling", section 4; Kersting, Plagemann,
/// Pfaff, Burgard 2007, ICML, "Most Likely Heteroscedastic Gaussian Process Regression" (the logarithm).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/training_data.hpp>
#include <drawpoint/kriging/moderated_noise.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace drawpoint::kriging {

/// Where a fit has the noise of its runs from.
enum class NoiseSource {
  estimated,  ///< by the likelihood of the responses, one size
  pooled,     ///< what the runs tell, together: one size on the scale that is fitted
  told,       ///< what each run tells, moderated by what all tell
  modelled,   ///< a model of what the runs tell
};

inline std::string_view to_string(NoiseSource source) {
  switch (source) {
    case NoiseSource::estimated:
      return "estimated";
    case NoiseSource::pooled:
      return "pooled";
    case NoiseSource::told:
      return "told";
    case NoiseSource::modelled:
      return "modelled";
  }
  return "unknown";
}

/// For runs whose noise is known to be this, n entries, unit of y squared, or, where options.noise is pooled,
/// estimated by these. Where all are exact, as a part of some runs may be, λ stays at its lower bound.
inline FitOptions with_known_noise(FitOptions options, const Eigen::VectorXd& noise_variance) {
  const bool noisy =
      std::any_of(noise_variance.begin(), noise_variance.end(), [](double v) { return v > 0; });
  if (options.noise != Noise::pooled) options.noise = Noise::known;
  if (!noisy) options.noise = Noise::nugget;
  options.noise_variance = noisy ? noise_variance : Eigen::VectorXd();
  if (!noisy) options.nugget_upper = options.nugget_lower;
  return options;
}

/// A model of the standard deviation of noise, unit of y. X: n x d, natural units; noise_variance: n, from 0 on, unit
/// of y squared; options: box, correlation and trend of the model, with Noise::nugget. Throws as fit.
inline TransformedModel fit_noise(const Eigen::MatrixXd& X, const Eigen::VectorXd& noise_variance,
                                  const FitOptions& options = {}) {
  detail::check_run_noise(noise_variance, X.rows(), "kriging::fit_noise: ");
  Eigen::VectorXd deviation = noise_variance;
  for (double& entry : deviation) entry = std::sqrt(entry);
  FitOptions of_samples = options;
  of_samples.may_be_exact = false;  // samples miss the noise by chance
  return fit_transformed(X, deviation, Scale::logarithm, {.lower = 0}, of_samples);
}

/// What it expects at the rows of X (m x d): m variances, unit of y squared.
inline Eigen::VectorXd noise_variance_at(const TransformedModel& noise, const Eigen::MatrixXd& X) {
  Eigen::VectorXd variance = noise.mean(X);
  for (double& entry : variance) entry = std::max(entry, 0.0) * std::max(entry, 0.0);
  return variance;
}

/// The options `known`, in which each run's noise variance, off by chance, becomes what a model of all expects there.
/// Throws std::invalid_argument for another noise than known, and as fit does for known noise.
inline FitOptions with_modelled_noise(const FitOptions& known, const Eigen::MatrixXd& X) {
  if (known.noise != Noise::known)
    throw std::invalid_argument("kriging::with_modelled_noise: noise is " +
                                std::string(to_string(known.noise)) +
                                "; allowed is known; give noise_variance with it");
  detail::check_noise(known, X.rows());
  FitOptions of_noise = known;
  of_noise.noise = Noise::nugget;
  of_noise.noise_variance.resize(0);
  return with_known_noise(known, noise_variance_at(fit_noise(X, known.noise_variance, of_noise), X));
}

/// Variances of noise of some runs, m entries, by where others lie (n x d) and what they tell (n), where these
/// lie (m x d) and what they tell (m), unit of y squared.
using ExpectedNoise =
    std::function<Eigen::VectorXd(const Eigen::MatrixXd& others, const Eigen::VectorXd& told_by_others,
                                  const Eigen::MatrixXd& X, const Eigen::VectorXd& told)>;

/// The degrees of freedom of standard errors that are known exactly.
inline constexpr double exactly_known = std::numeric_limits<double>::infinity();

/// What a fit with noise from there expects of runs that it has not seen; empty where that is one size, which
/// its model knows. options: as fit_noise; freedom: as fit_with_noise.
inline ExpectedNoise expected_noise(NoiseSource source, const FitOptions& options = {},
                                    double freedom = exactly_known) {
  using Runs = const Eigen::MatrixXd&;
  using Entries = const Eigen::VectorXd&;
  if (source == NoiseSource::told)
    return [freedom](Runs, Entries told_by_others, Runs, Entries told) -> Eigen::VectorXd {
      if (std::isinf(freedom)) return told;
      const SharedNoise shared =
          shared_noise(told_by_others, Eigen::VectorXd::Constant(told_by_others.size(), freedom));
      return told.unaryExpr([&](double v) { return shared.moderated(v, freedom); });
    };
  if (source != NoiseSource::modelled) return {};
  return [options](Runs others, Entries told_by_others, Runs X, Entries) {
    return noise_variance_at(fit_noise(others, told_by_others, options), X);
  };
}

/// A fit of runs that tell their noise as `source` has it. options: with Noise::nugget; noise_variance: n
/// entries, unit of y squared, none needed for `estimated`; freedom: the degrees of freedom of each of them, for
/// `told`. Throws as fit_transformed, fit_noise and shared_noise.
inline TransformedModel fit_with_noise(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, Scale scale,
                                       const ResponseRange& range, const FitOptions& options,
                                       NoiseSource source, const Eigen::VectorXd& noise_variance,
                                       double freedom = exactly_known) {
  if (source == NoiseSource::estimated) return fit_transformed(X, y, scale, range, options);
  FitOptions known = options;
  known.noise = source == NoiseSource::pooled ? Noise::pooled : Noise::known;
  known = with_known_noise(
      known, source == NoiseSource::told ? moderated_noise(noise_variance, freedom) : noise_variance);
  if (source == NoiseSource::modelled && known.noise == Noise::known) known = with_modelled_noise(known, X);
  return fit_transformed(X, y, scale, range, known);
}

}  // namespace drawpoint::kriging
