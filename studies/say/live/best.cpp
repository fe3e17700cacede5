// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fronts/limits.h>
#include <drawpoint/studies/say/live/best.h>
#include <drawpoint/pareto/filter.hpp>

#include <cmath>

namespace drawpoint::studies {
namespace {

double value_of(const Contents& contents, std::size_t run, std::size_t response) {
  return contents.runs[run].y[static_cast<Eigen::Index>(response)];
}

bool is_better(const Contents& contents, std::size_t response, std::size_t run, const Reached& so_far) {
  const doe::Goal goal = contents.identity.problem.responses[response].goal;
  if (!doe::is_objective(goal)) return false;
  if (so_far.improvements.empty()) return true;
  return doe::sign_of(goal) * value_of(contents, run, response) <
         doe::sign_of(goal) * value_of(contents, so_far.improvements.back().run, response);
}

}  // namespace

std::vector<Reached> reached(const Contents& contents) {
  const auto& responses = contents.identity.problem.responses;
  std::vector<Reached> all(responses.size());
  for (std::size_t k = 0; k < contents.ended.size(); ++k) {
    const std::size_t i = contents.ended[k];
    const Run& run = contents.runs[i];
    if (run.status != Status::done) continue;
    const bool allowed = pareto::meets_limits(contents.identity.problem, run.y);
    for (std::size_t j = 0; j < responses.size(); ++j) {
      const double y = value_of(contents, i, j);
      ++all[j].done;
      all[j].within += !breaks_limit(responses[j], y);
      all[j].lowest = std::fmin(all[j].lowest, y);
      all[j].highest = std::fmax(all[j].highest, y);
      if (allowed && is_better(contents, j, i, all[j])) all[j].improvements.push_back({i, k + 1});
    }
  }
  return all;
}

}  // namespace drawpoint::studies
