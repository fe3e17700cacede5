// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/runs/plan.h>
#include <drawpoint/studies/runs/progress.h>
#include <drawpoint/studies/runs/session.h>
#include <drawpoint/studies/store/folder.h>
#include <drawpoint/studies/store/store.h>

#include <array>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace drawpoint::studies {
namespace {

constexpr std::array<Status, 4> all_states = {Status::planned, Status::running, Status::done, Status::failed};

struct Counts {
  std::map<Kind, std::map<Status, int>> by_kind;
  std::map<std::string, int> failures;  ///< reason, how often
  double seconds = 0.0;
  int adaptive_points = 0;
};

Counts count(const std::vector<Run>& runs) {
  Counts counts;
  for (const auto& run : runs) {
    ++counts.by_kind[run.kind][run.status];
    if (run.status == Status::failed) ++counts.failures[run.reason];
    counts.seconds += run.seconds;
  }
  counts.adaptive_points = count_points(runs, Kind::adaptive);
  return counts;
}

std::string as_json(const Store& store, Counts counts) {
  nlohmann::ordered_json line = {{"study", store.identity().study}, {"seed", store.identity().seed}};
  for (const Kind kind : all_kinds) {
    for (const Status state : all_states) line[name_of(kind)][name_of(state)] = counts.by_kind[kind][state];
  }
  line["adaptive_wanted"] = store.sampling().points;
  line["seconds"] = counts.seconds;
  line["failures"] = counts.failures;
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void print(const Store& store, const Folder& folder, Counts counts) {
  std::printf("study %s in %s, seed %llu\n", store.identity().study.c_str(), folder.path.c_str(),
              static_cast<unsigned long long>(store.identity().seed));
  std::printf("%-13s%10s%10s%10s%10s\n", "", "planned", "running", "done", "failed");
  for (const Kind kind : all_kinds) {
    std::printf("%-13s", name_of(kind).c_str());
    for (const Status state : all_states) std::printf("%10d", counts.by_kind[kind][state]);
    std::printf("\n");
  }
  if (store.sampling().points > 0)
    std::printf("adaptive points: %d of %d wanted\n", counts.adaptive_points, store.sampling().points);
  std::printf("time in runs: %s\n", duration_text(counts.seconds).c_str());
  for (const auto& [reason, times] : counts.failures)
    std::printf("failed %d times: %s\n", times, reason.c_str());
}

}  // namespace

int status_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  const Store store = open_store(study, folder);
  const Counts counts = count(store.runs());
  if (settings.json) {
    std::printf("%s\n", as_json(store, counts).c_str());
  } else {
    print(store, folder, counts);
  }
  return 0;
}

}  // namespace drawpoint::studies
