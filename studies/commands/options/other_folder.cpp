// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/other_folder.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/option_values.h>

#include <filesystem>
#include <stdexcept>

namespace drawpoint::studies {

Store store_of_other_folder(const std::string& command, const Study& study, const Settings& settings) {
  std::error_code unknown;
  if (std::filesystem::equivalent(settings.out, settings.compare.with, unknown))
    throw UsageError(command + ": --out and --with are both " + settings.out.string() +
                     "; name another folder of the study");
  const Folder folder{settings.compare.with};
  const std::string name = folder.path.string();
  if (!std::filesystem::exists(folder.store()))
    throw std::runtime_error(command + ": there is no study in " + name +
                             " (no file study.db); name the other folder with --with");
  Store store = Store::open(folder.store());
  const Identity& other = store.identity();
  std::string differs;
  if (other.study != study.name) differs = "name \"" + other.study + "\" there, \"" + study.name + "\" here";
  if (differs.empty()) differs = difference(other.problem, study.problem);
  if (differs.empty()) {
    store.complete_options(with_later_ones(study.options, other.options));
    return store;
  }
  const bool earlier = before_later_responses(other.problem, study.problem) ||
                       before_later_responses(study.problem, other.problem);
  if (earlier)
    throw UsageError(command + ": one of " + settings.out.string() + " and " + name +
                     " was begun before the study had its last responses: " + differs +
                     "; where its logs are there, rerun-responses makes a folder that has them");
  throw UsageError(command + ": " + name + " holds another study: " + differs +
                   "; name a folder with the same variables and responses with --with");
}

}  // namespace drawpoint::studies
