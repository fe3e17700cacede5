// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/front_input.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/model/fronts/front.h>
#include <drawpoint/studies/model/recommendation.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/say/front_report.h>
#include <drawpoint/studies/say/report_input.h>

#include <cstdio>
#include <stdexcept>

namespace drawpoint::studies {
ReportInput input_with_front(const Study& study, const Settings& settings, const std::string& command) {
  const Store store = open_store(study, Folder{settings.out});
  const std::vector<Run> runs = store.runs();
  ReportInput input = input_with_models(study, store, runs, command);
  if (!input.no_front.empty())
    throw std::runtime_error(
        command + ": there is no front: " + input.no_front +
        "; make more runs with the command run, or ask and tell, or loosen the limits of the study");
  add_warnings(input, runs);
  return input;
}

int front_command(const Study& study, const Settings& settings) {
  if (!has_objective(study.problem))
    throw UsageError("front: no response is minimized or maximized, so there is no front");
  ReportInput input = input_with_front(study, settings, "front");
  input.recommended = recommend(input);
  const FrontSettings& wanted = settings.front;
  if (settings.json) {
    nlohmann::ordered_json line = {{"study", study.name}};
    line.update(front_points_json(input, wanted.limit));
    print_json(line);
  } else {
    std::fputs(front_points_text(input, wanted.limit, wanted.every_point).c_str(), stdout);
  }
  return 0;
}

}  // namespace drawpoint::studies
