// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The jointly robust prior of θ and λ: what keeps a fit from explaining noise, or few runs, too well.
///
///   ln π = a ln t − b t,  t = Σₖ c βₖ + λ,  βₖ = 2√θₖ,  c = n^(−1/d),  a = 0.2,  b = c (a + d)
/// up to a constant. βₖ is the inverse length scale on [0, 1] and c the distance of n runs spread evenly in
/// d inputs, so c βₖ is how much of a length scale the runs lie apart. Where it is large for an input the runs
/// tell nothing of the response between them, and π falls as exp(−b t); where all of t vanishes, so that any
/// two runs are fully correlated, π falls as tᵃ. One input may lose its effect alone (βₖ = 0) at no cost. λ
/// does not count when the noise is known. Simplification: the density is of θ and λ, its maximum is taken in
/// their logarithms as that of the likelihood is, and βₖ is the Gaussian's for every correlation. Cost d.
/// Source: Gu 2019, Bayesian Analysis 14(3), "Jointly robust prior for Gaussian stochastic process in
/// emulation, calibration and variable selection", with its a and b.

#include <Eigen/Core>
#include <cmath>

namespace drawpoint::kriging::detail {

/// ln π of p = (ln θ of d inputs, exponents, ln λ), with its derivatives by p.
class JointlyRobustPrior {
 public:
  /// `varying`: inputs that vary, of which the runs tell something.
  JointlyRobustPrior(Eigen::Index runs, Eigen::Index inputs, Eigen::Index varying, bool noise_counts)
      : inputs_(inputs),
        spacing_(std::pow(static_cast<double>(runs), -1.0 / static_cast<double>(varying))),
        rate_(spacing_ * (power + static_cast<double>(varying))),
        noise_counts_(noise_counts) {}

  double value(const Eigen::VectorXd& p) const {
    const double t = total(p);
    return power * std::log(t) - rate_ * t;
  }

  void add_gradient(const Eigen::VectorXd& p, Eigen::VectorXd& g) const {
    const double slope = power / total(p) - rate_;
    for (Eigen::Index k = 0; k < p.size(); ++k) g[k] += slope * part_slope(p, k);
  }

  /// Lower triangle and its mirror.
  void add_hessian(const Eigen::VectorXd& p, Eigen::MatrixXd& H) const {
    const double t = total(p), slope = power / t - rate_, curvature = -power / (t * t);
    for (Eigen::Index a = 0; a < p.size(); ++a) {
      for (Eigen::Index b = 0; b < p.size(); ++b) H(a, b) += curvature * part_slope(p, a) * part_slope(p, b);
      H(a, a) += slope * part_slope(p, a) * (a < inputs_ ? 0.5 : 1.0);
    }
  }

 private:
  static constexpr double power = 0.2;

  double total(const Eigen::VectorXd& p) const {
    double t = 0;
    for (Eigen::Index k = 0; k < inputs_; ++k) t += 2.0 * part_slope(p, k);
    return t + part_slope(p, p.size() - 1);
  }

  // ∂t/∂pₖ.
  double part_slope(const Eigen::VectorXd& p, Eigen::Index k) const {
    if (k < inputs_) return spacing_ * std::exp(0.5 * p[k]);
    return k == p.size() - 1 && noise_counts_ ? std::exp(p[k]) : 0.0;
  }

  Eigen::Index inputs_;
  double spacing_, rate_;
  bool noise_counts_;
};

}  // namespace drawpoint::kriging::detail
