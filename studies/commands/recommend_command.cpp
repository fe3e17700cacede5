// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/recommended_table.h>
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/front_input.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/commands/points.h>
#include <drawpoint/studies/runs/session.h>

#include <cstdio>

namespace drawpoint::studies {
namespace {

/// As it is typed: this point alone, once.
std::string confirm_line(const Study& study, const Settings& settings, const Eigen::VectorXd& x) {
  const std::string out = out_option(Folder{settings.out});
  if (!study.black_box) return settings.program + " ask --confirm" + out;
  std::string values;
  for (const double value : x) values += (values.empty() ? "" : ",") + doe::detail::number_text(value);
  return settings.program + " confirm --points 0 --rounds 1 --x=" + values + out;
}

}  // namespace

int recommend_command(const Study& study, const Settings& settings) {
  if (!has_objective(study.problem))
    throw UsageError("recommend: no response is minimized or maximized, so nothing is better than anything");
  const ReportInput input = input_with_front(study, settings, "recommend");
  const Reference against =
      settings.against.empty()
          ? reference_of(study.problem, input.marks)
          : Reference{"the reference", point_named(study.problem, "--against", settings.against)};
  const RecommendedTable table = recommended_table(input, against);
  const RecommendationWords words{.confirm = confirm_line(study, settings, table.recommended.x)};
  if (settings.json) {
    nlohmann::ordered_json line = {{"study", study.name}};
    line.update(as_json(table, input, words));
    print_json(line);
  } else {
    std::fputs(text(table, input, words).c_str(), stdout);
  }
  return 0;
}

}  // namespace drawpoint::studies
