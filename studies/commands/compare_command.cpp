// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/commands/options/other_folder.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/say/comparison_report.h>

#include <cstdio>

namespace drawpoint::studies {
int compare_command(const Study& study, const Settings& settings) {
  const Folder folder_a{settings.out}, folder_b{settings.compare.with};
  const Store a = open_store(study, folder_a);
  const Store b = store_of_other_folder("compare", study, settings);
  const ComparedFolders compared = compare_folders(study, {folder_a, a}, {folder_b, b});
  if (settings.json)
    print_json(comparison_json(compared));
  else
    std::fputs(comparison_text(compared).c_str(), stdout);
  return 0;
}

}  // namespace drawpoint::studies
