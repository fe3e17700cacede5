// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Batches that are worth most together: the expected improvement of all their points at once.
///
/// With f* the best value so far and Y the latent function at the points of a batch,
///   q-EI(x₁ ... x_q) = E[(f* − min Yⱼ)⁺] = Σⱼ E[(f*ⱼ − Yⱼ)⁺],  f*ⱼ = min(f*, Y₁ ... Yⱼ₋₁)
/// The points are chosen one by one, each for its own term given those before it: at least 1 − 1/e of the
/// best batch's improvement, as for any monotone submodular function. The values of the chosen points are
/// drawn from their joint law by scrambled Sobol' points, the same draws for every candidate and every step;
/// given a draw k, Y at x is normal with
///   μₖ(x) = μ(x) + wᵀzₖ,  σ²(x) = s²(x) − wᵀw,  w = L⁻¹c(x, chosen),  L Lᵀ = the covariance of the chosen
/// and its improvement on the draw's best is exact. So the first point's term is the plain expected
/// improvement, and a point chosen twice adds nothing. For noisy responses the model is re-interpolated and
/// f* is its best fitted value, as in acquisition.hpp. Cost, with k chosen: that of a variance and k (n +
/// draws) per point. Sources: Ginsbourger, Le Riche, Carraro 2010, "Kriging is well-suited to parallelize
/// optimization"; Wilson, Hutter, Deisenroth 2018, "Maximizing acquisition functions for Bayesian
/// optimization" (one by one).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/kriging/acquisition.hpp>
#include <drawpoint/kriging/detail/covariance_with.hpp>

namespace drawpoint::kriging {

struct JointOptions {
  int draws = 64;         ///< of the chosen points' values, 1 or more; powers of 2 are the most even
  doe::Seed seed = 1;     ///< of the draws
  bool logarithm = true;  ///< ln of the expectation: the same order, also where the number underflows
};

namespace detail {

/// Standard normal numbers, points x draws: row j does not depend on how many rows there are.
inline Eigen::MatrixXd even_normal_draws(Index points, const JointOptions& options) {
  Eigen::MatrixXd Z(points, options.draws);
  const Index even = std::min<Index>(points, doe::detail::sobol_max_dimensions);
  doe::Problem unit;
  unit.responses = {{"y", "1"}};
  for (Index j = 0; j < even; ++j) unit.variables.push_back({"z" + std::to_string(j), "1", 0.0, 1.0});
  if (even > 0) {
    const Eigen::MatrixXd U = doe::scrambled_sobol(unit, options.draws, {.seed = options.seed});
    constexpr double edge = 1e-16;  // the quantiles of 0 and 1 are infinite
    for (Index j = 0; j < even; ++j)
      for (Index k = 0; k < Z.cols(); ++k)
        Z(j, k) = doe::detail::normal_quantile(std::clamp(U(k, j), edge, 1.0 - edge));
  }
  for (Index j = even; j < points; ++j) {
    doe::RandomStream random(doe::run_seed(options.seed, static_cast<std::uint64_t>(j), 1));
    for (Index k = 0; k < Z.cols(); ++k) Z(j, k) = random.normal();
  }
  return Z;
}

/// ln of the mean of E[(aₖ − Y)⁺] over the draws, Y of the means mₖ = aₖ − gainₖ and one deviation.
inline double log_mean_improvement(const Eigen::VectorXd& gain, double deviation) {
  const double draws = static_cast<double>(gain.size());
  double sum = 0;
  if (!(deviation > 0.0)) {
    for (const double g : gain) sum += std::max(g, 0.0);
    return std::log(sum / draws);
  }
  const double top = largest_entry(gain) / deviation;
  const bool far = top < -9.0;
  const double least = std::min(top, 0.0) - 9.0;  // what is left out is below h(−9) = 1e-20 of the largest
  const double scale = far ? log_normal_improvement(top) : 0.0;
  for (const double g : gain) {
    const double z = g / deviation;
    if (z < least) continue;
    // φ + zΦ has a relative round-off of z⁴ε, 1e-11 at z = −18, and takes a tenth of the time.
    sum += far ? std::exp(log_normal_improvement(z) - scale) : normal_density(z) + z * normal_probability(z);
  }
  return std::log(deviation) + scale + std::log(sum / draws);
}

/// What is to be improved on: the interpolating model and its best value.
struct JointTarget {
  std::shared_ptr<const Model> model;
  double best;   ///< sign times y
  double sign;   ///< +1 to minimise, −1 to maximise
  double floor;  ///< variances up to this are round-off
};

inline JointTarget joint_target(const char* place, const Model& model, doe::Goal goal,
                                const JointOptions& options) {
  if (options.draws < 1)
    throw std::invalid_argument(std::string(place) + ": draws is " + std::to_string(options.draws) +
                                "; allowed is 1 or more; 64 tell points of a batch apart");
  const double sign = sign_of(place, goal);
  auto interpolating = std::make_shared<const Model>(reinterpolated(model));
  const double floor = variance_floor(*interpolating);
  return {std::move(interpolating), smallest_entry(affine(fitted_values(model), sign)), sign, floor};
}

inline void check_chosen(const Model& model, const Eigen::MatrixXd& chosen) {
  const Index d = model.state().input.factor.size();
  if (chosen.rows() > 0 && chosen.cols() != d)
    throw std::invalid_argument("kriging::joint_improvement: the chosen points have " +
                                std::to_string(chosen.cols()) + " columns; allowed are " + std::to_string(d) +
                                ", one per input");
}

/// Chosen points with draws of their values, and the improvement of any other point on those.
class ChosenPoints {
 public:
  /// Z: k x d, natural units, k >= 0.
  ChosenPoints(JointTarget target, const Eigen::MatrixXd& Z, const JointOptions& options)
      : target_(std::move(target)),
        covariance_(target_.model, Z),
        root_(Eigen::MatrixXd::Zero(Z.rows(), Z.rows())),
        draws_(even_normal_draws(Z.rows(), options)),
        // Without a chosen point all draws are the same.
        best_(Eigen::VectorXd::Constant(Z.rows() > 0 ? options.draws : 1, target_.best)) {
    if (Z.rows() == 0) return;
    const Prediction p = target_.model->predict(Z);
    const Eigen::MatrixXd C = covariance_(Z);
    for (Index j = 0; j < Z.rows(); ++j) {
      for (Index i = 0; i < j; ++i)
        root_(j, i) = part_along(i, C(j, i), [&](Index a) { return root_(j, a); });
      double left =
          std::isfinite(p.variance[j]) ? p.variance[j] : 0.0;  // of one run nothing is known elsewhere
      for (Index i = 0; i < j; ++i) left -= root_(j, i) * root_(j, i);
      root_(j, j) = left > target_.floor ? std::sqrt(left) : 0.0;
      for (Index k = 0; k < best_.size(); ++k) {
        double value = p.mean[j];
        for (Index i = 0; i <= j; ++i) value += root_(j, i) * draws_(i, k);
        best_[k] = std::min(best_[k], target_.sign * value);
      }
    }
  }

  /// ln E[(f*ₖ − Y)⁺] over the draws, one entry per row of X: m x d.
  Eigen::VectorXd log_improvement(const Eigen::MatrixXd& X) const {
    const Prediction p = target_.model->predict(X);
    const Eigen::MatrixXd C = covariance_(X);
    Eigen::VectorXd score(X.rows()), w(root_.rows()), gain(best_.size());
    for (Index i = 0; i < X.rows(); ++i) {
      if (std::isinf(p.variance[i])) {
        score[i] = std::numeric_limits<double>::infinity();
        continue;
      }
      double variance = p.variance[i];
      for (Index j = 0; j < w.size(); ++j) {
        w[j] = part_along(j, C(i, j), [&](Index a) { return w[a]; });
        variance -= w[j] * w[j];
      }
      for (Index k = 0; k < gain.size(); ++k) {
        double mean = p.mean[i];
        for (Index j = 0; j < w.size(); ++j) mean += w[j] * draws_(j, k);
        gain[k] = best_[k] - target_.sign * mean;
      }
      score[i] = log_mean_improvement(gain, variance > target_.floor ? std::sqrt(variance) : 0.0);
    }
    return score;
  }

 private:
  /// The next entry of L⁻¹c; 0 along a point that the ones before it determine.
  template <class Before>
  double part_along(Index j, double covariance, const Before& before) const {
    if (root_(j, j) == 0.0) return 0.0;
    for (Index a = 0; a < j; ++a) covariance -= root_(j, a) * before(a);
    return covariance / root_(j, j);
  }

  JointTarget target_;
  CovarianceWith covariance_;
  Eigen::MatrixXd root_;   // L, k x k
  Eigen::MatrixXd draws_;  // k x draws
  Eigen::VectorXd best_;   // sign times y, one entry per draw
};

}  // namespace detail

/// What one more run adds to the expected improvement of those chosen, for doe::propose and doe::refine with
/// BatchRule::joint; goal: minimize or maximize. Throws std::invalid_argument for another goal and for
/// options out of range.
inline doe::JointCriterion joint_improvement(const Model& model, doe::Goal goal,
                                             const JointOptions& options = {}) {
  const detail::JointTarget target = detail::joint_target("kriging::joint_improvement", model, goal, options);
  return [target, options](const Eigen::MatrixXd& chosen) -> doe::Criterion {
    detail::check_chosen(*target.model, chosen);
    return [points = detail::ChosenPoints(target, chosen, options),
            options](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
      Eigen::VectorXd score = points.log_improvement(X);
      if (!options.logarithm)
        for (double& s : score) s = std::exp(s);
      return score;
    };
  };
}

/// q-EI of a batch: q x d, natural units; unit of y. Exact for one point. Throws as above.
inline double joint_expected_improvement(const Model& model, doe::Goal goal, const Eigen::MatrixXd& batch,
                                         const JointOptions& options = {}) {
  const detail::JointTarget target =
      detail::joint_target("kriging::joint_expected_improvement", model, goal, options);
  double sum = 0;
  for (Eigen::Index j = 0; j < batch.rows(); ++j)
    sum += std::exp(detail::ChosenPoints(target, batch.topRows(j), options).log_improvement(batch.row(j))[0]);
  return sum;
}

}  // namespace drawpoint::kriging
