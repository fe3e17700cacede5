// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_law_scalar.h>
#include <Eigen/Dense>
#include <cmath>

/// The unknowns of a point or of a pair in the sequential iterations, with the step that an iteration takes
/// on its tangents.
///
/// A block holds the impulse λ of a point (the moment of a pair) in the frame (n, t1, t2) and its response
/// W = J M⁻¹ Jᵀ, so that λ changes the velocity there by W Δλ. With the velocity u the normal's step is
/// λ_n − (u_n + Σ λ_n − b) / (W_nn + Σ), cut off at its limits. The tangents stick, λ_t − W_tt⁻¹ u_t, where
/// the cone |λ_t| ≤ limit allows it; else they take the scalar step λ_t − u_t / ρ, ρ = λ_max(W_tt), and are
/// projected on the cone. The scalar step also serves where W_tt is singular: a machine part with few
/// freedoms does not answer in every direction.
namespace drawpoint::engine::detail {

struct ContactBlock {
  Eigen::Matrix3d frame, W;
  double inverse_nn = 0;      ///< 1 / (W_nn + Σ)
  double inverse_tt[3] = {};  ///< of the tangents' 2 x 2 block: xx, xy, yy
  double inverse_rho = 0;     ///< 1 / λ_max of that block
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero(), total = Eigen::Vector3d::Zero();  ///< in the frame
  Eigen::Vector3d correction = Eigen::Vector3d::Zero();  ///< of the start impulse, for an impact
  int rows_a = -1, rows_b = -1;  ///< index of a side's rows (super_body_motion.hpp), if it is a machine part

  /// Fills the inverses from W and Σ.
  void invert(double sigma);
  /// The tangents' step against their velocity (u1, u2) within the cone of radius `limit`.
  void project_tangents(double u1, double u2, double limit);
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

inline void ContactBlock::invert(double sigma) {
  inverse_nn = law::inverse_or_zero(W(0, 0) + sigma);
  const double a = W(1, 1), b = W(1, 2), d = W(2, 2);
  const double rho = 0.5 * (a + d) + std::hypot(0.5 * (a - d), b);
  inverse_rho = law::inverse_or_zero(rho);
  const double det = a * d - b * b;
  const bool regular = det > constants::singular_double * rho * rho;
  inverse_tt[0] = regular ? d / det : inverse_rho;
  inverse_tt[1] = regular ? -b / det : 0;
  inverse_tt[2] = regular ? a / det : inverse_rho;
}

inline void ContactBlock::project_tangents(double u1, double u2, double limit) {
  double t1 = impulse[1] - (inverse_tt[0] * u1 + inverse_tt[1] * u2);
  double t2 = impulse[2] - (inverse_tt[1] * u1 + inverse_tt[2] * u2);
  if (t1 * t1 + t2 * t2 > limit * limit) {
    t1 = impulse[1] - inverse_rho * u1;
    t2 = impulse[2] - inverse_rho * u2;
    const double length = std::sqrt(t1 * t1 + t2 * t2);
    if (length > limit) {
      t1 *= limit / length;
      t2 *= limit / length;
    }
  }
  impulse[1] = t1;
  impulse[2] = t2;
}

}  // namespace drawpoint::engine::detail
