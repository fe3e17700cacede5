// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/model_report.h>
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/models/suspects.h>
#include <drawpoint/studies/models/unevenness.h>
#include <drawpoint/studies/runs/session.h>
#include <drawpoint/studies/store/folder.h>

#include <cstdio>
#include <stdexcept>

namespace drawpoint::studies {
namespace {

Tables stored_tables(const Study& study, const Settings& settings) {
  return tables_of(open_store(study, Folder{settings.out}).runs(), study.problem);
}

}  // namespace

int fit_command(const Study& study, const Settings& settings) {
  const Tables tables = stored_tables(study, settings);
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
  const Tables tables = stored_tables(study, settings);
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
