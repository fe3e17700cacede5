// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A fitted Kriging model. A value: copy it, share it between threads.
///
/// With r = c(x, X), the correlations of x with the runs, without λ, and f = f(x) the terms of the trend:
///   mean        ŷ(x)    = fᵀβ + rᵀα
///   variance    s²(x)   = s² [1 − rᵀR⁻¹r + uᵀ(FᵀR⁻¹F)⁻¹u],  u = f − FᵀR⁻¹r
///   covariance  s²(x,z) = s² [c(x, z) − rₓᵀR⁻¹r_z + uₓᵀ(FᵀR⁻¹F)⁻¹u_z]
/// The last terms are what estimating β adds; unless FitOptions says otherwise there is one more, gᵀVg for
/// what estimating θ, the exponents and λ adds (detail/parameter_uncertainty.hpp). Where the runs do not tell noise
/// from roughness the variance holds both explanations: with s² of the one and, of probability p, ŷₒ and sₒ² of the
/// other, it is s² + p max(0, sₒ² + (ŷₒ − ŷ)² − s²) (detail/exact_or_noisy.hpp). This is about the latent
/// function, the response without noise; its variance does not vanish at the runs when λ > 0. A new noisy
/// observation has the variance s²(x) + (1 − p) λ s², where runs of different noise have their mean. Units: mean in
/// the unit of y, variance in its square. Cost a point: mean n d, variance n² more, covariance of m points m
/// n² + m² n. Source: Forrester, Keane, Bressloff 2006, AIAA Journal 44(10), "Design and Analysis of 'Noisy'
/// Computer Experiments"; universal Kriging: Santner, Williams, Notz 2003, section 3.3.

#include <Eigen/Core>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/model_state.hpp>
#include <drawpoint/kriging/detail/parameter_uncertainty.hpp>
#include <drawpoint/kriging/options.hpp>
#include <memory>
#include <string>
#include <utility>

namespace drawpoint::kriging {

struct Prediction {
  Eigen::VectorXd mean, variance;  ///< one entry per point
};

/// Derivatives by the d inputs at one point: [unit of y / unit of x] and [unit of y squared / unit of x].
struct PredictionGradient {
  Eigen::VectorXd mean, variance;
};

/// What a variance is about: the response without noise, or one more run of it.
enum class Target { latent, observation };

class Model {
 public:
  /// Made by fit() and by what changes a model.
  explicit Model(detail::ModelState state);

  /// X: m x d, natural units. Throws std::invalid_argument for another number of columns, for numbers that
  /// are not finite and for what is no level of a category. threads share blocks of 128 points, 0: all cores; the
  /// bits do not depend on them.
  Prediction predict(const Eigen::MatrixXd& X, Target target = Target::latent, int threads = 1) const;

  /// The mean alone, at a fraction of the cost. Throws as predict.
  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const;

  /// The mean at one point x of d entries: a model is a black box itself.
  double operator()(const Eigen::VectorXd& x) const { return mean(x.transpose())[0]; }
  static constexpr bool predicts = true;  ///< for doe::Predictor

  /// Derivatives of the latent mean and variance at one point x of d entries; 0 by a category, which has
  /// none. Cost n² + n d². Throws as predict.
  PredictionGradient gradient(const Eigen::VectorXd& x) const;

  /// Its mean alone, at a fraction of the cost: n d. Throws as predict.
  Eigen::VectorXd mean_gradient(const Eigen::VectorXd& x) const;

  /// Joint covariance of the latent function at the rows of X: m x m, symmetric. Throws as predict.
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& X) const;

  Eigen::Index variables() const { return s_.input.centre.size(); }
  Eigen::Index runs() const { return s_.observed.size(); }
  const CorrelationFunction& correlation() const { return s_.correlation; }
  /// d entries, on inputs scaled to [-1, 1]: how fast the response varies with each input.
  const Eigen::VectorXd& theta() const { return s_.correlation.theta; }
  double nugget() const { return s_.nugget; }  ///< λ
  /// s², unit of y squared.
  double process_variance() const { return s_.y_scale * s_.y_scale * s_.process_variance; }
  double noise_variance() const { return s_.nugget * process_variance(); }  ///< λ s², unit of y squared
  /// Probability that there is no noise, by the ratio of the likelihoods, at most 0.99; variances hold that, too. 0
  /// where one explanation alone is likely.
  double doubt() const { return s_.doubt; }
  /// Coefficient of the trend's first term, the constant unless the user's basis begins with another.
  double trend() const { return s_.y_centre + (s_.X.rows() ? s_.y_scale * s_.gls.beta[0] : 0.0); }
  /// One entry a term, unit of y over the unit of the term, in the order of trend_function(). The first term
  /// lacks the mean of the runs, which trend() includes.
  Eigen::VectorXd trend_coefficients() const { return detail::affine(s_.gls.beta, s_.y_scale); }
  const detail::TrendFunction& trend_function() const { return s_.trend; }
  /// Concentrated log likelihood in the unit of y; +∞ for a constant response and an exact trend.
  double log_likelihood() const { return s_.log_likelihood; }
  const FitReport& report() const { return s_.report; }
  Status status() const { return s_.report.status; }
  const std::string& message() const { return s_.report.message; }
  /// All that makes the model, for what builds on it.
  const detail::ModelState& state() const { return s_; }

 private:
  static constexpr Eigen::Index block = 128;  // points at a time: 128 x n correlations stay in the cache

  void check(const Eigen::MatrixXd& X) const;

  // m x n, without λ: points down, so that all work runs along them.
  Eigen::MatrixXd correlations(const Eigen::MatrixXd& scaled) const;

  // Correlations with the runs and terms of the trend at one point, with their derivatives by the inputs.
  struct SlopesAt {
    Eigen::VectorXd scaled, r, trend;      // d, n, q
    Eigen::MatrixXd slopes, trend_slopes;  // n x d, q x d
  };

  SlopesAt slopes_at(const Eigen::VectorXd& x) const;

  Eigen::VectorXd mean_slope(const SlopesAt& at) const;

  // n x d: derivatives of r by the natural inputs.
  Eigen::MatrixXd slopes_of(const Eigen::VectorXd& r, const Eigen::VectorXd& scaled) const;

  Eigen::VectorXd mean_of(const Eigen::MatrixXd& X, const Eigen::MatrixXd& scaled) const;

  // Σⱼ αⱼ c(x, xⱼ), eight points at a time; the last eight are filled up with copies of the last point.
  Eigen::VectorXd gaussian_sums(const Eigen::MatrixXd& scaled) const;

  // Rows T⁻ᵀu of the points, m x q, from the terms F of the trend.
  Eigen::MatrixXd trend_part(Eigen::MatrixXd F, const Eigen::MatrixXd& R) const;

  // What a deviation along each direction of the parameters moves the means by, unit of y: m x k, k >= 1.
  Eigen::MatrixXd parameter_part(const Eigen::MatrixXd& scaled, const Eigen::MatrixXd& R,
                                 const Eigen::MatrixXd& F) const;

  // Adds ∂(gᵀVg)/∂x, unit of y squared.
  void add_parameter_slopes(const SlopesAt& at, Eigen::VectorXd& slope) const;

  Eigen::VectorXd variance_of(const Eigen::MatrixXd& X, const Eigen::MatrixXd& scaled) const;

  // What the other explanation expects of the square of the error of each mean, m entries.
  Eigen::VectorXd squares_by_other(const Eigen::MatrixXd& X, const Eigen::VectorXd& mean, int threads) const;

  // What the other explanation adds to the derivative of a variance, and to a covariance of points.
  void add_doubt(const Eigen::VectorXd& x, PredictionGradient& g) const;
  void add_doubt(const Eigen::MatrixXd& X, Eigen::MatrixXd& C) const;

  detail::ModelState s_;
  std::shared_ptr<const Model> other_;
  Eigen::MatrixXd runs_;       // X transposed: a run's coordinates stand together
  Eigen::MatrixXd stretched_;  // the same times √θ
  Eigen::MatrixXd triangle_;   // Tᵀ
  detail::ParameterEffects effects_;
};

namespace detail {

/// The model as if its own explanation of the runs were the only one, for criteria that follow one.
inline Model of_one_explanation(const Model& model) {
  if (model.doubt() == 0) return model;
  ModelState state = model.state();
  forget_other(state);
  return Model(std::move(state));
}

}  // namespace detail
}  // namespace drawpoint::kriging

#ifndef DRAWPOINT_KRIGING_COMPILED
#include <drawpoint/kriging/detail/model_definitions.hpp>
#endif
