// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

/// Means with their confidence, for runs that are chaotic.
///
/// A mean over n independent values (seeds) with a 95 % interval by Student's t: mean ± t(0.975, n−1) s/√n.
/// One configuration against another is evaluated on the differences seed by seed, so that what the seeds
/// have in common cancels. Within one run values are correlated in time: the error of their mean is taken
/// from the means of blocks that are longer than the correlation, s_b/√(blocks).
namespace drawpoint::benchmarks {

struct Estimate {
  double mean = 0;
  double half_width = 0;  ///< of the 95 % interval; infinite for a single value
};

/// Student's t at 0.975. Table to 10 degrees of freedom, then the Cornish-Fisher series in 1/ν, good to 0.2 %
/// (Abramowitz and Stegun, 26.7.5).
inline double t_975(int degrees_of_freedom) {
  constexpr std::array<double, 10> table{12.706, 4.303, 3.182, 2.776, 2.571,
                                         2.447,  2.365, 2.306, 2.262, 2.228};
  if (degrees_of_freedom < 1) return std::numeric_limits<double>::infinity();
  if (degrees_of_freedom <= 10) return table[degrees_of_freedom - 1];
  const double z = 1.959964, n = degrees_of_freedom, z3 = z * z * z;
  return z + (z3 + z) / (4 * n) + (5 * z3 * z * z + 16 * z3 + 3 * z) / (96 * n * n);
}

inline double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// s/√n; infinite for fewer than two values.
inline double standard_error(const std::vector<double>& values) {
  const double mean = mean_of(values), n = static_cast<double>(values.size());
  if (n < 2) return std::numeric_limits<double>::infinity();
  double square = 0;
  for (const double v : values) square += (v - mean) * (v - mean);
  return std::sqrt(square / (n - 1) / n);
}

inline Estimate estimate(const std::vector<double>& values) {
  const int n = static_cast<int>(values.size());
  if (n < 2) return {mean_of(values), std::numeric_limits<double>::infinity()};
  return {mean_of(values), t_975(n - 1) * standard_error(values)};
}

/// Of a − b, value by value (same length).
inline Estimate paired_difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference;
  for (std::size_t k = 0; k < a.size(); ++k) difference.push_back(a[k] - b.at(k));
  return estimate(difference);
}

/// Means over consecutive blocks of `length` values; an incomplete last block is left out.
inline std::vector<double> block_means(const std::vector<double>& values, std::size_t length) {
  std::vector<double> means;
  for (std::size_t first = 0; first + length <= values.size(); first += length)
    means.push_back(mean_of({values.begin() + static_cast<std::ptrdiff_t>(first),
                             values.begin() + static_cast<std::ptrdiff_t>(first + length)}));
  return means;
}

/// Nearest-rank percentile, 0 < share ≤ 1; 0 without values.
inline double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1];
}

}  // namespace drawpoint::benchmarks
