// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A short climb of a likelihood in a box, by value(p) and gradient(p): for Kriging, to tell good starts from
/// bad ones before Ipopt polishes the best.
///
/// Projected quasi-Newton steps: parameters at a bound that the gradient pushes outward are held, the others
/// move by B⁻¹g, clipped to the box and to e^2.5 per step, shortened until the gain is 1e-4 of the promised one
/// (Armijo). B ≈ −∂²LL/∂p∂p by damped BFGS updates (Nocedal, Wright 2006, "Numerical Optimization", procedure
/// 18.2 and section 16.7). A climb is done when ½ gᵀB⁻¹g, the gain that B promises, falls below a limit.
/// Cost: one gradient a step, plus one value for each shortening.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/dense.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

class Likelihood;

struct Box {
  Eigen::VectorXd lower, upper;
};

namespace detail {

/// Positive definite approximation of −∂²LL/∂p∂p, from changes of the gradient g of LL.
class Curvature {
 public:
  bool empty() const { return B_.size() == 0; }
  const Eigen::MatrixXd& matrix() const { return B_; }

  void start(const Eigen::MatrixXd& B, const Eigen::VectorXd& p, const Eigen::VectorXd& g) {
    B_ = B;
    p_ = p;
    g_ = g;
  }

  void move_to(const Eigen::VectorXd& p, const Eigen::VectorXd& g) {
    const Eigen::VectorXd s = difference(p, p_), Bs = product(B_, s);
    Eigen::VectorXd y = difference(g_, g);
    const double curvature = dot(s, Bs), along = dot(s, y);
    p_ = p;
    g_ = g;
    if (!(curvature > 1e-14)) return;
    if (along < 0.2 * curvature) {
      const double share = 0.8 * curvature / (curvature - along);
      y = affine(y, share);
      add_scaled(y.data(), 1.0 - share, Bs.data(), y.size());
    }
    add_outer(B_, 1.0 / dot(s, y), y, y);
    add_outer(B_, -1.0 / curvature, Bs, Bs);
  }

 private:
  Eigen::MatrixXd B_;
  Eigen::VectorXd p_, g_;
};

/// Parameters that a bound does not hold against the gradient g of a function that is maximised.
inline std::vector<Eigen::Index> free_parameters(const Box& box, const Eigen::VectorXd& p,
                                                 const Eigen::VectorXd& g) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    const bool held = box.lower[i] == box.upper[i] || (p[i] <= box.lower[i] && g[i] <= 0) ||
                      (p[i] >= box.upper[i] && g[i] >= 0);
    if (!held) free.push_back(i);
  }
  return free;
}

/// B⁻¹g of the free parameters, 0 for the others; not finite where B is not positive definite.
inline Eigen::VectorXd newton_step(const Eigen::MatrixXd& B, const std::vector<Eigen::Index>& free,
                                   const Eigen::VectorXd& g) {
  Eigen::MatrixXd L = rows_of(columns_of(B, free), free);
  Eigen::VectorXd some = entries_of(g, free), step = Eigen::VectorXd::Zero(g.size());
  const bool positive = factor(block_of(L), 1);
  solve_lower(L, some);
  solve_lower_transposed(L, some);
  for (std::size_t i = 0; i < free.size(); ++i)
    step[free[i]] = positive ? some[static_cast<Index>(i)] : std::numeric_limits<double>::quiet_NaN();
  return step;
}

/// p + length · step, moved into the box.
inline Eigen::VectorXd moved(const Box& box, const Eigen::VectorXd& p, double length,
                             const Eigen::VectorXd& step) {
  Eigen::VectorXd at = p;
  for (Index i = 0; i < p.size(); ++i)
    at[i] = std::min(std::max(p[i] + length * step[i], box.lower[i]), box.upper[i]);
  return at;
}

template <class Objective>
class BoxClimb {
 public:
  BoxClimb(Objective& likelihood, const Box& box, Eigen::VectorXd start)
      : likelihood_(&likelihood), box_(&box), p_(std::move(start)), value_(likelihood.value(p_)) {}

  const Eigen::VectorXd& p() const { return p_; }
  double value() const { return value_; }
  bool done() const { return done_; }
  /// Empty before the first step.
  const Eigen::MatrixXd& curvature() const { return curvature_.matrix(); }

  /// Up to `count` steps.
  void advance(int count, double least_gain) {
    if (!std::isfinite(value_)) done_ = true;
    for (int i = 0; i < count && !done_; ++i) advance_once(least_gain);
  }

 private:
  static constexpr double longest = 2.5;

  void advance_once(double least_gain) {
    if (curvature_.empty()) begin();
    const auto free = free_parameters(*box_, p_, g_);
    Eigen::VectorXd step = newton_step(curvature_.matrix(), free, g_);
    done_ = !(0.5 * dot(step, g_) >= least_gain);
    if (done_) return;
    const double size = std::max(largest_entry(step), -smallest_entry(step));
    step = affine(step, std::min(1.0, longest / size));
    done_ = !search_along(step);
    if (done_) return;
    g_ = likelihood_->gradient(p_);
    if (scaled_) return curvature_.move_to(p_, g_);
    scaled_ = true;
    rescale();
  }

  void begin() {
    g_ = likelihood_->gradient(p_);
    curvature_.start(scaled_identity(p_.size(), std::max(std::sqrt(square(g_)), 1e-6)), p_, g_);
    first_p_ = p_;
    first_g_ = g_;
  }

  // After the first step the identity gets the curvature that was met along it.
  void rescale() {
    const Eigen::VectorXd s = difference(p_, first_p_), y = difference(first_g_, g_);
    const double met = dot(s, y) > 0 ? square(y) / dot(s, y) : std::sqrt(square(first_g_));
    curvature_.start(scaled_identity(p_.size(), met), first_p_, first_g_);
    curvature_.move_to(p_, g_);
  }

  bool search_along(const Eigen::VectorXd& step) {
    double length = 1.0;
    for (int attempt = 0; attempt < 6; ++attempt, length *= 0.25) {
      const Eigen::VectorXd p = moved(*box_, p_, length, step);
      const double value = likelihood_->value(p);
      if (!(value >= value_ + 1e-4 * dot(g_, difference(p, p_)))) continue;
      p_ = p;
      value_ = value;
      return true;
    }
    return false;
  }

  Objective* likelihood_;
  const Box* box_;
  Eigen::VectorXd p_, g_, first_p_, first_g_;
  double value_;
  Curvature curvature_;
  bool scaled_ = false, done_ = false;
};

using Climb = BoxClimb<Likelihood>;

}  // namespace detail
}  // namespace drawpoint::kriging
