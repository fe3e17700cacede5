// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_law_scalar.h>
#include <Eigen/Dense>

/// The unknowns of a point or of a pair in the sequential iterations.
///
/// A block holds the impulse λ of a point (the moment of a pair) in the frame (n, t1, t2) and its response
/// W = J M⁻¹ Jᵀ, so that λ changes the velocity there by W Δλ. Its steps are those of contact_law-inl.h: the
/// normal first, then the tangents with the velocity that the normal's change leaves.
namespace drawpoint::engine::detail {

struct ContactBlock {
  Eigen::Matrix3d frame, W;
  double inverse_nn = 0;  ///< 1 / (W_nn + Σ)
  law::TangentInverse<double> inverse_tt{};
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero(), total = Eigen::Vector3d::Zero();  ///< in the frame
  Eigen::Vector3d previous = Eigen::Vector3d::Zero();    ///< what momentum goes on from
  Eigen::Vector3d correction = Eigen::Vector3d::Zero();  ///< of the start impulse, for an impact
  int rows_a = -1, rows_b = -1;  ///< index of a side's rows (super_body_motion.hpp), if it is a machine part

  /// λ + share (λ − previous), but for a share of 0; then λ as it was is `previous`.
  void add_momentum(double share);
  /// Fills the inverses from W and Σ.
  void invert(double sigma);
  /// The tangents' step against u within the cone of radius `limit`; `before`: λ_n before the normal's step.
  void step_tangents(const Eigen::Vector3d& u, double before, double limit);
};

struct PointBlock : ContactBlock {
  int a, b;
  Eigen::Vector3d arm_a, arm_b;
  double friction, gap, target;
  double initial_impulse;  ///< the normal impulse that the substep began with
  SpookTerms terms;
};

/// The moment between a pair, in the frame of its normal.
struct PairBlock : ContactBlock {
  int a, b, first, count;
  double rolling_arm, spinning_arm;
};

inline void ContactBlock::add_momentum(double share) {
  const Eigen::Vector3d without = impulse;
  if (share > 0) impulse += share * (impulse - previous);
  previous = without;
}

inline void ContactBlock::invert(double sigma) {
  inverse_nn = law::inverse_or_zero(W(0, 0) + sigma);
  inverse_tt = law::invert_tangents(W(1, 1), W(1, 2), W(2, 2));
}

inline void ContactBlock::step_tangents(const Eigen::Vector3d& u, double before, double limit) {
  const double dn = impulse[0] - before;
  law::tangent_step(impulse[1], impulse[2], u[1] + W(1, 0) * dn, u[2] + W(2, 0) * dn, inverse_tt, limit);
}

}  // namespace drawpoint::engine::detail
