// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What the tables say of several seeds.

#include <algorithm>
#include <cmath>
#include <vector>

namespace drawpoint::benchmarks {

/// The upper of the two middle ones of an even number of values; NaN of none.
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? std::nan("") : values[values.size() / 2];
}

}  // namespace drawpoint::benchmarks
