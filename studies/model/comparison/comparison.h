// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The runs of two folders of one study, A and B, held against each other.
///
/// Runs of the same kind at the same point, bit for bit, are a pair: folders with the same seed have the same
/// first design. Replicates at a point are averaged first. What both sides have in common, the point and the
/// random numbers, cancels in the difference. A point where every run of a side failed has no value there and
/// is left out. Imported runs were made by neither side and do not count.
///
/// With fewer than two pairs the means over the points of training and validation are compared instead: those
/// are spread over the whole box on both sides, but at different points.

#include <drawpoint/studies/model/comparison/mean_differences.h>
#include <drawpoint/studies/run/store/store.h>

#include <cstdint>
#include <vector>

namespace drawpoint::studies {

/// A point that both sides tried and at least one has no value of.
struct PointLeftOut {
  std::vector<std::int64_t> runs_a, runs_b;
  bool failed_a = false, failed_b = false;
};

struct ResponseDifference {
  MeanDifference mean;
  int larger = 0, equal = 0;  ///< pairs in which B's value is larger, and equal; paired only
};

struct Comparison {
  int pairs = 0;
  bool paired = false;       ///< two pairs or more
  int with_other_seeds = 0;  ///< pairs whose runs have not the same seeds
  /// Points of a side with a value, imported ones apart; of training and validation where nothing is paired.
  int points_a = 0, points_b = 0;
  std::vector<PointLeftOut> left_out = {};         ///< in order of A's runs
  std::vector<ResponseDifference> responses = {};  ///< in order; empty: too few points to compare anything
};

Comparison compare_runs(const std::vector<Run>& a, const std::vector<Run>& b);

}  // namespace drawpoint::studies
