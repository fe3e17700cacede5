// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Derivatives of what is computed, by differences.

#include <Eigen/Core>
#include <type_traits>

namespace drawpoint::kriging::reference {

/// By entry k of p, of a number, vector or matrix: Richardson's extrapolation of central differences with the
/// steps h and h/2.
template <class F>
auto derivative(const F& f, const Eigen::VectorXd& p, Eigen::Index k, double h) {
  using Value = std::decay_t<decltype(f(p))>;
  const auto central = [&](double width) -> Value {
    Eigen::VectorXd up = p, down = p;
    up[k] += width;
    down[k] -= width;
    return (f(up) - f(down)) / (2.0 * width);
  };
  const Value coarse = central(h), fine = central(0.5 * h);
  return Value((4.0 * fine - coarse) / 3.0);
}

}  // namespace drawpoint::kriging::reference
