// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/recommendation.h>
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/front_input.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/commands/points.h>
#include <drawpoint/studies/models/front.h>
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
  const std::vector<double> middle = middle_of(study.problem);
  const bool own = !settings.against.empty();
  const Eigen::VectorXd against = own ? point_named(study.problem, "--against", settings.against)
                                      : Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
                                            middle.data(), static_cast<Eigen::Index>(middle.size())));
  const ReportInput input = input_with_front(study, settings, "recommend");
  const doe::Seed seed = open_store(study, Folder{settings.out}).identity().seed;
  const Recommendation recommended = recommendation_of(input, against, seed);
  const RecommendationWords words{.reference = own ? "the reference" : "the middle of the box",
                                  .confirm = confirm_line(study, settings, recommended.x)};
  if (settings.json) {
    nlohmann::ordered_json line = {{"study", study.name}};
    line.update(as_json(recommended, input, words));
    print_json(line);
  } else {
    std::fputs(text(recommended, input, words).c_str(), stdout);
  }
  return 0;
}

}  // namespace drawpoint::studies
