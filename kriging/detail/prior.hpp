// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The jointly robust prior of θ and λ: what keeps a fit from explaining noise, or few runs, too well; and
/// what keeps it from finding no noise where few runs cannot tell.
///
///   ln π = a ln t − b t + e ln λ,  t = Σₖ c βₖ + λ,  βₖ = 2√θₖ,  c = n^(−1/d),  a = 0.2,  b = c (a + d)
/// up to a constant. βₖ is the rate of exp(−(βₖΔ)²) on [0, 1], 1/(√2 l) for a length scale l, and c what n
/// runs spread evenly in d inputs lie apart, so c βₖ is how much of a length scale lies between runs. Where
/// it is large for an input the runs tell nothing of the response between them, and π falls as exp(−b t);
/// where all of t vanishes, so that any two runs are fully correlated, π falls as tᵃ. One input may lose its
/// effect alone (βₖ = 0) at no cost. Inputs that never vary do not count, nor does λ when the noise is known.
/// The maximum is taken in the logarithms without a Jacobian, as Gu's RobustGaSP takes it, but for e ln λ,
/// which is not Gu's: with e = 1/2 it is the Jacobian of the noise's deviation √λ. Without it the likelihood
/// of some 40 runs is often flat from a per cent of noise down to none, and highest anywhere on the way; a
/// maximum at no noise makes every error bar too narrow. It moves the deviation by about a standard error at
/// most where the runs tell it, and takes a little from a simulator without noise: λ then ends where
/// likelihood is lost at half a unit per factor of e. Simplifications: the likelihood is
/// the concentrated one, where Gu integrates trend and s² out; the runs are taken to fill the box that inputs
/// are scaled by; βₖ is the Gaussian's for every correlation. Cost d. Source: Gu 2019, Bayesian Analysis
/// 14(3), "Jointly robust prior for Gaussian stochastic process in emulation, calibration and variable
/// selection", with its a and b; Chung, Rabe-Hesketh, Dorie, Gelman, Liu 2013, Psychometrika 78(4), "A
/// nondegenerate penalized likelihood estimator for variance parameters in multilevel models", for e.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// ln π of p = (ln θ of d inputs, exponents, ln λ), with its derivatives by p.
class JointlyRobustPrior {
 public:
  /// `inputs`: whether each of them varies; `noise`: whether λ counts; `nugget_power`: e.
  JointlyRobustPrior(Eigen::Index runs, std::vector<bool> inputs, bool noise, double nugget_power)
      : inputs_(std::move(inputs)), noise_(noise), nugget_power_(noise ? nugget_power : 0.0) {
    const auto varying = static_cast<double>(std::count(inputs_.begin(), inputs_.end(), true));
    spacing_ = std::pow(static_cast<double>(runs), -1.0 / std::max(varying, 1.0));
    rate_ = spacing_ * (power + varying);
  }

  double value(const Eigen::VectorXd& p) const {
    const double t = total(p);
    return power * std::log(t) - rate_ * t + nugget_power_ * p[p.size() - 1];
  }

  void add_gradient(const Eigen::VectorXd& p, Eigen::VectorXd& g) const {
    const double slope = power / total(p) - rate_;
    for (Eigen::Index k = 0; k < p.size(); ++k) g[k] += slope * part_slope(p, k);
    g[p.size() - 1] += nugget_power_;
  }

  /// Lower triangle and its mirror.
  void add_hessian(const Eigen::VectorXd& p, Eigen::MatrixXd& H) const {
    const double t = total(p), slope = power / t - rate_, curvature = -power / (t * t);
    for (Eigen::Index a = 0; a < p.size(); ++a) {
      for (Eigen::Index b = 0; b < p.size(); ++b) H(a, b) += curvature * part_slope(p, a) * part_slope(p, b);
      H(a, a) += slope * part_slope(p, a) * (is_input(a) ? 0.5 : 1.0);
    }
  }

 private:
  static constexpr double power = 0.2;

  bool is_input(Eigen::Index k) const { return k < static_cast<Eigen::Index>(inputs_.size()); }

  double total(const Eigen::VectorXd& p) const {
    double t = part_slope(p, p.size() - 1);
    for (Eigen::Index k = 0; is_input(k); ++k) t += 2.0 * part_slope(p, k);
    return t;
  }

  // ∂t/∂pₖ.
  double part_slope(const Eigen::VectorXd& p, Eigen::Index k) const {
    if (is_input(k)) return inputs_[static_cast<std::size_t>(k)] ? spacing_ * std::exp(0.5 * p[k]) : 0.0;
    return k == p.size() - 1 && noise_ ? std::exp(p[k]) : 0.0;
  }

  std::vector<bool> inputs_;
  bool noise_;
  double nugget_power_;
  double spacing_ = 1, rate_ = 1;
};

}  // namespace drawpoint::kriging::detail
