// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

/// The ranges of a load history, as fatigue counts them.
///
/// A range and its count take the place of the history; Miner's rule sums them to the damage.
namespace drawpoint::engine::loading {

struct CountedRange {
  double range = 0, mean = 0;
  double count = 1;  ///< 1 or 1/2
};

/// Rainflow counting of ASTM E1049-85 (2017), section 5.4.4: the history's turning points, its first and last
/// value among them; a range that the next one reaches is a cycle, or half of one if it holds the history's
/// start; what is left at the end counts half. Empty for fewer than two different values. Cost: one pass.
/// Values must be finite.
std::vector<CountedRange> rainflow(std::span<const double> history);

/// Miner's sum for an S-N line of slope `exponent`: Σ count · range^exponent, in the history's unit to that
/// power. The 1/exponent-th power of it is the range of a single cycle that does the same damage.
double miner_sum(std::span<const CountedRange> ranges, double exponent);

}  // namespace drawpoint::engine::loading
