// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/counts.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/program/printed_text.h>

#include <map>
#include <string>

namespace drawpoint::studies {

int Counts::of(Kind kind, Status status) const {
  const auto states = by_kind.find(kind);
  if (states == by_kind.end()) return 0;
  const auto found = states->second.find(status);
  return found == states->second.end() ? 0 : found->second;
}

int Counts::of(Status status) const {
  int sum = 0;
  for (const Kind kind : all_kinds) sum += of(kind, status);
  return sum;
}

Counts count(const std::vector<Run>& runs) {
  Counts counts;
  std::map<std::string, std::string> first;  // of the reasons that differ in the name of a log alone
  for (const auto& run : runs) {
    ++counts.by_kind[run.kind][run.status];
    if (run.status == Status::failed)
      ++counts.failures[first.emplace(without_log_name(run.reason), run.reason).first->second];
    counts.seconds += run.seconds;
  }
  counts.adaptive_points = count_points(runs, Kind::adaptive);
  return counts;
}

}  // namespace drawpoint::studies
