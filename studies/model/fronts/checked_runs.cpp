// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/stated_interval.h>
#include <drawpoint/studies/model/fronts/checked_runs.h>

#include <cmath>
#include <utility>

namespace drawpoint::studies {
namespace {

constexpr double blamed_below = 0.10;

}  // namespace

void CheckedRuns::add(CheckedRun run) {
  values += run.values;
  within += run.held;
  failed += run.outcome.failed();
  dominated += run.dominated;
  breaking += run.breaks_limit;
  runs.push_back(std::move(run));
}

CheckedRuns CheckedRuns::last_round() const {
  CheckedRuns last;
  for (const CheckedRun& run : runs) {
    if (run.round == runs.back().round) last.add(run);
  }
  return last;
}

bool CheckedRuns::may_be_chance() const { return chance_of_at_most(within, values) >= blamed_below; }

bool CheckedRuns::agree() const { return values > 0 && failed == 0 && may_be_chance(); }

double chance_of_at_most(int k, int n) {
  // The misses are few, so the sum runs over them: at least n - k of n, each with probability 1 - stated_level.
  double term = std::pow(stated_level, n), below = 0.0;  // term: probability of exactly i misses
  for (int i = 0; i < n - k; ++i) {
    below += term;
    term *= static_cast<double>(n - i) / (i + 1) * (1.0 - stated_level) / stated_level;
  }
  return 1.0 - below;
}

std::string text(const CheckedRuns& checked) {
  const auto count = checked.runs.size();
  std::string all = std::to_string(count) + (count == 1 ? " point, " : " points, ") +
                    std::to_string(checked.within) + " of " + std::to_string(checked.values) +
                    " values within the stated 95 % interval";
  if (checked.failed > 0) all += ", " + std::to_string(checked.failed) + " failed";
  if (checked.breaking > 0)
    all +=
        ", " + std::to_string(checked.breaking) + (checked.breaking == 1 ? " breaks" : " break") + " a limit";
  if (checked.dominated > 0) all += ", " + std::to_string(checked.dominated) + " dominated by earlier runs";
  return all;
}

}  // namespace drawpoint::studies
