// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/engine/loading/log/rainflow.hpp>

namespace drawpoint::engine::loading {
namespace {

std::vector<double> turning_points(std::span<const double> history) {
  std::vector<double> points;
  for (const double value : history) {
    const std::size_t n = points.size();
    if (n > 0 && value == points[n - 1]) continue;
    const bool goes_on = n > 1 && (points[n - 1] > points[n - 2]) == (value > points[n - 1]);
    if (goes_on)
      points.back() = value;
    else
      points.push_back(value);
  }
  return points;
}

CountedRange between(double a, double b, double count) { return {std::abs(b - a), (a + b) / 2, count}; }

}  // namespace

std::vector<CountedRange> rainflow(std::span<const double> history) {
  std::vector<CountedRange> cycles;
  std::vector<double> open;  // turning points whose ranges wait for a larger one
  for (const double point : turning_points(history)) {
    open.push_back(point);
    while (open.size() >= 3) {
      const auto end = open.end();
      if (std::abs(end[-1] - end[-2]) < std::abs(end[-2] - end[-3])) break;
      const bool at_start = open.size() == 3;
      cycles.push_back(between(end[-3], end[-2], at_start ? 0.5 : 1.0));
      if (at_start)
        open.erase(open.begin());
      else
        open.erase(end - 3, end - 1);
    }
  }
  for (std::size_t k = 1; k < open.size(); ++k) cycles.push_back(between(open[k - 1], open[k], 0.5));
  return cycles;
}

double miner_sum(std::span<const CountedRange> ranges, double exponent) {
  double sum = 0;
  for (const CountedRange& r : ranges) sum += r.count * std::pow(r.range, exponent);
  return sum;
}

}  // namespace drawpoint::engine::loading
