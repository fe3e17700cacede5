// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What one more run teaches, and which runs to make again.
///
/// With C the covariance of the latent function given the runs so far, one more run at a point x, of noise
/// variance τ², takes
///   gain(x) = mean over places u of C(u, x)²/(C(x, x) + τ²)
/// off the mean variance over these places, whether a run was made at x before or not. No outcome enters: the
/// gain is that of any run there. After it C becomes C(u, v) − C(u, x)C(x, v)/(C(x, x) + τ²), so that a batch
/// does not spend all on one point. The parameters of the model are taken as they are. Cost of k points and m
/// places, for a model of n runs: (k + m)² n at first, then k (k + m) per run.
///
/// A run again pays where noise limits the model: at a noisy point that many places lean on. Where a model is
/// short of points instead, a new one gains more, and of a simulator without noise repeats teach nothing.
///
/// Source: Binois, Huang, Gramacy, Ludkovski 2019, Technometrics 61(1), "Replication or Exploration?
/// Sequential Design for Stochastic Simulation Experiments", section 3, which takes the larger gain; ours
/// leaves the shares to the user and keeps repeats from what is no noise.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/model.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

class RunGain {
 public:
  /// points: k x d, where a run may be made; places: m x d, where the model is to be good, natural units, one
  /// or more of each; noise_variance: of one run at each point, k entries, unit of y squared. Throws
  /// std::invalid_argument for other shapes, for variances outside of 0 to 1e150, and as Model::covariance.
  RunGain(const Model& model, const Eigen::MatrixXd& points, const Eigen::MatrixXd& places,
          Eigen::VectorXd noise_variance)
      : noise_(std::move(noise_variance)) {
    check(points, places);
    Eigen::MatrixXd all(points.rows() + places.rows(), points.cols());
    all << points, places;
    const Eigen::MatrixXd C = detail::of_one_explanation(model).covariance(all);
    C_ = C.leftCols(points.rows());
    variance_ = detail::diagonal(C).tail(places.rows());
  }

  Eigen::Index points() const { return C_.cols(); }

  /// By one more run at each point: k entries, unit of y squared, 0 or more.
  Eigen::VectorXd gains() const {
    Eigen::VectorXd gains(points());
    for (Eigen::Index i = 0; i < points(); ++i) gains[i] = gain(i);
    return gains;
  }

  /// As if a run had been made at this point. Throws std::invalid_argument for another index.
  void run(Eigen::Index point) {
    if (point < 0 || point >= points())
      throw std::invalid_argument("kriging::RunGain: point is " + std::to_string(point) +
                                  "; allowed is 0 to " + std::to_string(points() - 1));
    const double seen = run_variance(point);
    if (!(seen > 0)) return;
    const Eigen::VectorXd c = C_.col(point);
    for (Eigen::Index i = 0; i < variance_.size(); ++i)
      variance_[i] = std::max(variance_[i] - c[points() + i] * c[points() + i] / seen, 0.0);
    for (Eigen::Index j = 0; j < points(); ++j)
      detail::add_scaled(&C_(0, j), -c[j] / seen, c.data(), c.size());
  }

  /// Over the places, with the runs told so far; unit of y squared.
  double mean_variance() const { return detail::mean_of(variance_); }

 private:
  void check(const Eigen::MatrixXd& points, const Eigen::MatrixXd& places) const {
    const auto reject = [](const std::string& what) {
      throw std::invalid_argument("kriging::RunGain: " + what);
    };
    if (points.rows() == 0 || places.rows() == 0)
      reject(std::to_string(points.rows()) + " points and " + std::to_string(places.rows()) +
             " places; allowed is 1 or more of each; give one per row");
    if (points.cols() != places.cols())
      reject("points have " + std::to_string(points.cols()) + " columns but places have " +
             std::to_string(places.cols()) + "; give one per variable");
    detail::check_run_noise(noise_, points.rows(), "kriging::RunGain: ", "points");
  }

  double run_variance(Eigen::Index point) const { return std::max(C_(point, point), 0.0) + noise_[point]; }

  double gain(Eigen::Index point) const {
    const double seen = run_variance(point);
    if (!(seen > 0)) return 0.0;
    const double* c = &C_(points(), point);
    return detail::dot(c, c, variance_.size()) / (seen * static_cast<double>(variance_.size()));
  }

  Eigen::VectorXd noise_, variance_;  // of one run at each point; at each place
  Eigen::MatrixXd C_;                 // (k + m) x k: of points and places with the points
};

/// One of the responses that a run serves.
struct ResponseGain {
  RunGain gain;
  double unit = 1;  ///< what an error is measured by, > 0: the range of the response, say; unit of y
};

struct RepeatOptions {
  Eigen::Index made = 0;  ///< the first so many points are those of runs; the others are for new ones
  int count = 1;          ///< runs to make again, 0 or more
  /// Of what the best new point would gain, a run made again has to gain this share or more, 0 to 1.
  double least_share = 0.2;
};

namespace detail {

inline void check_repeats(const std::vector<ResponseGain>& responses, const RepeatOptions& options) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("kriging::runs_to_repeat: " + what);
  };
  if (responses.empty()) reject("0 responses; allowed is 1 or more");
  const Eigen::Index points = responses.front().gain.points();
  for (const ResponseGain& response : responses) {
    if (response.gain.points() != points)
      reject("one response has " + std::to_string(points) + " points and another " +
             std::to_string(response.gain.points()) + "; give all the same");
    if (!(response.unit > 0) || !std::isfinite(response.unit))
      reject("unit is " + text(response.unit) + "; allowed are finite numbers above 0");
  }
  if (options.made < 1 || options.made > points)
    reject("made is " + std::to_string(options.made) + "; allowed is 1 to the " + std::to_string(points) +
           " points");
  if (options.count < 0) reject("count is " + std::to_string(options.count) + "; allowed is 0 or more");
  if (!(options.least_share >= 0 && options.least_share <= 1))
    reject("least_share is " + text(options.least_share) + "; allowed is 0 to 1");
}

/// Over the responses, each in its own unit: one entry per point.
inline Eigen::VectorXd sum_of_gains(const std::vector<ResponseGain>& responses) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(responses.front().gain.points());
  for (const ResponseGain& response : responses) {
    const Eigen::VectorXd gains = response.gain.gains();
    add_scaled(sum.data(), 1.0 / (response.unit * response.unit), gains.data(), sum.size());
  }
  return sum;
}

}  // namespace detail

/// The runs to make again, by point, one after the other, each where the gains of all responses are largest
/// in sum; a point may be chosen more than once. Fewer where nothing is gained, or much less than by a new
/// point. Throws std::invalid_argument without responses, where these differ in their number of points, for a
/// unit that is not above 0 and for options out of range.
inline std::vector<Eigen::Index> runs_to_repeat(std::vector<ResponseGain> responses,
                                                const RepeatOptions& options) {
  detail::check_repeats(responses, options);
  std::vector<Eigen::Index> chosen;
  while (static_cast<int>(chosen.size()) < options.count) {
    const Eigen::VectorXd gains = detail::sum_of_gains(responses);
    const auto best = std::max_element(gains.begin(), gains.begin() + options.made);
    if (!(*best > 0) || *best < options.least_share * detail::largest_entry(gains)) break;
    chosen.push_back(best - gains.begin());
    for (ResponseGain& response : responses) response.gain.run(chosen.back());
  }
  return chosen;
}

}  // namespace drawpoint::kriging
