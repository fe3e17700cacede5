// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/comparison/compared_folders.h>
#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fronts/front.h>
#include <drawpoint/studies/run/logged_runs.h>

#include <set>
#include <stdexcept>
#include <utility>

namespace drawpoint::studies {
namespace {

void add_front(ComparedSide& side, const std::vector<Run>& runs, const Identity& identity) {
  if (!has_objective(identity.problem)) {
    side.no_front = "no response is to be minimized or maximized";
    return;
  }
  const Tables tables = tables_of(runs, identity.problem);
  try {
    PredictedFront predicted = predicted_front(fit_models(tables).models, tables, identity.seed);
    side.no_front = std::move(predicted.missing);
    side.flat = std::move(predicted.flat);
    if (side.no_front.empty()) side.front = std::move(predicted.found.front);
  } catch (const std::invalid_argument& e) {
    side.no_front = tables.training.X().rows() == 0 ? "no training run has given values"
                                                    : std::string("there are no models: ") + e.what();
  }
}

ComparedSide side_of(const Study& study, const ComparedFolder& compared, const std::vector<Run>& runs) {
  ComparedSide side{.folder = compared.folder.path.string()};
  for (const Run& run : runs) {
    side.ended += has_ended(run);
    side.failed += run.status == Status::failed;
  }
  const Identity& identity = compared.store.identity();
  const std::vector<const Run*> logged = runs_with_log(study, identity, runs, compared.folder, side.warnings);
  side.headlines = headlines_of(study, logged, identity.options, compared.folder, side.warnings);
  add_front(side, runs, identity);
  return side;
}

/// The front with the values of these objectives alone.
pareto::Front seen_in(const doe::Problem& problem, pareto::Front front) {
  std::vector<int> columns;
  for (std::size_t j = 0; j < problem.responses.size(); ++j)
    if (doe::is_objective(problem.responses[j].goal)) columns.push_back(static_cast<int>(j));
  front.Y = front.responses(Eigen::all, columns).eval();
  return front;
}

std::string value_or_none(const OptionValues& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? "none" : found->second;
}

std::vector<OtherChoice> other_choices(const Identity& a, const Identity& b) {
  std::vector<OtherChoice> all;
  const auto note = [&](const std::string& what, const std::string& in_a, const std::string& in_b) {
    if (in_a != in_b) all.push_back({what, in_a, in_b});
  };
  std::set<std::string> names;
  for (const auto* options : {&a.options, &b.options})
    for (const auto& [name, value] : *options) names.insert(name);
  for (const std::string& name : names)
    note("option " + name, value_or_none(a.options, name), value_or_none(b.options, name));
  note("simulator", a.simulator, b.simulator);
  note("seed", std::to_string(a.seed), std::to_string(b.seed));
  note("replicates", std::to_string(a.replicates), std::to_string(b.replicates));
  return all;
}

}  // namespace

ComparedFolders compare_folders(const Study& study, const ComparedFolder& a, const ComparedFolder& b) {
  const std::vector<Run> runs_a = a.store.runs(), runs_b = b.store.runs();
  ComparedFolders compared{.study = study.name,
                           .problem = study.problem,
                           .a = side_of(study, a, runs_a),
                           .b = side_of(study, b, runs_b),
                           .choices = other_choices(a.store.identity(), b.store.identity()),
                           .runs = compare_runs(runs_a, runs_b)};
  compared.common = without_flat(without_flat(study.problem, compared.a.flat), compared.b.flat);
  if (compared.a.front && compared.b.front && has_objective(compared.common))
    compared.fronts = compare_fronts(compared.common, seen_in(compared.common, *compared.a.front),
                                     seen_in(compared.common, *compared.b.front));
  return compared;
}

}  // namespace drawpoint::studies
