// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Co-Kriging of the runs of all levels at once, by one dense covariance matrix: the reference that the
/// recursion is tested against, for the Gaussian correlation, constant trends and a constant ρ.
///
/// With yₜ = ρₜ (yₜ₋₁ − cₜ) + βₜ + Zₜ: the covariance of level a at x with level b >= a at z is ρₐ₊₁ ⋯ ρ_b
/// times that within level a, and that within level t is ρₜ² times that within t − 1 plus sₜ² c(x, z). The
/// trend's columns are propagated alike. What the recursion adds by estimating ρₜ is one more column per
/// level: the mean mₜ₋₁(x) − cₜ that the runs of the levels below alone give, which are fixed numbers once
/// these runs are known; so it stands here as one, propagated as βₜ is.

#include <Eigen/Dense>
#include <cmath>
#include <vector>

namespace drawpoint::kriging::reference {

struct JointLevel {
  Eigen::MatrixXd X;         ///< natural units
  Eigen::VectorXd y, noise;  ///< n each: responses, noise variances
  Eigen::VectorXd rate;      ///< d: c = exp(−Σ rate (x − z)²)
  double variance = 1, rho = 0, centre = 0;
};

struct JointPrediction {
  double mean, variance;
};

class JointCokriging {
 public:
  /// `estimated_rho`: whether ρ has a column of its own, beside the given one.
  JointCokriging(std::vector<JointLevel> levels, bool estimated_rho)
      : levels_(std::move(levels)), estimated_(estimated_rho) {
    Eigen::Index n = 0;
    for (std::size_t t = 0; t < levels_.size(); ++t) {
      for (Eigen::Index i = 0; i < levels_[t].X.rows(); ++i) place_.push_back({t, i});
      n += levels_[t].X.rows();
    }
    Eigen::MatrixXd K(n, n);
    Eigen::MatrixXd F(n, columns(levels_.size() - 1));
    Eigen::VectorXd y(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& [t, row] = place_[static_cast<std::size_t>(i)];
      const Eigen::VectorXd x = levels_[t].X.row(row).transpose();
      F.row(i) = terms(t, x).transpose();
      y[i] = levels_[t].y[row] - offset(t);
      K.col(i) = with_runs(t, x);
      K(i, i) += levels_[t].noise[row];
    }
    solver_ = K.llt();
    const Eigen::MatrixXd KF = solver_.solve(F);
    F_ = F;
    spread_ = (F.transpose() * KF).inverse();
    beta_ = spread_ * (KF.transpose() * y);
    alpha_ = solver_.solve(y - F * beta_);
  }

  /// Of the last level at x.
  JointPrediction predict(const Eigen::VectorXd& x) const {
    const std::size_t t = levels_.size() - 1;
    const Eigen::VectorXd k = with_runs(t, x), f = terms(t, x), Kk = solver_.solve(k),
                          u = f - F_.transpose() * Kk;
    return {offset(t) + f.dot(beta_) + k.dot(alpha_), within(t, x, x) - k.dot(Kk) + u.dot(spread_ * u)};
  }

 private:
  Eigen::Index columns(std::size_t t) const {
    return static_cast<Eigen::Index>(estimated_ ? 2 * t + 1 : t + 1);
  }

  double offset(std::size_t t) const {
    return t == 0 ? 0.0 : levels_[t].rho * (offset(t - 1) - levels_[t].centre);
  }

  Eigen::VectorXd terms(std::size_t t, const Eigen::VectorXd& x) const {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(columns(levels_.size() - 1));
    if (t == 0) {
      f[0] = 1;
      return f;
    }
    f = levels_[t].rho * terms(t - 1, x);
    f[columns(t - 1)] = 1;
    if (estimated_) f[columns(t - 1) + 1] = below(t, x) - levels_[t].centre;
    return f;
  }

  double below(std::size_t t, const Eigen::VectorXd& x) const {
    return JointCokriging({levels_.begin(), levels_.begin() + static_cast<std::ptrdiff_t>(t)}, estimated_)
        .predict(x)
        .mean;
  }

  double within(std::size_t t, const Eigen::VectorXd& x, const Eigen::VectorXd& z) const {
    const JointLevel& level = levels_[t];
    const double own = level.variance * std::exp(-level.rate.dot((x - z).cwiseAbs2()));
    return t == 0 ? own : level.rho * level.rho * within(t - 1, x, z) + own;
  }

  // Covariances of level t at x with all runs.
  Eigen::VectorXd with_runs(std::size_t t, const Eigen::VectorXd& x) const {
    Eigen::VectorXd k(static_cast<Eigen::Index>(place_.size()));
    for (Eigen::Index i = 0; i < k.size(); ++i) {
      const auto& [s, row] = place_[static_cast<std::size_t>(i)];
      k[i] = within(std::min(s, t), x, levels_[s].X.row(row).transpose());
      for (std::size_t a = std::min(s, t) + 1; a <= std::max(s, t); ++a) k[i] *= levels_[a].rho;
    }
    return k;
  }

  struct Place {
    std::size_t level;
    Eigen::Index row;
  };
  std::vector<JointLevel> levels_;
  bool estimated_;
  std::vector<Place> place_;
  Eigen::MatrixXd F_, spread_;
  Eigen::VectorXd beta_, alpha_;
  Eigen::LLT<Eigen::MatrixXd> solver_;
};

}  // namespace drawpoint::kriging::reference
