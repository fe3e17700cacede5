// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a fit can be told, and what it reports.
///
/// θ lives on inputs scaled to [-1, 1]; θ = 1/(8 l²) for a length scale l on [0, 1]. The nugget λ is a share
/// of the process variance: the noise variance is λ s². The default bounds are l in [0.01, 102] and λ in
/// [1e-10, 10].

#include <Eigen/Core>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/trend.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace drawpoint::kriging {

/// What is known of the noise of the runs.
enum class Noise {
  /// Nothing but that it is the same everywhere: λ is estimated. Runs at equal points that all agree tell that
  /// there is none: they count once, as with `none`. Runs without repeats are taken for exact where they gain more
  /// likelihood so than chance gives, and variances hold both explanations where they do not tell, unless may_be_exact
  /// is false (detail/exact_or_noisy.hpp).
  nugget,
  known,         ///< the variance of each run, FitOptions::noise_variance; λ follows from s²
  pooled,        ///< the same everywhere, on the scale that is fitted: each of noise_variance estimates it
  proportional,  ///< the variance of each run up to a common factor, which is estimated as λ
  /// That there is none, as of a simulator without chance: the model meets the runs, λ is at most 1e-6, and the
  /// likelihood alone is maximised. Where few runs per variable let a rough response pass for noise, intervals
  /// then hold what they say (docs/measurements/kriging.md).
  none,
};

inline std::string_view to_string(Noise noise) {
  switch (noise) {
    case Noise::nugget:
      return "nugget";
    case Noise::known:
      return "known";
    case Noise::pooled:
      return "pooled";
    case Noise::proportional:
      return "proportional";
    case Noise::none:
      return "none";
  }
  return "unknown";
}

/// What is maximised.
enum class Estimation {
  /// Likelihood times the jointly robust prior (detail/prior.hpp); of several maxima the one that
  /// leave-one-out prefers (detail/choice.hpp).
  penalized_likelihood,
  maximum_likelihood,  ///< the likelihood alone, its highest maximum
};

/// One number for all variables, or one per variable.
class PerVariable {
 public:
  PerVariable(double all) : values_(Eigen::VectorXd::Constant(1, all)) {}
  template <class Vector>
  PerVariable(const Eigen::MatrixBase<Vector>& one_each) : values_(one_each), one_each_(true) {}
  double operator[](Eigen::Index k) const { return values_[one_each_ ? k : 0]; }
  const Eigen::VectorXd& values() const { return values_; }
  bool one_each() const { return one_each_; }

 private:
  Eigen::VectorXd values_;
  bool one_each_ = false;
};

struct FitOptions {
  doe::Seed seed = 1;  ///< of the candidates

  /// The box that is scaled to [-1, 1], natural units, one entry per variable. Empty: the range of the data.
  /// Give the box of the problem when θ is to be compared between fits to different runs.
  Eigen::VectorXd lower = {}, upper = {};

  /// Per variable 0 for a number and L >= 2 for a category, whose values are the indices 0 .. L - 1 of levels
  /// without an order; doe::level_counts(problem) has it. Empty: all are numbers. The bounds of a category do
  /// not count. Two different levels correlate alike, by one θ, as the ends of a number's range do.
  std::vector<int> levels = {};

  /// > 0, of all variables or, as a vector, of each; equal bounds fix θ. Structure::isotropic has one θ for all
  /// numbers, so one bound each. At the lower one the correlation across the range of an input is 1 − 5e-5: the
  /// input has no effect. A length scale of 0.01 at the upper one is shorter than runs can lie apart.
  PerVariable theta_lower = 1.2e-5, theta_upper = 1250.0;
  /// > 0; equal bounds fix λ. Known noise that is small takes λ below the lower bound. Far below 1e-10 the
  /// matrix of some hundred smooth runs is singular to round-off.
  double nugget_lower = 1e-10, nugget_upper = 10.0;

  /// Local searches, >= 1. The likelihood of a smooth response has several maxima: on three published cases
  /// of 100 runs between one in eight and all of the searches find the best one.
  int starts = 8;
  int candidates = 128;      ///< points from which the starts are chosen by their likelihood, >= starts
  int max_iterations = 200;  ///< of one local search, >= 1

  Estimation estimation = Estimation::penalized_likelihood;
  /// penalized_likelihood with noise that is estimated only: the prior is times λ to this power, >= 0. 0.5:
  /// few runs that cannot tell noise from none are taken to have some, or error bars are too narrow. 0 for a
  /// simulator that has none: 0 to 5 % less error in the mean (docs/measurements/kriging.md).
  double nugget_power = 0.5;
  /// Whether runs may be exact (Noise::nugget). False where the simulator is known to have noise, of whatever size:
  /// repeats that agree then do so by chance.
  bool may_be_exact = true;
  /// Whether variances hold what the estimates of θ, the exponents and λ leave unknown
  /// (detail/parameter_uncertainty.hpp).
  bool parameter_uncertainty = true;

  Correlation correlation = Correlation::gaussian;
  /// isotropic: one θ, and one exponent, for all variables that are numbers, where runs are few for their
  /// number. additive: the response is a sum of functions of one variable (correlation.hpp has both).
  Structure structure = Structure::product;
  /// power_exponential only: pₖ in [1, 2], one entry per variable. Empty: estimated.
  Eigen::VectorXd exponent = {};

  Trend trend = Trend::constant;
  Basis basis = {};  ///< Trend::user only

  Noise noise = Noise::nugget;
  /// Unit of y squared, one entry per run, >= 0, not all 0; empty with Noise::nugget and none.
  Eigen::VectorXd noise_variance = {};

  /// 0: all cores. They share the matrix work of 500 runs or more; results do not depend on them.
  int threads = 1;
};

enum class Status {
  converged,          ///< the best local search met its stopping rule
  not_converged,      ///< the best search ended before its stopping rule: valid, maybe not the likeliest
  constant_response,  ///< all y are equal: the model is that constant with variance 0
  exact_trend,        ///< the trend meets all y to round-off: the model is the trend, variance round-off
  ill_conditioned,    ///< a valid model, but R is so close to singular that few digits can be trusted
  too_few_runs  ///< one run: that constant, variance +∞; or the trend asked for has more terms than runs
};

inline std::string_view to_string(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::not_converged:
      return "not_converged";
    case Status::constant_response:
      return "constant_response";
    case Status::exact_trend:
      return "exact_trend";
    case Status::ill_conditioned:
      return "ill_conditioned";
    case Status::too_few_runs:
      return "too_few_runs";
  }
  return "unknown";
}

struct FitReport {
  Status status = Status::converged;
  std::string message;    ///< for people; names also the inputs that never vary
  int starts_tried = 0;   ///< local searches that were run
  int starts_agreed = 0;  ///< of these, how many came within 0.1 of the chosen maximum
  int evaluations = 0;    ///< correlation matrices factored, the screening of the candidates included
  double condition = 1;   ///< estimate of the 1-norm condition number of R
};

}  // namespace drawpoint::kriging
