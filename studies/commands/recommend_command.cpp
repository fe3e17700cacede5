// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/front_input.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/commands/options/mark_options.h>
#include <drawpoint/studies/commands/options/points.h>
#include <drawpoint/studies/model/fronts/front.h>
#include <drawpoint/studies/model/recommendation.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/say/recommended_table.h>

#include <cstdio>

namespace drawpoint::studies {
int recommend_command(const Study& study, const Settings& settings) {
  if (!has_objective(study.problem))
    throw UsageError("recommend: no response is minimized or maximized, so nothing is better than anything");
  if (!settings.marks.empty()) {
    Store store = open_store(study, Folder{settings.out});
    keep_marks(store, study, settings, message_descriptor(settings));
  }
  ReportInput input = input_with_front(study, settings, "recommend");
  input.going_on.program = settings.program;
  input.going_on.folder = out_option(Folder{settings.out});
  const Reference against =
      settings.recommend.against.empty()
          ? reference_of(study.problem, input.marks)
          : Reference{"the reference", point_named(study.problem, "--against", settings.recommend.against)};
  input.recommended = recommend(input, against);
  const RecommendedTable table = recommended_table(input);
  if (settings.json) {
    nlohmann::ordered_json line = {{"study", study.name}};
    line.update(as_json(table, input));
    print_json(line);
  } else {
    std::fputs(text(table, input).c_str(), stdout);
  }
  return 0;
}

}  // namespace drawpoint::studies
