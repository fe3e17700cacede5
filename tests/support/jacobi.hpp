// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

/// Jacobi's elliptic functions sn, cn, dn of argument u and modulus k, 0 ≤ k < 1.
///
/// By the descending sequence of arithmetic-geometric means (Abramowitz and Stegun 16.4): with a₀ = 1,
/// b₀ = √(1−k²), c₀ = k the means converge quadratically; φ_N = 2^N a_N u and sin(2φ_{n−1} − φ_n) =
/// (c_n / a_n) sin φ_n lead back to the amplitude φ₀. Exact to round-off of u.
namespace drawpoint::support {

struct Jacobi {
  double sn, cn, dn;
};

inline Jacobi jacobi(double u, double k) {
  std::vector<double> a{1.0}, c{k};
  double b = std::sqrt(1 - k * k);
  while (c.back() > 1e-9) {  // the next is c²/4: nothing
    const double mean = 0.5 * (a.back() + b);
    c.push_back(0.5 * (a.back() - b));
    b = std::sqrt(a.back() * b);
    a.push_back(mean);
  }
  double phi = std::ldexp(a.back() * u, static_cast<int>(a.size()) - 1);
  for (std::size_t n = a.size() - 1; n > 0; --n) phi = 0.5 * (phi + std::asin(c[n] / a[n] * std::sin(phi)));
  const double sn = std::sin(phi), cn = std::cos(phi);
  return {sn, cn, std::sqrt(1 - k * k * sn * sn)};
}

}  // namespace drawpoint::support
