// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How many runs a study has in which state, and why runs failed.

#include <drawpoint/studies/run/store/store.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace drawpoint::studies {

inline constexpr std::array all_states = {Status::planned, Status::running, Status::done, Status::failed};

struct Counts {
  std::map<Kind, std::map<Status, int>> by_kind;
  std::map<std::string, int> failures;  ///< reason, how often
  double seconds = 0.0;                 ///< time in runs
  int adaptive_points = 0;

  int of(Kind kind, Status status) const;
  int of(Status status) const;  ///< all kinds
};

Counts count(const std::vector<Run>& runs);

}  // namespace drawpoint::studies
