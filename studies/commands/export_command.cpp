// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/export.h>
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/output_file.h>
#include <drawpoint/studies/runs/session.h>
#include <drawpoint/studies/store/folder.h>
#include <drawpoint/doe/detail/atomic_file.hpp>

#include <cstdio>
#include <string>

namespace drawpoint::studies {

int export_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  const Store store = open_store(study, folder);
  const ExportSettings& wanted = settings.exported;
  if (!wanted.file.empty()) check_output_file(folder, wanted.file);
  const ExportTable table = wanted.what == "front" ? front_table(store.identity(), store.runs())
                                                   : runs_table(store.identity(), store.runs());
  const std::string text = wanted.format == "json" ? as_json(study.name, table) : as_csv(table);
  if (wanted.file.empty()) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
  }
  doe::write_file(wanted.file, text);
  std::fprintf(stderr, "%zu rows in %s\n", table.rows.size(), wanted.file.c_str());
  return 0;
}

}  // namespace drawpoint::studies
