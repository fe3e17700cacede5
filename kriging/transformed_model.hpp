// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Kriging of a response on another scale (transform.hpp), with predictions on the response's own.
///
/// The model of z = g(y) predicts a normal z of mean m and variance v, and noise of variance τ². With
/// h(z) = E[g⁻¹(z + ε)], what noisy runs at z have in the mean,
///   mean        h(m): the median of h(z), what a run is expected to give where the model is sure
///   quantiles   h(m + t√v) of the latent function, g⁻¹(m + t√(v + τ²)) of a run; t the normal quantile
///   variance    the square of half the distance between the quantiles at t = −1 and t = 1: that of a normal
///               distribution with the same width between them; the moments would follow the far tail
/// Intervals are not symmetric about the mean: take quantile() for them. On the linear scale all of this is
/// the model's own, to the bit. Cost as the model's, gradient of the mean too.
///
/// Source of the back-transformation by quantiles: Chilès, Delfiner 2012, "Geostatistics", section 3.4.10
/// (lognormal Kriging, and why its mean is fragile where the variance is uncertain).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/detail/normal_quantile.hpp>
#include <drawpoint/kriging/acquisition.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/transform.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::kriging {

class TransformedModel {
 public:
  /// A model of y itself.
  TransformedModel(Model model)  // NOLINT: a model is one on the linear scale
      : model_(std::move(model)),
        observed_(model_.state().observed),
        noise_variance_(model_.noise_variance()) {}

  /// model: of transformed(transform, observed), n runs. Throws std::invalid_argument for another number.
  TransformedModel(Model model, Transform transform, Eigen::VectorXd observed)
      : model_(std::move(model)),
        transform_(transform),
        observed_(std::move(observed)),
        noise_variance_(model_.noise_variance()) {
    if (observed_.size() != model_.runs())
      throw std::invalid_argument("kriging::TransformedModel: " + std::to_string(observed_.size()) +
                                  " observations for a model of " + std::to_string(model_.runs()) +
                                  " runs; give the responses of its runs, on their own scale");
  }

  /// X: m x d, natural units. Throws as Model::predict.
  Prediction predict(const Eigen::MatrixXd& X, Target target = Target::latent) const {
    Prediction p = scaled(X, target);
    if (is_linear()) return p;
    for (Eigen::Index i = 0; i < p.mean.size(); ++i) {
      const double m = p.mean[i];
      p.mean[i] = mean_response(transform_, m, noise_variance_);
      p.variance[i] = squared_half(m, p.variance[i], target);
    }
    return p;
  }

  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const {
    Eigen::VectorXd m = model_.mean(X);
    if (is_linear()) return m;
    for (double& entry : m) entry = mean_response(transform_, entry, noise_variance_);
    return m;
  }

  /// That of probability p, one entry per row of X. Throws as predict, and std::invalid_argument for p
  /// outside of (0, 1).
  Eigen::VectorXd quantile(const Eigen::MatrixXd& X, double p, Target target = Target::latent) const {
    const double t = checked_normal_quantile(p);
    const Prediction z = scaled(X, target);
    Eigen::VectorXd q(X.rows());
    for (Eigen::Index i = 0; i < q.size(); ++i)  // 0 times ∞ is not the median of one run
      q[i] = back(t == 0 ? z.mean[i] : z.mean[i] + t * std::sqrt(std::max(z.variance[i], 0.0)), target);
    return q;
  }

  /// That of one run whose noise has this variance about y, one entry per row of X, >= 0, unit of y squared.
  /// Throws as quantile, and std::invalid_argument for other variances.
  Eigen::VectorXd run_quantile(const Eigen::MatrixXd& X, double p,
                               const Eigen::VectorXd& noise_variance) const {
    detail::check_run_noise(noise_variance, X.rows(), "kriging::TransformedModel: ");
    const double t = checked_normal_quantile(p);
    const Prediction z = scaled(X, Target::latent);
    Eigen::VectorXd q(X.rows());
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const double noise = noise_on_scale(transform_, z.mean[i], noise_variance[i]);
      const double variance = std::max(z.variance[i], 0.0) + noise;
      q[i] = back_transformed(transform_, t == 0 ? z.mean[i] : z.mean[i] + t * std::sqrt(variance));
    }
    return q;
  }

  /// The mean at one point x of d entries.
  double operator()(const Eigen::VectorXd& x) const { return mean(x.transpose())[0]; }
  static constexpr bool predicts = true;  ///< for doe::Predictor

  /// Its derivatives at one point x of d entries.
  Eigen::VectorXd mean_gradient(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd slope = model_.mean_gradient(x);
    if (is_linear()) return slope;
    return detail::affine(slope, mean_response_slope(transform_, model_(x), noise_variance_));
  }

  Eigen::Index variables() const { return model_.variables(); }
  Eigen::Index runs() const { return model_.runs(); }
  Status status() const { return model_.status(); }
  const std::string& message() const { return model_.message(); }
  const Model& model() const { return model_; }  ///< of z
  const Transform& transform() const { return transform_; }
  const Eigen::VectorXd& observed() const { return observed_; }  ///< n entries, unit of y
  /// τ², on the scale of z, that h is about.
  double noise_variance() const { return noise_variance_; }

  /// As kriging::leave_one_out.
  friend Validation leave_one_out(const TransformedModel& model) {
    Validation v = leave_one_out(model.model_);
    if (model.is_linear()) return v;
    v.transform = model.transform_;
    v.scaled_mean = v.predicted;
    v.scaled_variance = v.observation_variance;
    v.observed = model.observed_;
    for (Eigen::Index i = 0; i < v.observed.size(); ++i) {
      const double m = v.scaled_mean[i];
      v.predicted[i] = mean_response(model.transform_, m, model.noise_variance_);
      v.variance[i] = model.squared_half(m, v.variance[i], Target::latent);
      v.observation_variance[i] = model.squared_half(m, v.scaled_variance[i], Target::observation);
    }
    return detail::scored(std::move(v));
  }

  /// As kriging::reinterpolated; the mean stays.
  friend TransformedModel reinterpolated(const TransformedModel& model) {
    TransformedModel other = model;
    other.model_ = reinterpolated(model.model_);
    other.round_off_ = detail::variance_floor(other.model_);
    return other;
  }

  /// As kriging::fitted_values.
  friend Eigen::VectorXd fitted_values(const TransformedModel& model) {
    Eigen::VectorXd values = fitted_values(model.model_);
    if (model.is_linear()) return values;
    for (double& z : values) z = mean_response(model.transform_, z, model.noise_variance_);
    return values;
  }

 private:
  bool is_linear() const { return transform_.scale == Scale::linear; }

  static double checked_normal_quantile(double p) {
    if (!(p > 0 && p < 1))
      throw std::invalid_argument("kriging::TransformedModel: quantile of " + detail::text(p) +
                                  "; allowed are numbers between 0 and 1; use 0.025 and 0.975");
    return detail::normal_quantile(p);
  }

  // The prediction of z, without the round-off of an interpolating model.
  Prediction scaled(const Eigen::MatrixXd& X, Target target) const {
    Prediction p = model_.predict(X, target);
    if (round_off_ > 0)
      for (double& variance : p.variance) variance = variance > round_off_ ? variance : 0.0;
    return p;
  }

  double back(double z, Target target) const {
    if (target == Target::observation) return back_transformed(transform_, z);
    return mean_response(transform_, z, noise_variance_);
  }

  double squared_half(double m, double variance, Target target) const {
    const double deviation = std::sqrt(std::max(variance, 0.0));
    const double half = 0.5 * (back(m + deviation, target) - back(m - deviation, target));
    return half * half;
  }

  Model model_;
  Transform transform_;
  Eigen::VectorXd observed_;
  double noise_variance_ = 0;
  double round_off_ = 0;  // variances of z up to this are none
};

static_assert(SmoothSurrogate<TransformedModel> && Regression<TransformedModel>);

namespace detail {

/// One variance τ² on the scale of z by which the runs have the mean variance that they tell: the mean of
/// ((g⁻¹(z + τ) − g⁻¹(z − τ))/2)², as noise_on_scale has it of one run. Between the bounds of a logit τ is 8 at
/// most, by which all noise is as wide as they are. Bisected to round-off.
inline double pooled_on_scale(const Transform& t, const Eigen::VectorXd& y, const Eigen::VectorXd& variance) {
  const auto lacks = [&](double tau) {
    double sum = 0;
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const double z = transformed(t, y[i]);
      const double width = 0.5 * (back_transformed(t, z + tau) - back_transformed(t, z - tau));
      sum += width * width - variance[i];
    }
    return sum < 0;
  };
  double low = 0, high = 1;
  while (lacks(high) && (t.scale != Scale::logit || high < 8)) high *= 2;
  for (double middle = 0.5 * high; middle > low && middle < high; middle = 0.5 * (low + high))
    (lacks(middle) ? low : high) = middle;
  return high * high;
}

/// The options, checked, with the noise of each run as it is on the scale of z; `known` and `pooled` only.
inline FitOptions with_noise_on_scale(FitOptions options, const Transform& t, const Eigen::VectorXd& y) {
  if (options.noise == Noise::pooled) {
    options.noise_variance.setConstant(pooled_on_scale(t, y, options.noise_variance));
    return options;
  }
  for (Eigen::Index i = 0; i < y.size(); ++i)
    options.noise_variance[i] = noise_on_scale(t, transformed(t, y[i]), options.noise_variance[i]);
  return options;
}

}  // namespace detail

/// X: n x d, natural units; y: n, within the range. Variances of Noise::known and Noise::pooled are about y,
/// in its unit squared; those of Noise::proportional are taken for shares of the noise on the scale.
/// Throws as transform_for and fit.
inline TransformedModel fit_transformed(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, Scale scale,
                                        const ResponseRange& range, const FitOptions& options = {}) {
  const bool told = options.noise == Noise::known || options.noise == Noise::pooled;
  if (told) detail::check_noise(options, y.size());
  const Transform transform =
      transform_for(scale, y, range, told ? options.noise_variance : Eigen::VectorXd());
  if (transform.scale == Scale::linear) return fit(X, y, options);
  Eigen::VectorXd z = y;
  for (double& entry : z) entry = transformed(transform, entry);
  if (!told) return {fit(X, z, options), transform, y};
  return {fit(X, z, detail::with_noise_on_scale(options, transform, y)), transform, y};
}

}  // namespace drawpoint::kriging
