// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/commands/options/other_folder.h>
#include <drawpoint/studies/model/fits/suspects.h>
#include <drawpoint/studies/model/fits/unevenness.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/option_values.h>
#include <drawpoint/studies/say/model_report.h>

#include <cstdio>
#include <stdexcept>

namespace drawpoint::studies {
namespace {

/// The validation runs of --with, which must have been made with the same options.
doe::Evaluations validation_runs_of_other_folder(const Study& study, const Settings& settings,
                                                 const Identity& own) {
  const Store store = store_of_other_folder("validate", study, settings);
  const Identity& other = store.identity();
  const std::string name = settings.compare.with.string();
  const std::string differs = difference(other.options, own.options, false);
  if (!differs.empty())
    throw UsageError("validate: the runs of " + name + " are not those of " + settings.out.string() + ": " +
                     differs + "; name a folder that was made with the same options with --with");
  if (own.simulator != other.simulator)
    std::fprintf(stderr,
                 "the runs of %s are by %s, those of %s by %s: what these differ in counts as an error "
                 "of the models\n",
                 name.c_str(), named(other.simulator).c_str(), settings.out.c_str(),
                 named(own.simulator).c_str());
  doe::Evaluations runs = tables_of(store.runs(), study.problem).validation;
  if (runs_with_values(runs).empty())
    throw std::runtime_error("validate: there is no validation run in " + name +
                             "; name another folder with --with, or add some there with run --validation 10");
  std::fprintf(stderr, "by the validation runs of %s\n", name.c_str());
  return runs;
}

}  // namespace

int fit_command(const Study& study, const Settings& settings) {
  const Tables tables = tables_of(open_store(study, Folder{settings.out}).runs(), study.problem);
  const Models fitted = models_or_reason(tables);
  const Failures failures(tables);
  if (settings.json)
    print_json({{"study", study.name},
                {"models", fit_json(fitted, study.problem)},
                {"success", success_json(failures, study.problem)}});
  else
    std::fputs((fit_text(fitted, study.problem) + success_text(failures, study.problem)).c_str(), stdout);
  for (const std::string& sentence : suspects(fitted, tables)) std::fprintf(stderr, "%s\n", sentence.c_str());
  for (const std::string& sentence : unevenness(fitted, tables))
    std::fprintf(stderr, "%s\n", sentence.c_str());
  return 0;
}

int validate_command(const Study& study, const Settings& settings) {
  const Store store = open_store(study, Folder{settings.out});
  Tables tables = tables_of(store.runs(), study.problem);
  if (!settings.compare.with.empty())
    tables.validation = validation_runs_of_other_folder(study, settings, store.identity());
  const Models fitted = models_or_reason(tables);
  if (fitted.validations.empty())
    throw std::runtime_error(
        "studies: there is no validation run to judge the models by; add some with run --validation 10");
  if (settings.json)
    print_json({{"study", study.name}, {"validations", validation_json(fitted, tables)}});
  else
    std::fputs(validation_text(fitted, tables).c_str(), stdout);
  return 0;
}

}  // namespace drawpoint::studies
