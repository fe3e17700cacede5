// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Responses that are counts, few of them often none: rocks spilled, stalls, faults per shift.
/// `CountModel model = fit_counts(X, counts);`
///
/// A Kriging model gives a count of 0.3 ± 0.8 where there is none, and one error bar for places with 1 and
/// with 100. Here a count is Poisson with the mean e exp(o + f(x) + g): e the exposure of the run (cycles,
/// hours), o the logarithm of the mean of all, f a latent Gaussian process, and g what a run has of its own,
/// normal of variance σ², so that counts may scatter by more than Poisson's law. The covariance is found by
/// penalised likelihood (detail/latent_likelihood.hpp), the posterior by expectation propagation
/// (detail/site_posterior.hpp). With m and v mean and variance of f at x:
///   expected count  exp(o + m + ½(v + σ²)), its variance (what is not known of f) that squared times e^v − 1
///   of one more run the variance of its count adds to that: mean + mean² e^v (e^σ² − 1)
///   probabilities of counts by the trapezoidal rule over f + g, with points as close as Poisson's law needs:
///   up to 1000 added one by one, to 1e-6; beyond, by the normal law of the root of a count, to 1e-3
///
/// Counts go up to 10 000; beyond, the root or the logarithm of a count is as normal as any response
/// (transform.hpp), and costs less.
///
/// Simplifications: what the estimates of the covariance leave unknown is in no variance; beyond 150 runs
/// they are estimated from 150 of them, evenly picked, and the posterior has all. Cost: 1 to 5 s up to 150
/// runs on one core, then some 20 n³; n² a prediction. Deterministic. Sources: Diggle, Tawn, Moyeed 1998,
/// Appl. Statist. 47(3), "Model-based geostatistics"; Rasmussen, Williams 2006, chapter 3.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/latent_likelihood.hpp>
#include <drawpoint/kriging/model.hpp>
#include <drawpoint/kriging/surrogate.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

struct CountOptions {
  /// The box of the problem, natural units, one entry per variable. Empty: the range of the data.
  Eigen::VectorXd lower = {}, upper = {};
  /// Per variable 0 for a number, L for a category of L levels (doe::level_counts). Empty: all are numbers.
  std::vector<int> levels = {};
  /// How long or how often each run could count, above 0, any unit: predictions are per one of it. Empty: 1
  /// each.
  Eigen::VectorXd exposure = {};
};

namespace detail {

/// A Poisson count whose ln mean is normal.
class CountDistribution {
 public:
  CountDistribution(double mean, double variance) {
    constexpr double reach = 8.5;  // of deviations: beyond it lies 2e-17
    const double deviation = std::sqrt(variance);
    // As a function of the logarithm of its mean λ the probability of a count is 1/√λ wide; half of it four
    // deviations up, and a twelfth of a deviation.
    const double closest = 0.5 / std::sqrt(1.0 + std::exp(mean + 4.0 * deviation));
    const double wanted = 2.0 * reach * std::max(12.0, deviation / closest);
    const int points = static_cast<int>(std::min(wanted, 4000.0));
    double sum = 0;
    for (int k = 0; k < points; ++k) {
      const double z = reach * (2.0 * k / (points - 1) - 1.0);
      weights_.push_back(std::exp(-0.5 * z * z));
      rates_.push_back(std::exp(mean + z * deviation));
      sum += weights_.back();
    }
    for (double& weight : weights_) weight /= sum;
  }

  double at_most(double count) const {
    if (count > summed) return approximately_at_most(count);
    double sum = 0;
    Terms terms(*this);
    for (double k = 0; k <= count; ++k) sum += terms.next();
    return std::min(sum, 1.0);
  }

  /// +∞ beyond a million.
  double quantile(double p) const {
    double sum = 0, count = 0;
    Terms terms(*this);
    for (; count <= summed; ++count)
      if ((sum += terms.next()) >= p) return count;
    double below = summed, above = 1e6;
    if (approximately_at_most(above) < p) {
      // So near to 1 that sums of probabilities do not reach p: the rates are used up.
      const double last = rates_.back() + 10.0 * std::sqrt(rates_.back()) + 30.0;
      return last < above ? last : std::numeric_limits<double>::infinity();
    }
    while (above - below > 1.0) {
      const double middle = std::floor(0.5 * (below + above));
      (approximately_at_most(middle) < p ? below : above) = middle;
    }
    return above;
  }

 private:
  static constexpr double summed = 1000;  // up to which probabilities are added one by one

  /// Probabilities of 0, 1, 2, ...
  class Terms {
   public:
    explicit Terms(const CountDistribution& of) : of_(of) {
      for (std::size_t k = 0; k < of.rates_.size(); ++k)
        logarithms_.push_back(std::log(of.weights_[k]) - of.rates_[k]);
    }
    double next() {
      double probability = 0;
      for (std::size_t k = 0; k < logarithms_.size(); ++k) {
        if (count_ > 0) logarithms_[k] += std::log(of_.rates_[k] / count_);
        probability += std::exp(logarithms_[k]);
      }
      count_ += 1.0;
      return probability;
    }

   private:
    const CountDistribution& of_;
    std::vector<double> logarithms_;  // of weight times probability
    double count_ = 0;
  };

  /// Twice the root of a count is normal with deviation 1 (Anscombe 1948): to 1e-3 from a thousand on.
  double approximately_at_most(double count) const {
    double sum = 0;
    for (std::size_t k = 0; k < rates_.size(); ++k)
      sum += weights_[k] * normal_probability(2.0 * (std::sqrt(count + 0.75) - std::sqrt(rates_[k])));
    return std::min(sum, 1.0);
  }

  std::vector<double> rates_, weights_;
};

}  // namespace detail

/// A value that threads may share; a Surrogate of the count per unit of exposure.
class CountModel {
 public:
  /// Expected count and its variance, or those of the count of one more run: m x d, natural units; m entries.
  Prediction predict(const Eigen::MatrixXd& X, Target target = Target::latent) const {
    Prediction p = latent(X);
    const double own = covariance_.of_a_run;
    for (Eigen::Index i = 0; i < p.mean.size(); ++i) {
      const double mean = std::exp(offset_ + p.mean[i] + 0.5 * (p.variance[i] + own)), v = p.variance[i];
      p.mean[i] = mean;
      p.variance[i] = mean * mean * std::expm1(v);
      if (target == Target::observation) p.variance[i] += mean + mean * mean * std::exp(v) * std::expm1(own);
    }
    return p;
  }
  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const { return predict(X).mean; }

  /// That one more run at each row of X, exposed `exposure`, counts at most `count`: m entries, 0 to 1.
  Eigen::VectorXd probability_at_most(const Eigen::MatrixXd& X, int count, double exposure = 1.0) const;
  /// The least count that one more run exceeds with a chance of 1 − p at most, 0 < p < 1: m entries; +∞
  /// beyond a million.
  Eigen::VectorXd quantile(const Eigen::MatrixXd& X, double p, double exposure = 1.0) const;

  Eigen::Index runs() const { return X_.rows(); }
  /// The length scales of f on inputs scaled to [0, 1], d entries: how far a run informs about its surroundings.
  Eigen::VectorXd length_scales() const { return covariance_.length_scales(); }
  double deviation() const { return std::sqrt(covariance_.variance); }           ///< s of f
  double deviation_of_a_run() const { return std::sqrt(covariance_.of_a_run); }  ///< σ of g
  /// Mean logarithm of the probability that the other runs give to the count of a run, at most 0.
  double left_out_score() const { return left_out_score_; }
  /// Whether expectation propagation met its stopping rule.
  bool converged() const { return posterior_.converged; }

 private:
  friend CountModel fit_counts(const Eigen::MatrixXd& X, const Eigen::VectorXd& counts,
                               const CountOptions& options);

  /// Mean and variance of f at the rows of X.
  Prediction latent(const Eigen::MatrixXd& X) const;
  /// The distribution of the count of one more run at point i of f.
  detail::CountDistribution distribution(const Prediction& f, Eigen::Index i, double exposure) const {
    return {offset_ + std::log(exposure) + f.mean[i], f.variance[i] + covariance_.of_a_run};
  }

  detail::InputScale input_;
  Eigen::MatrixXd X_;  // scaled
  double offset_ = 0;  // o
  detail::LatentCovariance covariance_;
  detail::LatentPosterior posterior_;
  double left_out_score_ = 0;
};

static_assert(Surrogate<CountModel>);

namespace detail {

[[noreturn]] inline void reject_counts(const std::string& what) {
  throw std::invalid_argument("kriging::fit_counts: " + what);
}

inline void check_counts(const Eigen::MatrixXd& X, const Eigen::VectorXd& counts,
                         const CountOptions& options) {
  constexpr double most = 1e4;
  if (X.rows() < 2 || X.cols() < 1)
    reject_counts("X is " + std::to_string(X.rows()) + " x " + std::to_string(X.cols()) +
                  "; allowed is 2 x 1 or more; give one row per run");
  if (counts.size() != X.rows())
    reject_counts("X has " + std::to_string(X.rows()) + " rows but counts has " +
                  std::to_string(counts.size()) + " entries; give one per run");
  check_inputs("kriging::fit_counts", X, {options.lower, options.upper, options.levels});
  for (Index i = 0; i < counts.size(); ++i)
    if (!(counts[i] >= 0 && counts[i] <= most) || counts[i] != std::floor(counts[i]))
      reject_counts("counts[" + std::to_string(i) + "] is " + text(counts[i]) +
                    "; allowed are whole numbers from 0 to 10000; fit other responses with fit_transformed");
  if (options.exposure.size() != 0 && options.exposure.size() != X.rows())
    reject_counts("exposure has " + std::to_string(options.exposure.size()) + " entries for " +
                  std::to_string(X.rows()) + " runs; give one per run, or none");
  for (Index i = 0; i < options.exposure.size(); ++i)
    if (!(options.exposure[i] > 0) || !is_usable(options.exposure[i]))
      reject_counts("exposure[" + std::to_string(i) + "] is " + text(options.exposure[i]) +
                    "; allowed are finite numbers above 0");
}

/// At most `limit` of n rows, evenly picked.
inline std::vector<Index> even_rows(Index n, Index limit) {
  std::vector<Index> rows;
  const Index count = std::min(n, limit);
  for (Index i = 0; i < count; ++i) rows.push_back(i * n / count);
  return rows;
}

inline void check_exposure(double exposure) {
  if (!(exposure > 0) || !is_usable(exposure))
    throw std::invalid_argument("kriging::CountModel: exposure is " + text(exposure) +
                                "; allowed are finite numbers above 0");
}

}  // namespace detail

/// X: n x d, natural units; counts: n whole numbers, 0 or more. Throws std::invalid_argument for fewer than
/// two runs, unequal lengths, what is no count, and bounds or exposures that do not fit.
inline CountModel fit_counts(const Eigen::MatrixXd& X, const Eigen::VectorXd& counts,
                             const CountOptions& options = {}) {
  detail::check_counts(X, counts, options);
  CountModel model;
  model.input_ = detail::latent_scale(X, {options.lower, options.upper, options.levels});
  model.X_ = model.input_.apply(X);
  Eigen::VectorXd exposure = options.exposure;
  if (exposure.size() == 0) exposure.setOnes(X.rows());
  double all = 0.5, exposed = 0;  // half a count, so that runs without any have a finite logarithm
  for (detail::Index i = 0; i < counts.size(); ++i) all += counts[i], exposed += exposure[i];
  model.offset_ = std::log(all / exposed);

  std::vector<detail::CountRun> runs;
  for (detail::Index i = 0; i < counts.size(); ++i)
    runs.push_back({counts[i], model.offset_ + std::log(exposure[i])});
  detail::LatentFit fitted =
      detail::fit_latent(model.X_, runs, detail::even_rows(X.rows(), detail::latent_limit),
                         detail::categories_of(options.levels));
  model.covariance_ = std::move(fitted.covariance);
  model.posterior_ = std::move(fitted.posterior);
  model.left_out_score_ = detail::mean_of(model.posterior_.left_out);
  return model;
}

inline Prediction CountModel::latent(const Eigen::MatrixXd& X) const {
  if (X.cols() != X_.cols())
    throw std::invalid_argument("kriging::CountModel: X has " + std::to_string(X.cols()) +
                                " columns; allowed are " + std::to_string(X_.cols()) +
                                "; give one per variable");
  if (!std::all_of(X.data(), X.data() + X.size(), detail::is_usable))
    throw std::invalid_argument(
        "kriging::CountModel: X has an entry that is not finite or beyond 1e150; give numbers below it");
  detail::require_levels("kriging::CountModel", X, covariance_.correlation.levels);
  return detail::latent_at(input_.apply(X), X_, covariance_, posterior_);
}

inline Eigen::VectorXd CountModel::probability_at_most(const Eigen::MatrixXd& X, int count,
                                                       double exposure) const {
  detail::check_exposure(exposure);
  const Prediction f = latent(X);
  Eigen::VectorXd P(X.rows());
  for (Eigen::Index i = 0; i < P.size(); ++i) P[i] = distribution(f, i, exposure).at_most(count);
  return P;
}

inline Eigen::VectorXd CountModel::quantile(const Eigen::MatrixXd& X, double p, double exposure) const {
  detail::check_exposure(exposure);
  if (!(p > 0 && p < 1))
    throw std::invalid_argument("kriging::CountModel::quantile: p is " + detail::text(p) +
                                "; allowed is between 0 and 1; 0.975 is usual");
  const Prediction f = latent(X);
  Eigen::VectorXd quantiles(X.rows());
  for (Eigen::Index i = 0; i < quantiles.size(); ++i) quantiles[i] = distribution(f, i, exposure).quantile(p);
  return quantiles;
}

}  // namespace drawpoint::kriging
