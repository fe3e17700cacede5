// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A Kriging model of many runs, each prediction resting on the nearest of them. A value: copy it, share it
/// between threads.
///
/// The runs are cut into cells (detail/nearest/cells.hpp). At a point of a cell with the neighbourhood N the
/// mean and the variance are those of model.hpp with R_NN, r_N and F_N in the place of R, r and F; β, s², θ,
/// λ and FᵀR⁻¹F are those of all runs, by Vecchia's likelihood (detail/nearest/vecchia.hpp).
///
/// Simplified: runs outside the neighbourhood do not count, so means jump a little where cells meet;
/// NearestError says what twice the runs would change, and NearestOptions::neighbourhood buys less. θ, the
/// exponents and λ are taken as known in variances. Where a run stands the mean misses it by λα, round-off
/// for exact simulators. Cost, N runs a neighbourhood: N³/3 a cell when it is made and again in each call
/// with variances, N² a point; means N d. Memory n d + 2 n N/cell. Bits do not depend on the number of
/// threads.

#include <Eigen/Core>
#include <drawpoint/doe/detail/threads.hpp>
#include <drawpoint/kriging/detail/model_state.hpp>
#include <drawpoint/kriging/detail/nearest/families.hpp>
#include <drawpoint/kriging/detail/nearest/neighbourhood.hpp>
#include <drawpoint/kriging/surrogate.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

/// What a fit by nearest runs is given beside FitOptions.
struct NearestOptions {
  int neighbours = 200;     ///< of a block of an eighth as many runs in the likelihood, 8 to 4000
  int neighbourhood = 400;  ///< runs that a prediction rests on, 8 to 4000
  int exact_up_to = 2000;   ///< runs that fit_any leaves to fit, 0 or more
};

/// What the approximation changes, estimated when the model is fitted; 0 where all runs are neighbours.
struct NearestError {
  /// What twice the neighbours add to the log likelihood of some blocks, per run.
  double log_density = 0;
  /// Root mean square change of predicted means by neighbourhoods of twice the runs, at random points of some
  /// cells, and of the predicted standard deviation there, for comparison. Unit of y.
  double mean = 0, deviation = 0;
};

struct NearestState {
  detail::ModelState all;   ///< without L, α, B and parameter_spread
  int neighbourhood = 400;  ///< runs
  int threads = 1;          ///< of predictions; 0: all cores
  NearestError error;
};

class NearestModel {
 public:
  /// Made by fit_nearest(); the cells and their weights follow from the state. Cost: n/cell · N³/3.
  explicit NearestModel(NearestState state) : state_(std::move(state)) {
    const detail::ModelState& s = state_.all;
    if (s.X.rows() == 0) return;
    cells_ = detail::Cells(s.X, s.correlation, detail::runs_of_cell(state_.neighbourhood));
    whitened_ = detail::whitened_trend(s, s.F);
    residual_ = s.y;
    detail::add_product(residual_.data(), -1.0, s.F, s.gls.beta.data());
    hoods_.resize(static_cast<std::size_t>(cells_.count()));
    detail::for_each_task(cells_.count(), threads(), [&](int c) {
      detail::Neighbourhood& hood = hoods_[static_cast<std::size_t>(c)];
      hood.rows = detail::neighbourhood_of(s.X, s.correlation, cells_.runs(c), state_.neighbourhood);
      hood.alpha = detail::LocalFactor(s, hood.rows).weights(residual_);
    });
  }

  /// X: m x d, natural units. Throws std::invalid_argument for another number of columns, for numbers that
  /// are not finite and for what is no level of a category.
  Prediction predict(const Eigen::MatrixXd& X, Target target = Target::latent) const {
    check(X);
    Prediction p{constant_mean(X.rows()), Eigen::VectorXd::Constant(X.rows(), state_.all.constant_variance)};
    for_each_part(X, true, [&](const Part& part) {
      for (std::size_t i = 0; i < part.points.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        p.mean[part.points[i]] = part.mean[at];
        p.variance[part.points[i]] =
            part.variance[at] + (target == Target::observation ? noise_variance() : 0.0);
      }
    });
    return p;
  }

  /// The mean alone, at a fraction of the cost. Throws as predict.
  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const {
    check(X);
    Eigen::VectorXd mean = constant_mean(X.rows());
    for_each_part(X, false, [&](const Part& part) {
      for (std::size_t i = 0; i < part.points.size(); ++i)
        mean[part.points[i]] = part.mean[static_cast<Eigen::Index>(i)];
    });
    return mean;
  }

  /// The mean at one point x of d entries: a model is a black box itself.
  double operator()(const Eigen::VectorXd& x) const { return mean(x.transpose())[0]; }
  static constexpr bool predicts = true;  ///< for doe::Predictor

  /// Derivatives of the mean at one point x of d entries inside its cell; 0 by a category. Cost N d. Throws
  /// as predict.
  Eigen::VectorXd mean_gradient(const Eigen::VectorXd& x) const;

  Eigen::Index variables() const { return state_.all.input.centre.size(); }
  Eigen::Index runs() const { return state_.all.observed.size(); }
  const CorrelationFunction& correlation() const { return state_.all.correlation; }
  const Eigen::VectorXd& theta() const { return correlation().theta; }  ///< as Model::theta
  double nugget() const { return state_.all.nugget; }                   ///< λ
  /// s², unit of y squared.
  double process_variance() const {
    return state_.all.y_scale * state_.all.y_scale * state_.all.process_variance;
  }
  double noise_variance() const { return nugget() * process_variance(); }  ///< λ s², unit of y squared
  /// Vecchia's, concentrated, in the unit of y; +∞ for a constant response and an exact trend.
  double log_likelihood() const { return state_.all.log_likelihood; }
  const NearestError& error() const { return state_.error; }
  const FitReport& report() const { return state_.all.report; }
  Status status() const { return report().status; }
  const std::string& message() const { return report().message; }
  const NearestState& state() const { return state_; }  ///< all that makes the model

 private:
  static constexpr std::size_t block = 128;  // points at a time

  // Points of one cell with what is predicted there, unit of y.
  struct Part {
    std::vector<Eigen::Index> points;
    Eigen::VectorXd mean, variance;
  };

  int threads() const { return doe::detail::thread_count(state_.threads); }

  Eigen::VectorXd constant_mean(Eigen::Index points) const {
    return Eigen::VectorXd::Constant(points, state_.all.y_centre);
  }

  void check(const Eigen::MatrixXd& X) const;

  // Calls use(part) for all parts of all cells; parts of different cells on different threads.
  template <class Use>
  void for_each_part(const Eigen::MatrixXd& X, bool variances, const Use& use) const;

  void predict_part(const Eigen::MatrixXd& X, const Eigen::MatrixXd& scaled, const detail::LocalRuns& runs,
                    const detail::Neighbourhood& hood, Part& part) const;

  NearestState state_;
  detail::Cells cells_;
  std::vector<detail::Neighbourhood> hoods_;  // one per cell
  Eigen::MatrixXd whitened_;                  // F T⁻¹
  Eigen::VectorXd residual_;                  // y − Fβ
};

static_assert(SmoothSurrogate<NearestModel>);

inline void NearestModel::check(const Eigen::MatrixXd& X) const {
  if (X.cols() != variables())
    throw std::invalid_argument("kriging::NearestModel: X has " + std::to_string(X.cols()) +
                                " columns; the model has " + std::to_string(variables()) +
                                " variables; give one point per row");
  if (!detail::all_finite(X))
    throw std::invalid_argument(
        "kriging::NearestModel: X holds a number that is not finite; allowed are finite numbers; remove the "
        "point");
  detail::require_levels("kriging::NearestModel", X, correlation().levels);
}

template <class Use>
void NearestModel::for_each_part(const Eigen::MatrixXd& X, bool variances, const Use& use) const {
  const detail::ModelState& s = state_.all;
  if (s.X.rows() == 0) return;
  const Eigen::MatrixXd scaled = s.input.apply(X);
  std::vector<std::vector<Eigen::Index>> points(hoods_.size());
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    points[static_cast<std::size_t>(cells_.at(scaled, i))].push_back(i);
  detail::for_each_task(cells_.count(), threads(), [&](int c) {
    const std::vector<Eigen::Index>& here = points[static_cast<std::size_t>(c)];
    if (here.empty()) return;
    const detail::Neighbourhood& hood = hoods_[static_cast<std::size_t>(c)];
    const detail::LocalRuns runs(s, hood.rows, variances ? &whitened_ : nullptr);
    for (std::size_t i = 0; i < here.size(); i += block) {
      const auto from = here.begin() + static_cast<std::ptrdiff_t>(i);
      Part part{{from, from + static_cast<std::ptrdiff_t>(std::min(block, here.size() - i))}, {}, {}};
      predict_part(X, scaled, runs, hood, part);
      use(part);
    }
  });
}

inline void NearestModel::predict_part(const Eigen::MatrixXd& X, const Eigen::MatrixXd& scaled,
                                       const detail::LocalRuns& runs, const detail::Neighbourhood& hood,
                                       Part& part) const {
  const detail::ModelState& s = state_.all;
  const Eigen::MatrixXd at = detail::rows_of(scaled, part.points);
  const Eigen::MatrixXd C = cross_correlation(runs.X, at, s.correlation);  // N x points
  const Eigen::MatrixXd F = detail::trend_matrix(s.trend, detail::rows_of(X, part.points), at, s.input);
  part.mean = detail::transposed_product(C, hood.alpha);
  detail::add_product(part.mean.data(), 1.0, F, s.gls.beta.data());
  part.mean = detail::affine(part.mean, s.y_scale, s.y_centre);
  if (!runs.factor) return;
  part.variance = detail::affine(runs.relative_variance(C, detail::whitened_trend(s, F)), process_variance());
}

inline Eigen::VectorXd NearestModel::mean_gradient(const Eigen::VectorXd& x) const {
  check(x.transpose());
  const detail::ModelState& s = state_.all;
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(x.size());
  if (s.X.rows() == 0) return slope;
  const Eigen::MatrixXd scaled = s.input.apply(x.transpose());
  const detail::Neighbourhood& hood = hoods_[static_cast<std::size_t>(cells_.at(scaled, 0))];
  const detail::LocalRuns runs(s, hood.rows, nullptr);
  const Eigen::VectorXd weighted =
      detail::entry_products(hood.alpha, cross_correlation(runs.X, scaled, s.correlation).col(0));
  Eigen::VectorXd half_range = s.input.half_range();
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    if (detail::is_category(s.correlation.levels, k)) half_range[k] = 0.0;
    for (Eigen::Index i = 0; i < weighted.size(); ++i)
      slope[k] += weighted[i] * s.input.factor[k] *
                  detail::slope_in_place(s.correlation, k, scaled(0, k) - runs.X(i, k));
  }
  const Eigen::VectorXd at = scaled.row(0);
  const Eigen::VectorXd by_trend =
      detail::transposed_product(s.trend.jacobian({x, at, half_range}), s.gls.beta);
  detail::add_scaled(slope.data(), 1.0, by_trend.data(), slope.size());
  return detail::affine(slope, s.y_scale);
}

}  // namespace drawpoint::kriging
