// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <drawpoint/engine/base/eigen.hpp>
#include <stdexcept>
#include <string>

/// Checks of numbers, vectors and rotations that come from outside, and how their messages name them: the one
/// owner of how far a unit vector may be off length 1 and a rotation matrix off orthonormal.
namespace drawpoint::engine::detail {

/// A limit and how messages write it.
struct Tolerance {
  double value;
  const char* text;
};

/// [1] Off 1: the length of a unit vector, after normalized() and a few operations. Chosen here, 1e6 times
/// their round-off. Higher: gaps along the vector are wrong by as much, relatively. Lower: what was
/// written as text with ten digits is refused.
inline constexpr Tolerance unit_length{1e-9, "1e-9"};

/// [1] The norm of RᵀR − 1 of a rotation matrix, within what the steps of a long run leave of it. Chosen
/// here. Higher: shapes are sheared by as much, relatively. Lower: poses that a user composed in single
/// precision are refused.
inline constexpr Tolerance orthonormal{1e-6, "1e-6"};

/// Six significant digits, as a stream writes them.
inline std::string text(double x) {
  std::array<char, 32> digits;
  std::snprintf(digits.data(), digits.size(), "%g", x);
  return digits.data();
}

/// "(x, y, z)".
inline std::string text(const Eigen::Vector3d& v) {
  std::array<char, 96> numbers;
  std::snprintf(numbers.data(), numbers.size(), "(%g, %g, %g)", v.x(), v.y(), v.z());
  return numbers.data();
}

/// Both ends belong to it.
struct Range {
  double lower, upper;
  const char* unit;
};

/// Throws std::invalid_argument for a value out of range and for what is not a number; `name` is "place:
/// quantity".
inline void require(const std::string& name, double value, const Range& allowed) {
  if (value >= allowed.lower && value <= allowed.upper) return;
  throw std::invalid_argument(name + " is " + text(value) + " " + allowed.unit + "; allowed: " +
                              text(allowed.lower) + " to " + text(allowed.upper) + " " + allowed.unit);
}

/// False for what is not finite, as is_rotation().
inline bool is_unit(const Eigen::Vector3d& v) { return std::abs(v.norm() - 1) < unit_length.value; }

/// The norm of RᵀR − 1.
inline double off_orthonormal(const Eigen::Matrix3d& R) {
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
}

inline bool is_rotation(const Eigen::Matrix3d& R) {
  return off_orthonormal(R) < orthonormal.value && R.determinant() > 0;
}

}  // namespace drawpoint::engine::detail
