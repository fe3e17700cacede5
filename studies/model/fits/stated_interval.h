// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The stated interval of a prediction: between the quantiles of 2.5 and 97.5 % of one run, noise included, both ends
/// within the response's range.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/score.hpp>

namespace drawpoint::studies {

/// The share of sound predictions that lies within their stated interval.
inline constexpr double stated_level = 0.95;

/// Unit of the response, within its range.
struct Interval {
  double lower = 0, upper = 0;

  bool holds(double y) const { return lower <= y && y <= upper; }
};

/// The interval of run i that the model was validated on.
inline Interval stated_interval(const kriging::Validation& v, Eigen::Index i, const doe::Response& response) {
  const auto end = [&](double p) {
    return doe::within_range(response, kriging::predicted_quantile(v, i, p));
  };
  return {end(0.5 - 0.5 * stated_level), end(0.5 + 0.5 * stated_level)};
}

/// How many of the runs lie within theirs.
inline int count_within(const kriging::Validation& v, const doe::Response& response) {
  int count = 0;
  for (Eigen::Index i = 0; i < v.observed.size(); ++i)
    count += stated_interval(v, i, response).holds(v.observed[i]);
  return count;
}

}  // namespace drawpoint::studies
