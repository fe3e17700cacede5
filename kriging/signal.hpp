// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Whether the model of a response says anything: flat is a model whose mean differs over the box by no more
/// than its own error.
///
/// Two measures, on the scale that was fitted. With m(x), s²(x) mean and variance of the latent function, over
/// points that fill the box: ratio = variance of m/mean of s². With eᵢ the errors of the runs that are left
/// out and wᵢ their shares of the box (Σ wᵢ = 1): gain = (1 − Σ wᵢ eᵢ²/Σ wᵢ (yᵢ − ȳ)²)/Σ wᵢ², which is n Q2
/// where shares are equal. Runs of noise alone have a gain that does not grow with n. A model is flat where the
/// ratio is at most 5 and the gain at most 10, or 6 where the fit knows the noise of its runs. Where it does
/// not, and there are fewer than 20 runs or 6 per variable, a signal that the fit took for noise is too likely,
/// and no model counts as flat. tests/kriging/signal_statistical.cpp has how often that errs.
///
/// Cost: 512 predictions, some 512 n². Deterministic.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/detail/box_shares.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <limits>

namespace drawpoint::kriging {

struct SignalOptions {
  double most_ratio = 5;                       ///< of a flat model; range >= 0
  double most_gain = 10, most_known_gain = 6;  ///< of a flat model, its noise estimated or known
  int runs = 20, runs_per_variable = 6;        ///< with fewer, noise that is estimated leaves it open
  int points = 512;                            ///< of the box; range >= 2
};

struct Signal {
  double spread = 0;  ///< standard deviation of the mean over the box, unit of y
  double error = 0;   ///< root of the mean variance of the latent function there, unit of y
  double ratio = 0;   ///< NaN where both are 0
  double gain = 0;    ///< of the runs that are left out; NaN where all are equal
  bool open = false;  ///< whether too few runs leave it open
  bool flat = false;
};

namespace detail {

inline double variance_over(const Eigen::VectorXd& values) {
  const double n = static_cast<double>(values.size());
  return square(affine(values, 1.0, -mean_of(values))) / n;
}

inline double left_out_gain(const Model& model) {
  const Validation v = leave_one_out(model);
  const Eigen::VectorXd share = shares_of_box(model.state().X, model.correlation().levels);
  double mean = 0, errors = 0, all = 0;
  for (Index i = 0; i < share.size(); ++i) mean += share[i] * v.observed[i];
  for (Index i = 0; i < share.size(); ++i) {
    const double e = v.observed[i] - v.predicted[i], y = v.observed[i] - mean;
    errors += share[i] * e * e;
    all += share[i] * y * y;
  }
  return (1 - errors / all) / square(share);
}

inline bool says_nothing(const Model& model, const Signal& signal, const SignalOptions& options) {
  const bool known = model.state().known_noise > 0;
  return !(signal.ratio > options.most_ratio) &&
         !(signal.gain > (known ? options.most_known_gain : options.most_gain));
}

inline bool leaves_open(const Model& model, const SignalOptions& options) {
  return !(model.state().known_noise > 0) &&
         model.runs() < std::max<Index>(options.runs, options.runs_per_variable * model.variables());
}

}  // namespace detail

/// problem: the box of the model's variables. A response that is the same in every run is flat; a model whose
/// variance is not known is not.
inline Signal signal_of(const TransformedModel& model, const doe::Problem& problem,
                        const SignalOptions& options = {}) {
  const Eigen::MatrixXd X = doe::latin_hypercube(problem, options.points, {.seed = 1});
  const Prediction own = model.predict(X), scaled = model.model().predict(X);
  Signal signal{.spread = std::sqrt(detail::variance_over(own.mean)),
                .error = std::sqrt(std::max(detail::mean_of(own.variance), 0.0))};
  if (!std::isfinite(signal.error)) return signal;
  const bool constant = model.model().state().X.rows() == 0;
  if (constant) signal.spread = 0;  // but for round-off
  signal.ratio = constant ? std::numeric_limits<double>::quiet_NaN()
                          : detail::variance_over(scaled.mean) / detail::mean_of(scaled.variance);
  signal.gain = constant ? std::numeric_limits<double>::quiet_NaN() : detail::left_out_gain(model.model());
  signal.open = !constant && detail::leaves_open(model.model(), options);
  signal.flat = !signal.open && detail::says_nothing(model.model(), signal, options);
  return signal;
}

}  // namespace drawpoint::kriging
