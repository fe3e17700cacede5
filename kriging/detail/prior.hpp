// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The jointly robust prior of θ and λ, and the prior of the weights of a sum: what keeps a fit from
/// explaining noise, or few runs, too well; and what keeps it from finding no noise where few runs cannot
/// tell.
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
///
/// One θ of m inputs that vary (isotropic): neighbouring runs lie c apart in each of the m, √m c in all, so t
/// has √m c β for it, and b = c (a + number of θ): the prior of one number is that of one number, not the
/// m-th power of it. The functions of a sum share the runs: c = √(d/n), at most 1, so that b t = d/n (a + d)
/// Σ βₖ expects n/d, the runs per input, for Σ βₖ. Of n^(−1/d), d/n and this the first loses sums that 5 d
/// runs tell, and intervals of the second are too narrow where the response is no sum (docs/measurements/
/// kriging.md). Both rules are ours.
///
/// The weights exp(vₖ)/Σ exp(vⱼ) do not change when all vₖ move alike. v is normal with a deviation of σ = 2
/// about 0, so that two weights differ by more than a factor of 7 as often as by less; Σ vₖ = 0 at a maximum;
/// without a prior only −Σ²vₖ/(2mσ²) is added, which is 0 at any maximum and holds them in place.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/parameter_places.hpp>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// What the prior takes the runs to be like.
struct RunSpacing {
  double spacing = 1;             ///< c
  std::vector<int> sharing = {};  ///< per θ how many inputs that vary have it
};

/// One θ per input. `inputs`: whether each of them varies.
inline RunSpacing spacing_of_product(Eigen::Index runs, const std::vector<bool>& inputs) {
  const auto varying = static_cast<double>(std::count(inputs.begin(), inputs.end(), true));
  return {std::pow(static_cast<double>(runs), -1.0 / std::max(varying, 1.0)),
          std::vector<int>(inputs.begin(), inputs.end())};
}

/// The same for the θ that stand at `places`.
inline RunSpacing spacing_of(const CorrelationFunction& f, const ParameterPlaces& places, Eigen::Index runs,
                             const std::vector<bool>& inputs) {
  RunSpacing s = spacing_of_product(runs, inputs);
  const auto varying = static_cast<double>(std::count(inputs.begin(), inputs.end(), true));
  if (f.structure == Structure::additive)
    s.spacing = std::sqrt(std::min(varying / static_cast<double>(runs), 1.0));
  s.sharing.assign(static_cast<std::size_t>(places.theta_count), 0);
  for (std::size_t k = 0; k < inputs.size(); ++k)
    s.sharing[static_cast<std::size_t>(places.thetas[k])] += inputs[k] ? 1 : 0;
  return s;
}

/// ln π of p = (ln θ, exponents, weights, ln λ), with its derivatives by p.
class JointlyRobustPrior {
 public:
  /// `noise`: whether λ counts; `nugget_power`: e.
  JointlyRobustPrior(const RunSpacing& runs, bool noise, double nugget_power)
      : noise_(noise), nugget_power_(noise ? nugget_power : 0.0), spacing_(runs.spacing) {
    for (const int inputs : runs.sharing) apart_.push_back(spacing_ * std::sqrt(static_cast<double>(inputs)));
    const auto varying =
        static_cast<double>(std::count_if(apart_.begin(), apart_.end(), [](double c) { return c > 0; }));
    rate_ = spacing_ * (power + varying);
  }

  /// One θ per input. `inputs`: whether each of them varies.
  JointlyRobustPrior(Eigen::Index runs, const std::vector<bool>& inputs, bool noise, double nugget_power)
      : JointlyRobustPrior(spacing_of_product(runs, inputs), noise, nugget_power) {}

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

  bool is_input(Eigen::Index k) const { return k < static_cast<Eigen::Index>(apart_.size()); }

  double total(const Eigen::VectorXd& p) const {
    double t = part_slope(p, p.size() - 1);
    for (Eigen::Index k = 0; is_input(k); ++k) t += 2.0 * part_slope(p, k);
    return t;
  }

  // ∂t/∂pₖ.
  double part_slope(const Eigen::VectorXd& p, Eigen::Index k) const {
    if (is_input(k))
      return apart_[static_cast<std::size_t>(k)] > 0
                 ? apart_[static_cast<std::size_t>(k)] * std::exp(0.5 * p[k])
                 : 0.0;
    return k == p.size() - 1 && noise_ ? std::exp(p[k]) : 0.0;
  }

  bool noise_;
  double nugget_power_;
  double spacing_ = 1, rate_ = 1;
  std::vector<double> apart_;  // per θ
};

/// ln π of the vₖ of a sum's weights, which stand in p from `first` on.
class WeightPrior {
 public:
  /// `inputs`: whether each of them varies; `whole`: all of the prior, or what holds Σ vₖ in place alone.
  WeightPrior(Eigen::Index first, std::vector<bool> inputs, bool whole)
      : first_(first), inputs_(std::move(inputs)), whole_(whole) {}

  double value(const Eigen::VectorXd& p) const {
    double squares = 0;
    for_each_input([&](Eigen::Index k) { squares += whole_ ? p[k] * p[k] : p[k] * mean(p); });
    return -0.5 * squares / variance;
  }

  void add_gradient(const Eigen::VectorXd& p, Eigen::VectorXd& g) const {
    for_each_input([&](Eigen::Index k) { g[k] -= (whole_ ? p[k] : mean(p)) / variance; });
  }

  void add_hessian(Eigen::MatrixXd& H) const {
    for_each_input([&](Eigen::Index a) {
      if (whole_)
        H(a, a) -= 1.0 / variance;
      else
        for_each_input([&](Eigen::Index b) { H(a, b) -= 1.0 / (variance * count()); });
    });
  }

 private:
  static constexpr double variance = 4.0;  // σ²

  double count() const { return static_cast<double>(std::count(inputs_.begin(), inputs_.end(), true)); }

  double mean(const Eigen::VectorXd& p) const {
    double sum = 0;
    for_each_input([&](Eigen::Index k) { sum += p[k]; });
    return sum / count();
  }

  template <class Use>
  void for_each_input(const Use& use) const {
    for (std::size_t k = 0; k < inputs_.size(); ++k)
      if (inputs_[k]) use(first_ + static_cast<Eigen::Index>(k));
  }

  Eigen::Index first_;
  std::vector<bool> inputs_;
  bool whole_;
};

}  // namespace drawpoint::kriging::detail
