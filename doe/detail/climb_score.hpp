// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// From one point of the unit box uphill to the next maximum of a score.
///
/// Projected quasi-Newton steps with slopes by central differences. Scores are asked for many points at once,
/// twice per step: 2d for the slopes, then 14 lengths along the step, from four times to 1/2048 of it, of
/// which the best is taken. Coordinates at a bound that the slope pushes outward are held. Where no length
/// gains, the curvature is forgotten once, then the spacing of the differences shrinks tenfold, from 1e-4 to
/// 1e-6 of the box; after that the climb ends. Where the score is constant, as in a Voronoi cell, it ends at
/// once. NaN and −∞ are places where no point may be. On a smooth score the maximum is met to some 1e-6 of
/// the box: the slope is off by spacing² times a third derivative. Cost: 2d + 14 scores a step, some 10 to 30
/// steps. Source: as kriging/detail/climb.hpp; BFGS in Nocedal, Wright 2006, "Numerical Optimization",
/// section 6.1.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace drawpoint::doe::detail {

/// Scores of the rows of U, unit box, m x d.
using UnitScore = std::function<Eigen::VectorXd(const Eigen::MatrixXd& U)>;

struct ScoredPoint {
  Eigen::VectorXd u;
  double score;
};

class ScoreClimb {
 public:
  /// `free`: the coordinates that may move.
  ScoreClimb(const UnitScore& score, ScoredPoint from, std::vector<Eigen::Index> free)
      : score_(score), at_(std::move(from)), free_(std::move(free)) {
    forget();
  }

  ScoredPoint top() {
    constexpr int most = 60;
    for (int step = 0; step < most && spacing_ >= 1e-6 && !free_.empty(); ++step) {
      const Eigen::VectorXd slope = slopes();
      if (step > 0) learn(slope);
      slope_ = slope;
      if (!(slope.norm() > 0)) break;
      if (!move_along(direction(slope))) give_way();
    }
    return at_;
  }

 private:
  static constexpr double reach = 0.1;  // of the first step, in the unit box

  void forget() {
    inverse_ = Eigen::MatrixXd();
    moved_ = Eigen::VectorXd::Zero(at_.u.size());
  }

  /// The score's gradient; 0 where a coordinate is fixed, pushed out of the box or has a neighbour without a score.
  Eigen::VectorXd slopes() const {
    const auto n = static_cast<Eigen::Index>(free_.size());
    Eigen::MatrixXd U(2 * n, at_.u.size());
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::Index j = free_[static_cast<std::size_t>(k)];
      U.row(2 * k) = U.row(2 * k + 1) = at_.u.transpose();
      U(2 * k, j) = std::min(at_.u[j] + spacing_, 1.0);
      U(2 * k + 1, j) = std::max(at_.u[j] - spacing_, 0.0);
    }
    const Eigen::VectorXd score = score_(U);
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(at_.u.size());
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::Index j = free_[static_cast<std::size_t>(k)];
      const double rise = (score[2 * k] - score[2 * k + 1]) / (U(2 * k, j) - U(2 * k + 1, j));
      const bool outward = (rise > 0 && at_.u[j] >= 1.0) || (rise < 0 && at_.u[j] <= 0.0);
      slope[j] = std::isfinite(rise) && !outward ? rise : 0.0;
    }
    return slope;
  }

  /// BFGS update of the inverse curvature from the last move; slopes fall where a maximum is near.
  void learn(const Eigen::VectorXd& slope) {
    const Eigen::VectorXd y = slope_ - slope;
    const double along = moved_.dot(y);
    if (!(along > 1e-12 * moved_.norm() * y.norm())) return;
    const auto d = at_.u.size();
    if (inverse_.size() == 0) inverse_ = Eigen::MatrixXd::Identity(d, d) * (along / y.squaredNorm());
    const Eigen::VectorXd Hy = inverse_ * y;
    inverse_ += (1.0 + y.dot(Hy) / along) / along * moved_ * moved_.transpose() -
                (Hy * moved_.transpose() + moved_ * Hy.transpose()) / along;
  }

  /// Uphill; of length `reach` while no curvature is known.
  Eigen::VectorXd direction(const Eigen::VectorXd& slope) const {
    if (inverse_.size() == 0) return reach / slope.norm() * slope;
    Eigen::VectorXd step = inverse_ * slope;
    for (Eigen::Index j = 0; j < step.size(); ++j) step[j] = slope[j] == 0.0 ? 0.0 : step[j];
    return step.dot(slope) > 0 ? step : Eigen::VectorXd(reach / slope.norm() * slope);
  }

  bool move_along(const Eigen::VectorXd& step) {
    constexpr Eigen::Index lengths = 14;
    Eigen::MatrixXd U(lengths, at_.u.size());
    for (Eigen::Index i = 0; i < lengths; ++i)
      U.row(i) = (at_.u + std::ldexp(4.0, -static_cast<int>(i)) * step).cwiseMax(0.0).cwiseMin(1.0);
    const Eigen::VectorXd score = score_(U);
    Eigen::Index best = -1;
    double highest = at_.score;
    for (Eigen::Index i = 0; i < lengths; ++i)
      if (score[i] > highest) best = i, highest = score[i];
    if (best < 0) return false;
    moved_ = U.row(best).transpose() - at_.u;
    at_ = {U.row(best).transpose(), highest};
    return true;
  }

  void give_way() {
    if (inverse_.size() == 0) spacing_ *= 0.1;
    forget();
  }

  const UnitScore& score_;
  ScoredPoint at_;
  std::vector<Eigen::Index> free_;
  Eigen::MatrixXd inverse_;  // of the curvature; empty: unknown
  Eigen::VectorXd moved_, slope_;
  double spacing_ = 1e-4;
};

}  // namespace drawpoint::doe::detail
