// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/comparison/comparison_report.h>
#include <drawpoint/studies/runs/session.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace drawpoint::studies {
namespace {

/// The store of --with. Its options may be others; the problem is that of --out.
Store store_to_compare(const Identity& own, const Folder& folder) {
  const std::string name = folder.path.string();
  if (!std::filesystem::exists(folder.store()))
    throw std::runtime_error("compare: there is no study in " + name +
                             " (no file study.db); name the other folder with --with");
  Store store = Store::open(folder.store());
  const Identity& other = store.identity();
  std::string differs;
  if (other.study != own.study) differs = "name \"" + other.study + "\" there, \"" + own.study + "\" here";
  if (differs.empty()) differs = difference(other.problem, own.problem);
  if (differs.empty()) return store;
  throw UsageError("compare: " + name + " holds another study: " + differs +
                   "; name a folder with the same variables and responses with --with");
}

void refuse_same_folder(const Settings& settings) {
  std::error_code unknown;
  if (std::filesystem::equivalent(settings.out, settings.with, unknown))
    throw UsageError("compare: --out and --with are both " + settings.out.string() +
                     "; name another folder of the study");
}

}  // namespace

int compare_command(const Study& study, const Settings& settings) {
  refuse_same_folder(settings);
  const Folder folder_a{settings.out}, folder_b{settings.with};
  const Store a = open_store(study, folder_a);
  const Store b = store_to_compare(a.identity(), folder_b);
  const ComparedFolders compared = compare_folders(study, {folder_a, a}, {folder_b, b});
  if (settings.json)
    print_json(comparison_json(compared));
  else
    std::fputs(comparison_text(compared).c_str(), stdout);
  return 0;
}

}  // namespace drawpoint::studies
