// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How well a model predicts runs that it has not seen; the numbers are those of score.hpp.
///
/// Use runs drawn independently of the training runs.

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/score.hpp>
#include <drawpoint/kriging/surrogate.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::kriging {

namespace detail {

inline Validation scored(Validation v) {
  v.rmse = score(v, ErrorFunction::rmse);
  v.nrmse = score(v, ErrorFunction::nrmse);
  return v;
}

inline void check_validation(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const std::string& place) {
  const auto reject = [&](const std::string& what) { throw std::invalid_argument(place + what); };
  if (X.rows() != y.size())
    reject("X has " + std::to_string(X.rows()) + " rows but y has " + std::to_string(y.size()) +
           " entries; give one response a run");
  if (X.rows() == 0) reject("X has 0 runs; allowed is 1 or more; give runs that the model has not seen");
  if (!all_finite(y))
    reject("y holds a number that is not finite; allowed are finite numbers; leave failed runs out");
}

/// What is predicted of the runs where their noise is this, on another scale than that of y. `latent`:
/// variance of the latent function on the scale.
inline void set_run_noise(Validation& v, const Eigen::VectorXd& latent,
                          const Eigen::VectorXd& noise_variance) {
  for (Index i = 0; i < v.observed.size(); ++i) {
    v.scaled_variance[i] = latent[i] + noise_on_scale(v.transform, v.scaled_mean[i], noise_variance[i]);
    const PredictedRun run = predicted_run(v, i);
    const double half = 0.5 * (run.quantile(1) - run.quantile(-1));
    v.observation_variance[i] = half * half;
  }
}

/// Surrogates whose predictions are normal on another scale than that of y.
template <class S>
concept OnAnotherScale = requires(const S& s, const Eigen::MatrixXd& X) {
  { s.transform() } -> std::convertible_to<Transform>;
  { s.model().predict(X, Target::observation) } -> std::convertible_to<Prediction>;
};

}  // namespace detail

/// X: n x d, natural units; y: n. Throws std::invalid_argument for no runs, unequal lengths and numbers that
/// are not finite.
template <class S>
Validation validate(const S& model, const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  static_assert(
      Surrogate<S>,
      "drawpoint: not a surrogate. Expected predict(X), predict(X, Target) giving a Prediction and mean(X) "
      "giving an Eigen::VectorXd, X an Eigen::MatrixXd with one point per row");
  detail::check_validation(X, y, "kriging::validate: ");
  const Prediction p = model.predict(X);
  Validation v{.observed = y,
               .predicted = p.mean,
               .variance = p.variance,
               .observation_variance = model.predict(X, Target::observation).variance};
  if constexpr (detail::OnAnotherScale<S>) {
    const Prediction z = model.model().predict(X, Target::observation);
    v.transform = model.transform();
    v.scaled_mean = z.mean;
    v.scaled_variance = z.variance;
  }
  return detail::scored(std::move(v));
}

/// The same for runs whose noise is known: of variance noise_variance, n entries from 0 on in the unit of y
/// squared, whatever noise the model expects of a run. Throws also for other numbers of them.
template <class S>
Validation validate(const S& model, const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                    const Eigen::VectorXd& noise_variance) {
  detail::check_run_noise(noise_variance, X.rows(), "kriging::validate: ");
  Validation v = validate(model, X, y);
  for (Eigen::Index i = 0; i < y.size(); ++i) v.observation_variance[i] = v.variance[i] + noise_variance[i];
  if constexpr (detail::OnAnotherScale<S>)
    if (v.transform.scale != Scale::linear)
      detail::set_run_noise(v, model.model().predict(X).variance, noise_variance);
  return detail::scored(std::move(v));
}

}  // namespace drawpoint::kriging
