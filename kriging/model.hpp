// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A fitted regression Kriging model. A value: copy it, share it between threads.
///
/// With r = c(x, X), the correlations of x with the runs, without λ:
///   mean      ŷ(x)  = μ + rᵀα
///   variance  s²(x) = s² [1 − rᵀR⁻¹r + (1 − 1ᵀR⁻¹r)²/(1ᵀR⁻¹1)]
/// The last term is what estimating μ adds. This is the variance of the latent function, the response without
/// noise; it does not vanish at the runs when λ > 0. A new noisy observation has the variance s²(x) + λ s².
/// Units: mean in the unit of y, variance in its square. Cost a point: mean n d, variance n² more.
/// Source: Forrester, Keane, Bressloff 2006, AIAA Journal 44(10), "Design and Analysis of 'Noisy' Computer
/// Experiments".

#include <Eigen/Core>
#include <algorithm>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/likelihood.hpp>
#include <drawpoint/kriging/options.hpp>
#include <drawpoint/kriging/training_data.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::kriging {

struct Prediction {
  Eigen::VectorXd mean, variance;  ///< one entry a point
};

/// What a variance is about: the response without noise, or one more run of it.
enum class Target { latent, observation };

class Model {
 public:
  /// The model at the last point of `likelihood`, whose value there is finite. Made by fit().
  Model(const detail::TrainingData& data, const Likelihood& likelihood, FitReport report)
      : input_(data.input),
        X_(data.X),
        theta_(likelihood.theta()),
        nugget_(likelihood.nugget()),
        trend_(data.y_centre + data.y_scale * likelihood.estimates().trend),
        process_variance_(data.y_scale * data.y_scale * likelihood.estimates().process_variance),
        log_likelihood_(likelihood.estimates().log_likelihood -
                        static_cast<double>(data.X.rows()) * std::log(data.y_scale)),
        weights_(data.y_scale * likelihood.weights()),
        weights_of_one_(likelihood.weights_of_one()),
        cholesky_(likelihood.cholesky()),
        report_(std::move(report)) {}

  /// The constant model of a constant response.
  Model(const detail::TrainingData& data, const FitOptions& options, FitReport report)
      : input_(data.input),
        X_(0, data.X.cols()),
        theta_(Eigen::VectorXd::Constant(data.X.cols(), options.theta_lower)),
        nugget_(options.nugget_lower),
        trend_(data.y_centre),
        log_likelihood_(std::numeric_limits<double>::infinity()),
        report_(std::move(report)) {}

  /// X: m x d, natural units. Throws std::invalid_argument for another number of columns and for numbers that
  /// are not finite.
  Prediction predict(const Eigen::MatrixXd& X, Target target = Target::latent) const {
    check(X.cols(), X.allFinite());
    Prediction p{Eigen::VectorXd(X.rows()), Eigen::VectorXd(X.rows())};
    for (Eigen::Index i = 0; i < X.rows(); i += block) {
      const Eigen::Index count = std::min(block, X.rows() - i);
      Eigen::MatrixXd R = correlations(X.middleRows(i, count));
      p.mean.segment(i, count) = mean_of(R);
      p.variance.segment(i, count) = variance_of(R);
    }
    if (target == Target::observation) p.variance.array() += nugget_ * process_variance_;
    return p;
  }

  /// The mean alone, at a fraction of the cost. Throws as predict.
  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const {
    check(X.cols(), X.allFinite());
    Eigen::VectorXd mean(X.rows());
    for (Eigen::Index i = 0; i < X.rows(); i += block) {
      const Eigen::Index count = std::min(block, X.rows() - i);
      mean.segment(i, count) = mean_of(correlations(X.middleRows(i, count)));
    }
    return mean;
  }

  /// The mean at one point x of d entries: a model is a black box itself.
  double operator()(const Eigen::VectorXd& x) const { return mean(x.transpose())[0]; }

  Eigen::Index variables() const { return theta_.size(); }
  /// d entries, on inputs scaled to [-1, 1]: how fast the response varies with each input.
  const Eigen::VectorXd& theta() const { return theta_; }
  double nugget() const { return nugget_; }                      ///< λ
  double process_variance() const { return process_variance_; }  ///< s², unit of y squared
  double trend() const { return trend_; }                        ///< μ, unit of y
  /// Concentrated log likelihood in the unit of y; +∞ for a constant response.
  double log_likelihood() const { return log_likelihood_; }
  const FitReport& report() const { return report_; }
  Status status() const { return report_.status; }
  const std::string& message() const { return report_.message; }

 private:
  static constexpr Eigen::Index block = 128;  // points at a time: n x 128 correlations stay in the cache

  void check(Eigen::Index columns, bool finite) const {
    if (columns != variables())
      throw std::invalid_argument("kriging::Model: X has " + std::to_string(columns) +
                                  " columns; the model has " + std::to_string(variables()) +
                                  " variables; give one point a row");
    if (!finite)
      throw std::invalid_argument(
          "kriging::Model: X holds a number that is not finite; allowed are finite numbers; remove the "
          "point");
  }

  // n x m, without λ.
  Eigen::MatrixXd correlations(const Eigen::MatrixXd& X) const {
    return cross_correlation(X_, input_.apply(X), theta_);
  }

  Eigen::VectorXd mean_of(const Eigen::MatrixXd& R) const {
    if (X_.rows() == 0) return Eigen::VectorXd::Constant(R.cols(), trend_);
    return (R.transpose() * weights_).array() + trend_;
  }

  // Overwrites R with L⁻¹R.
  Eigen::VectorXd variance_of(Eigen::MatrixXd& R) const {
    if (X_.rows() == 0) return Eigen::VectorXd::Zero(R.cols());
    const Eigen::ArrayXd missing = 1.0 - (R.transpose() * weights_of_one_).array();
    cholesky_.triangularView<Eigen::Lower>().solveInPlace(R);
    const Eigen::ArrayXd explained = R.colwise().squaredNorm().transpose();
    // Round-off may leave a small negative number at a run.
    return process_variance_ * (1.0 - explained + missing.square() / weights_of_one_.sum()).max(0.0);
  }

  detail::InputScale input_;
  Eigen::MatrixXd X_;  // n x d scaled; no rows in a constant model
  Eigen::VectorXd theta_;
  double nugget_ = 0, trend_ = 0, process_variance_ = 0, log_likelihood_ = 0;
  Eigen::VectorXd weights_, weights_of_one_;  // R⁻¹(y − 1μ) in the unit of y, and R⁻¹1
  Eigen::MatrixXd cholesky_;
  FitReport report_;
};

}  // namespace drawpoint::kriging
