// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Co-Kriging: a response at its true fidelity, from few true runs and more of cheaper, rougher ones.
///
/// Each level is ρ(x) times the one below, plus a Kriging model of the difference (Kennedy, O'Hagan); means,
/// variances and what they leave out stand in detail/cokriging_level.hpp. A value and a surrogate as any
/// other. Predictions are of the last level, the true one. Cost per point: n² per level, n runs, and the
/// product of the runs per pair of levels.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/detail/cokriging_level.hpp>
#include <drawpoint/kriging/detail/cokriging_slopes.hpp>
#include <drawpoint/kriging/detail/fit_cokriging_level.hpp>
#include <drawpoint/kriging/detail/runs_of_surrogate.hpp>
#include <drawpoint/kriging/detail/told_rho.hpp>
#include <drawpoint/kriging/surrogate.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

struct FidelityLevelReport {
  std::string name;
  Eigen::Index runs = 0;
  /// ρ over the level below, unit of this level's y over that of the one below: its value at the centre of
  /// the box, then, where ρ is linear, what it changes by from there to the upper bound of each input. Empty
  /// at the cheapest level, and where the trend repeats what the level below says at these runs, but for the
  /// error of its model.
  Eigen::VectorXd rho;
  Eigen::VectorXd rho_standard_error;  ///< as long as rho; θ, s² and λ taken as known
  /// Share of the variance at the runs that ρ times the level below has, 0 to 1; the difference, which the
  /// model takes as independent of it, has the rest.
  double explained = 0;
  double process_variance = 0;  ///< of the difference from ρ times the level below, unit of y squared
  double noise_variance = 0;    ///< of a run, unit of y squared
  FitReport fit;
};

/// Co-Kriging against a Kriging model of the true runs alone, both by leave-one-out. `rmse` and `gain` are
/// NaN where leave_one_out() cannot score a run.
struct FidelityComparison {
  double rmse = std::numeric_limits<double>::quiet_NaN();        ///< of co-Kriging, unit of y
  double rmse_alone = std::numeric_limits<double>::quiet_NaN();  ///< of the true runs alone, unit of y
  double gain = 0;            ///< of co-Kriging in log score over the true runs alone, mean per run
  double standard_error = 0;  ///< of the gain
};

struct FidelityReport {
  std::vector<FidelityLevelReport> levels;  ///< from the cheapest to the true one
  FidelityComparison comparison;            ///< NaN where it was not asked for
  std::string message;                      ///< for people: which is better, and what each level says
};

class FidelityModel {
 public:
  /// Made by fit_fidelities().
  FidelityModel(detail::CokrigingLevels levels, FidelityReport report)
      : levels_(std::move(levels)), report_(std::move(report)) {}

  /// X: m x d, natural units. Throws std::invalid_argument for another number of columns, for numbers that
  /// are not finite and for what is no level of a category.
  Prediction predict(const Eigen::MatrixXd& X, Target target = Target::latent) const {
    check(X);
    Prediction p{Eigen::VectorXd(X.rows()), Eigen::VectorXd(X.rows())};
    for (Eigen::Index i = 0; i < X.rows(); i += block) {
      const Eigen::MatrixXd points = X.middleRows(i, std::min(block, X.rows() - i));
      const detail::LevelViews views = detail::views_of(levels_, levels_.size(), points);
      const Eigen::VectorXd variance = detail::variance_of(levels_, levels_.size(), views);
      std::copy(views.back().mean.begin(), views.back().mean.end(), p.mean.begin() + i);
      std::copy(variance.begin(), variance.end(), p.variance.begin() + i);
    }
    if (target == Target::observation) p.variance = detail::affine(p.variance, 1.0, noise_variance());
    return p;
  }

  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const { return predict(X).mean; }

  /// The mean at one point x of d entries.
  double operator()(const Eigen::VectorXd& x) const { return mean(x.transpose())[0]; }
  static constexpr bool predicts = true;  ///< for doe::Predictor

  /// Derivatives of the latent mean and variance at one point x of d entries. Throws as predict.
  PredictionGradient gradient(const Eigen::VectorXd& x) const {
    check(x.transpose());
    return detail::cokriging_gradient(levels_, x);
  }
  Eigen::VectorXd mean_gradient(const Eigen::VectorXd& x) const { return gradient(x).mean; }

  /// Joint covariance of the latent function at the rows of X: m x m. Throws as predict.
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& X) const {
    check(X);
    const detail::LevelViews views = detail::views_of(levels_, levels_.size(), X);
    return detail::covariance_of(levels_, levels_.size(), views, views);
  }

  /// The model of the first `count` levels, 1 to all of them, whose last one it predicts. Throws
  /// std::invalid_argument for another number.
  FidelityModel lower_levels(std::size_t count) const {
    if (count < 1 || count > levels_.size())
      throw std::invalid_argument("kriging::FidelityModel: " + std::to_string(count) +
                                  " levels; allowed is 1 to " + std::to_string(levels_.size()) +
                                  "; count from the cheapest");
    const auto end = static_cast<std::ptrdiff_t>(count);
    FidelityReport report{{report_.levels.begin(), report_.levels.begin() + end}, {}, {}};
    return {{levels_.begin(), levels_.begin() + end}, std::move(report)};
  }

  Eigen::Index variables() const { return levels_.front().X.cols(); }
  Eigen::Index runs() const { return levels_.back().X.rows(); }  ///< true ones
  double noise_variance() const { return levels_.back().s.nugget * levels_.back().variance(); }
  const FidelityReport& report() const { return report_; }
  const std::string& message() const { return report_.message; }
  /// That of the first level that did not converge, else converged.
  Status status() const {
    for (const FidelityLevelReport& level : report_.levels)
      if (level.fit.status != Status::converged) return level.fit.status;
    return Status::converged;
  }
  /// All that makes the model, for what builds on it.
  const detail::CokrigingLevels& levels() const { return levels_; }

 private:
  static constexpr Eigen::Index block = 128;  // points at a time

  void check(const Eigen::MatrixXd& X) const {
    detail::check_points("kriging::FidelityModel", X, variables());
    detail::require_levels("kriging::FidelityModel", X, levels_.front().s.correlation.levels);
  }

  detail::CokrigingLevels levels_;
  FidelityReport report_;
};

static_assert(SmoothSurrogate<FidelityModel>);

namespace detail {

/// Variance of ρ (m − c) at the runs over the sum of that and the variance of y − ρ (m − c).
inline double explained_share(const CokrigingLevel& level) {
  if (level.rho.empty()) return 0.0;
  const auto variance = [](const Eigen::VectorXd& v) { return square(affine(v, 1.0, -mean_of(v))); };
  const Index count = static_cast<Index>(level.rho.size()), first = level.s.F.cols() - count;
  Eigen::VectorXd below = Eigen::VectorXd::Zero(level.s.y.size());
  for (Index j = 0; j < count; ++j)
    add_scaled(below.data(), level.s.gls.beta[first + j], column(level.s.F, first + j), below.size());
  const double by_below = variance(below);
  return by_below / (by_below + variance(difference(level.s.y, below)));
}

inline FidelityLevelReport report_of(const CokrigingLevel& level) {
  return {level.name,
          level.X.rows(),
          level.rho_coefficients(),
          rho_standard_errors(level),
          explained_share(level),
          level.variance(),
          level.s.nugget * level.variance(),
          level.s.report};
}

inline CokrigingLevel with_rows(const CokrigingLevel& level, const std::vector<Index>& rows) {
  CokrigingLevel some = level;
  some.X = rows_of(level.X, rows);
  some.s.observed = entries_of(level.s.observed, rows);
  if (some.s.noise.size() > 0) some.s.noise = entries_of(level.s.noise, rows);
  return some;
}

/// Whether the runs of a level that is built tell the coefficients of its trend and of ρ.
inline bool tells_coefficients(const CokrigingLevels& below, const CokrigingLevel& level) {
  const Index terms = level.s.trend.size();
  const Eigen::MatrixXd f = level.s.F.leftCols(terms);
  if (static_cast<Index>(independent_columns(f).size()) < terms) return false;
  if (level.rho.empty()) return true;
  return told_rho(below, {level.s.X, f, level.runs_below, level.rho, level.below_centre}).size() ==
         level.rho.size();
}

/// The levels without their runs at x, ρ, θ, s² and λ as they are. None where a level's runs left do not tell
/// its coefficients.
inline std::optional<CokrigingLevels> without_runs_at(const CokrigingLevels& levels,
                                                      const Eigen::VectorXd& x) {
  CokrigingLevels others;
  bool changed = false;
  for (const CokrigingLevel& level : levels) {
    std::vector<Index> rows;
    for (Index i = 0; i < level.X.rows(); ++i)
      if (level.X.row(i).transpose() != x) rows.push_back(i);
    const auto left = static_cast<Index>(rows.size());
    if (left < level.s.F.cols()) return {};
    const bool take = left < level.X.rows();
    CokrigingLevel other = take ? with_rows(level, rows) : level;
    changed = changed || take;
    if (changed) build_regular(others, other);
    if (changed && !tells_coefficients(others, other)) return {};
    others.push_back(std::move(other));
  }
  return others;
}

}  // namespace detail

/// Each true run as predicted without the runs of any level at its place, since a new point has none; ρ of
/// each level, β estimated anew, the other parameters as fitted. NaN, and so the scores, for a run without
/// which a level's runs do not tell ρ and β (detail/told_rho.hpp): leaving such a run in would flatter the
/// model. Cost n³ of each level per true run.
inline Validation leave_one_out(const FidelityModel& model) {
  const detail::CokrigingLevel& last = model.levels().back();
  Validation v = detail::blank_validation(last.s.observed);
  for (Eigen::Index i = 0; i < last.X.rows(); ++i) {
    const Eigen::MatrixXd x = last.X.row(i);
    std::optional<detail::CokrigingLevels> others =
        detail::without_runs_at(model.levels(), x.row(0).transpose());
    if (!others) {
      v.predicted[i] = v.variance[i] = v.observation_variance[i] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    const Prediction p = FidelityModel(*std::move(others), {}).predict(x);
    v.predicted[i] = p.mean[0];
    v.variance[i] = p.variance[0];
    const double weight = last.s.noise.size() > 0 ? last.s.noise[i] : 1.0;
    v.observation_variance[i] = p.variance[0] + weight * model.noise_variance();
  }
  return detail::scored(std::move(v));
}

}  // namespace drawpoint::kriging
