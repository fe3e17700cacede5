// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/models/counts.h>
#include <drawpoint/studies/runs/progress.h>
#include <drawpoint/studies/runs/session.h>
#include <drawpoint/studies/store/folder.h>
#include <drawpoint/studies/store/store.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace drawpoint::studies {
namespace {

std::string as_json(const Store& store, const Counts& counts) {
  nlohmann::ordered_json line = {{"study", store.identity().study}, {"seed", store.identity().seed}};
  for (const Kind kind : all_kinds) {
    for (const Status state : all_states) line[name_of(kind)][name_of(state)] = counts.of(kind, state);
  }
  line["adaptive_wanted"] = store.sampling().points;
  line["until"] = store.sampling().until;
  line["stopped"] = store.sampling().stopped;
  line["seconds"] = counts.seconds;
  line["failures"] = counts.failures;
  line["corrections"] = store.corrections().size();
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void print(const Store& store, const Folder& folder, const Counts& counts) {
  std::printf("study %s in %s, seed %llu\n", store.identity().study.c_str(), folder.path.c_str(),
              static_cast<unsigned long long>(store.identity().seed));
  std::printf("%-13s%10s%10s%10s%10s\n", "", "planned", "running", "done", "failed");
  for (const Kind kind : all_kinds) {
    std::printf("%-13s", name_of(kind).c_str());
    for (const Status state : all_states) std::printf("%10d", counts.of(kind, state));
    std::printf("\n");
  }
  if (store.sampling().points > 0)
    std::printf("adaptive points: %d of %d wanted\n", counts.adaptive_points, store.sampling().points);
  if (!store.sampling().until.empty()) std::printf("until: %s\n", store.sampling().until.c_str());
  if (!store.sampling().stopped.empty()) std::printf("stopped: %s\n", store.sampling().stopped.c_str());
  std::printf("time in runs: %s\n", duration_text(counts.seconds).c_str());
  if (const std::size_t corrections = store.corrections().size(); corrections > 0)
    std::printf("corrections by hand: %zu; the command exclude lists them\n", corrections);
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
