// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Predictions held against the runs that were made afterwards.
///
/// The stated interval of a prediction is mean ± 1.96 standard deviations of one run, noise included, both ends
/// within the response's range. Of sound intervals 95 % hold their value; fewer are blamed on the models when
/// chance alone would give so few with a probability below 10 % (binomial). The responses of one run are not
/// independent, so that this blames somewhat too often.

#include <drawpoint/doe/outcome.hpp>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// One entry per response in predicted, lower, upper and within.
struct CheckedRun {
  std::int64_t run = 0;
  Eigen::VectorXd x = {};
  doe::Outcome outcome = {};
  Eigen::VectorXd predicted = {}, lower = {}, upper = {};
  std::vector<bool> within = {};  ///< false where the run failed
  bool dominated = false;         ///< by an earlier run that keeps all limits
};

struct CheckedRuns {
  std::vector<CheckedRun> runs = {};
  int values = 0, within = 0;  ///< of objectives and limits of the runs that succeeded
  int failed = 0, dominated = 0;

  /// Whether so few values within their intervals may be chance.
  bool agree() const;
};

/// Probability that at most k of n independent values lie within intervals that hold 95 % each.
double chance_of_at_most(int k, int n);

/// "6 points, 16 of 18 values within the stated 95 % interval, 1 failed, 2 dominated by earlier runs"
std::string text(const CheckedRuns& checked);

}  // namespace drawpoint::studies
