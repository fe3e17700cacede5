// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Predictions held against the runs that were made afterwards.
///
/// Of sound intervals (model/fits/stated_interval.h) 95 % hold their value; fewer are blamed on the
/// models when chance alone would give so few with a probability below 10 % (binomial). The responses of one
/// run are not independent, so that this blames somewhat too often.

#include <drawpoint/doe/outcome.hpp>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// One entry per response in predicted, lower, upper and within.
struct CheckedRun {
  std::int64_t run = 0;
  int round = 0;       ///< of confirmations, from 1; 0: none
  bool named = false;  ///< the user asked for this place; it is no promise of a front
  Eigen::VectorXd x = {};
  doe::Outcome outcome = {};
  Eigen::VectorXd predicted = {}, lower = {}, upper = {};
  std::vector<bool> within = {};  ///< false where the run failed
  int values = 0, held = 0;       ///< objectives and limits, and how many lie within; 0 where the run failed
  bool dominated = false;         ///< by a run before its round that keeps all limits
  bool breaks_limit = false;
};

struct CheckedRuns {
  std::vector<CheckedRun> runs = {};
  int values = 0, within = 0;  ///< sums of CheckedRun::values and held
  int failed = 0, dominated = 0, breaking = 0;

  void add(CheckedRun run);
  /// Those of the last round alone.
  CheckedRuns last_round() const;
  /// Whether so few values within their intervals may be chance.
  bool may_be_chance() const;
  /// Whether there are values, none failed, and what is outside may be chance.
  bool agree() const;
};

/// Probability that at most k of n independent values lie within intervals that hold 95 % each.
double chance_of_at_most(int k, int n);

/// "6 points, 16 of 18 values within the stated 95 % interval, 1 failed, 1 breaks a limit, 2 dominated by
/// earlier runs"; what there is none of is left out but for the values.
std::string text(const CheckedRuns& checked);

}  // namespace drawpoint::studies
