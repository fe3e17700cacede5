// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
#include <drawpoint/engine/solver/contact_law.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>

/// The contact law on double: the steps of contact_law-inl.h, and the terms of a problem's points and rows.
namespace drawpoint::engine::detail::law {

template <class T>
T number(double x) {
  return x;
}
constexpr double singular_determinant = constants::singular_double;

inline bool none(bool condition) { return !condition; }
inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
using std::abs, std::max, std::min, std::sqrt;

/// Σ and Υ of a point in one of S substeps; the damping time is at least `least_damping_steps` whole steps.
inline SpookTerms spook_terms(const ContactPoint& point, double step, int substeps) {
  const double tau = std::max(point.damping_time, constants::least_damping_steps * step);
  return spook(point.stiffness, tau, step / substeps);
}

/// b of a machine's row [m/s] or [rad/s], at the gap of a stop [m] or [rad] (super_body.hpp).
inline double bias_velocity(const SuperBodyRow& row, double gap, double h) {
  if (row.kind == SuperBodyRow::Kind::motor) return row.target;
  return gap >= 0 ? -gap / h : -gap / row.recovery;
}

}  // namespace drawpoint::engine::detail::law

namespace drawpoint::engine::detail {
#include <drawpoint/engine/solver/contact_law-inl.h>
}  // namespace drawpoint::engine::detail
