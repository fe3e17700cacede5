// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/run/counts.h>
#include <drawpoint/studies/run/progress.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/marks.h>
#include <drawpoint/studies/run/store/option_values.h>
#include <drawpoint/studies/run/store/store.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {
namespace {

std::string options_of(const Study& study, const Store& store) {
  return typed_options(study.options, study.presets, store.identity().options);
}

nlohmann::ordered_json marks_json(const Study& study, const Store& store) {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const Mark& mark : with_marks(study.presentation.marks, store.marks()))
    for (std::size_t k = 0; k < study.problem.variables.size(); ++k)
      all[mark.name][study.problem.variables[k].name] = mark.x[static_cast<Eigen::Index>(k)];
  return all;
}

std::string as_json(const Study& study, const Store& store, const Counts& counts) {
  nlohmann::ordered_json line = {{"study", store.identity().study}, {"seed", store.identity().seed}};
  for (const Kind kind : all_kinds) {
    for (const Status state : all_states) line[name_of(kind)][name_of(state)] = counts.of(kind, state);
  }
  line["adaptive_wanted"] = store.sampling().points;
  line["until"] = store.sampling().until;
  line["stopped"] = store.sampling().stopped.why;
  line["go_on"] = store.sampling().stopped.go_on;
  line["options"] = options_of(study, store);
  line["marks"] = marks_json(study, store);
  line["seconds"] = counts.seconds;
  line["failures"] = counts.failures;
  line["corrections"] = store.corrections().size();
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// What ended the sampling, and what goes on.
void print_sampling(const Sampling& sampling, const Counts& counts) {
  const bool may_be_fewer = !sampling.until.empty() || sampling.target > 0.0;
  if (sampling.points > 0)
    std::printf("adaptive points: %d of %s%d wanted\n", counts.adaptive_points,
                may_be_fewer ? "at most " : "", sampling.points);
  if (!sampling.until.empty()) std::printf("until: %s\n", sampling.until.c_str());
  if (sampling.stopped.why.empty()) return;
  std::printf("stopped: %s\n", sampling.stopped.why.c_str());
  std::printf("to go on: %s\n", sampling.stopped.go_on.c_str());
}

void print(const Study& study, const Store& store, const Folder& folder, const Counts& counts) {
  std::printf("study %s in %s, seed %llu\n", store.identity().study.c_str(), folder.path.c_str(),
              static_cast<unsigned long long>(store.identity().seed));
  std::printf("%-13s%10s%10s%10s%10s\n", "", "planned", "running", "done", "failed");
  for (const Kind kind : all_kinds) {
    std::printf("%-13s", name_of(kind).c_str());
    for (const Status state : all_states) std::printf("%10d", counts.of(kind, state));
    std::printf("\n");
  }
  print_sampling(store.sampling(), counts);
  if (const std::string options = options_of(study, store); !options.empty())
    std::printf("options: %s\n", options.c_str());
  std::string marks;
  for (const Mark& mark : with_marks(study.presentation.marks, store.marks())) marks += " " + mark_text(mark);
  if (!marks.empty()) std::printf("marks:%s\n", marks.c_str());
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
    std::printf("%s\n", as_json(study, store, counts).c_str());
  } else {
    print(study, store, folder, counts);
  }
  return 0;
}

}  // namespace drawpoint::studies
