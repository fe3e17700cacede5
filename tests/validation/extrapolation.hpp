// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

/// Richardson's extrapolation of a stepper from runs with h, h/2, h/4, ...
///
/// With x(h) = x + c₁ h^p + c₂ h^(p+q) + …, p = q = 1 unless said otherwise, each column of the table,
/// X_{i,k} = X_{i,k−1} + (X_{i,k−1} − X_{i−1,k−1}) / (2^(p+(k−1)q) − 1), is an order better than the one
/// before. The last correction is the error, to leading order, of the value before it was made, so it bounds
/// what is left while the expansion holds. That it holds is checked by the order, log₂ of the ratio of the
/// last two differences x(h) − x(h/2), which must be p.
namespace drawpoint::validation {

struct Extrapolated {
  double value, correction, order;
};

/// x: the results with h, h/2, h/4, ...; at least three.
inline Extrapolated extrapolate(const std::vector<double>& x, int p = 1, int q = 1) {
  const std::size_t n = x.size();
  std::vector<double> column = x;
  double correction = 0;
  for (std::size_t k = 1; k < n; ++k)
    for (std::size_t i = n - 1; i >= k; --i) {
      const double step =
          (column[i] - column[i - 1]) / (std::ldexp(1.0, p + (static_cast<int>(k) - 1) * q) - 1);
      column[i] += step;
      if (i == n - 1) correction = std::abs(step);
    }
  const double order = std::log2(std::abs((x[n - 2] - x[n - 3]) / (x[n - 1] - x[n - 2])));
  return {column.back(), correction, order};
}

}  // namespace drawpoint::validation
